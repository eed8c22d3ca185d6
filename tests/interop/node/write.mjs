// node write.mjs FOLDER: zstd.mcap, lz4.mcap, unchunked.mcap and unindexed.mcap with the same 50 messages: of message i
// the topic "/even" or "/odd", the sequence i, the log time (i + 1) * 1000, the publish time one less, i bytes of i.
import { open } from "node:fs/promises";

import zstd from "@foxglove/wasm-zstd";
import lz4 from "lz4js";
import { McapWriter } from "@mcap/core";

const folder = process.argv[2];
await zstd.isLoaded;

async function write(name, options) {
  const handle = await open(`${folder}/${name}.mcap`, "w");
  let position = 0n;
  const writable = {
    position: () => position,
    write: async (bytes) => {
      await handle.write(bytes);
      position += BigInt(bytes.byteLength);
    },
  };
  const writer = new McapWriter({ writable, chunkSize: 300, ...options });
  await writer.start({ profile: "ros2", library: "mcap-core" });
  const channels = [];
  for (const topic of ["/even", "/odd"]) {
    const schemaId = await writer.registerSchema({ name: "pkg/msg/Bytes", encoding: "ros2msg", data: new TextEncoder().encode("uint8[] data") });
    channels.push(await writer.registerChannel({ topic, schemaId, messageEncoding: "cdr", metadata: new Map([["key", topic]]) }));
  }
  await writer.addAttachment({ name: "note.txt", mediaType: "text/plain", logTime: 1n, createTime: 2n, data: new Uint8Array([104, 105]) });
  for (let i = 0; i < 50; ++i) {
    const logTime = BigInt((i + 1) * 1000);
    await writer.addMessage({ channelId: channels[i % 2], sequence: i, logTime, publishTime: logTime - 1n, data: new Uint8Array(i).fill(i) });
  }
  await writer.addMetadata({ name: "writer", metadata: new Map([["name", name]]) });
  await writer.end();
  await handle.close();
}

const compressZstd = (bytes) => ({ compression: "zstd", compressedData: zstd.compress(bytes) });
const compressLz4 = (bytes) => ({ compression: "lz4", compressedData: new Uint8Array(lz4.compress(bytes)) });
await write("zstd", { compressChunk: compressZstd });
await write("lz4", { compressChunk: compressLz4 });
await write("unchunked", { useChunks: false });
await write("unindexed", {
  compressChunk: compressZstd,
  useChunkIndex: false,
  useMessageIndex: false,
  useStatistics: false,
  useSummaryOffsets: false,
  repeatSchemas: false,
  repeatChannels: false,
});
