// node read.mjs FILE.mcap EXPECTED: reads a recording by its index and by streaming, with its checksums, decodes every
// message by the schema in the file, and compares with EXPECTED: lines of "topic field value".
import { open, readFile } from "node:fs/promises";

import rosmsg from "@foxglove/rosmsg";
import serialization from "@foxglove/rosmsg2-serialization";
import lz4 from "@foxglove/wasm-lz4";
import zstd from "@foxglove/wasm-zstd";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

const [file, expectedFile] = process.argv.slice(2);
await Promise.all([zstd.isLoaded, lz4.isLoaded]);
const decompressHandlers = {
  zstd: (bytes, size) => zstd.decompress(bytes, Number(size)),
  lz4: (bytes, size) => lz4(bytes, Number(size)),
};

function fail(sentence) {
  console.error(sentence);
  process.exit(1);
}

function fieldOf(value, path) {
  for (const name of path.split(".")) {
    value = value?.[name];
  }
  return value;
}

class Decoder {
  #readers = new Map();

  decode(channel, schema, data) {
    if (!this.#readers.has(channel.id)) {
      if (schema.encoding !== "ros2msg") fail(`${channel.topic}: schema encoding ${schema.encoding}`);
      if (channel.messageEncoding !== "cdr") fail(`${channel.topic}: message encoding ${channel.messageEncoding}`);
      const definitions = rosmsg.parse(new TextDecoder().decode(schema.data), { ros2: true });
      this.#readers.set(channel.id, new serialization.MessageReader(definitions));
    }
    return this.#readers.get(channel.id).readMessage(data);
  }
}

async function readIndexed() {
  const handle = await open(file, "r");
  const readable = {
    size: async () => BigInt((await handle.stat()).size),
    read: async (offset, length) => {
      const buffer = new Uint8Array(Number(length));
      await handle.read(buffer, 0, Number(length), Number(offset));
      return buffer;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  if (reader.header.profile !== "ros2") fail(`profile is ${reader.header.profile}`);
  if (reader.chunkIndexes.length === 0) fail("no chunk is indexed");
  const decoder = new Decoder();
  const messages = [];
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    messages.push({ channel, message, value: decoder.decode(channel, reader.schemasById.get(channel.schemaId), message.data) });
  }
  if (BigInt(messages.length) !== reader.statistics.messageCount) fail(`${messages.length} messages by index`);
  for await (const attachment of reader.readAttachments({ validateCrc: true })) {
    if (attachment.name !== "robot.yaml") fail(`attachment ${attachment.name}`);
  }
  let metadata = 0;
  for await (const record of reader.readMetadata()) metadata += record.metadata.size;
  if (metadata === 0) fail("no metadata");
  await handle.close();
  return messages;
}

async function readStreaming() {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  const bytes = await readFile(file);
  const schemas = new Map();
  const channels = new Map();
  const decoder = new Decoder();
  const messages = [];
  for (let at = 0; at < bytes.length; at += 10_000) {
    reader.append(bytes.subarray(at, at + 10_000));
    for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
      if (record.type === "Schema") schemas.set(record.id, record);
      if (record.type === "Channel") channels.set(record.id, record);
      if (record.type !== "Message") continue;
      const channel = channels.get(record.channelId);
      messages.push({ channel, message: record, value: decoder.decode(channel, schemas.get(channel.schemaId), record.data) });
    }
  }
  if (!reader.done()) fail("the stream does not end with the footer");
  return messages;
}

const expected = (await readFile(expectedFile, "utf8")).trim().split("\n");
for (const [way, messages] of [["index", await readIndexed()], ["stream", await readStreaming()]]) {
  const topics = new Set(messages.map((m) => m.channel.topic));
  for (const line of expected) {
    const [topic, field, ...rest] = line.split(" ");
    const found = messages.find((m) => m.channel.topic === topic);
    if (!found) fail(`${way}: nothing on ${topic}`);
    const value = field === "publishTime" ? found.message.publishTime : fieldOf(found.value, field);
    if (String(value) !== rest.join(" ")) fail(`${way}: ${topic} ${field} is ${value}, not ${rest.join(" ")}`);
  }
  console.log(`${way}: ${messages.length} messages of ${topics.size} topics, ${expected.length} fields as expected`);
}
