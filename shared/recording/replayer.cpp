#include "shared/recording/replayer.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "shared/recording/lateness.hpp"
#include "shared/recording/message_prefetch.hpp"
#include "shared/recording/recorded_topic.hpp"
#include "shared/transport/blind_topic.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::recording {
namespace {

constexpr Stamp kMillisecond = 1'000'000;
constexpr Stamp kSlice = 10 * kMillisecond;
constexpr Stamp kTellProgress = 200 * kMillisecond;
constexpr Stamp kSettled = 300 * kMillisecond;  ///< without another reader that matches

/// Samples kept for readers that come late or lose some.
int depth_of(const transport::BlindTopic& topic) {
  constexpr int kUnknown = 100;
  for (const auto* profile : transport::all_topics())
    if (profile->name == topic.name) return profile->depth;
  return kUnknown;
}

}  // namespace

class Replayer::Impl {
 public:
  Impl(const transport::Participant& participant, const McapReader& reader, ReplayerOptions options,
       PacingClock& clock)
      : reader_(reader), options_(std::move(options)), clock_(clock) {
    for (const auto& [id, channel] : reader.contents().channels)
      open(participant, id, channel);
    const Stamp begin = reader.contents().start;
    start_ = begin + from_seconds(options_.start);
    end_ = options_.end > 0.0 ? begin + from_seconds(options_.end) : reader.contents().end;
  }

  ReplaySummary run(const std::atomic<bool>& stop, ReplayControl& control, const Progress& progress) {
    wait_for_readers(stop);
    send_latched();
    do {
      play(stop, control, progress);
    } while (options_.loop && !stop && summary_.sent > 0);
    for (auto& [id, output] : outputs_)
      output.writer->wait_until_delivered(std::chrono::milliseconds{stop ? 0 : 2000});
    summary_.late_median = lateness_.quantile(0.5);
    summary_.late_p99 = lateness_.quantile(0.99);
    summary_.late_worst = lateness_.worst();
    return summary_;
  }

 private:
  struct Output {
    std::string topic;  ///< ROS 2's name as it is sent
    bool is_latched = false;
    std::unique_ptr<transport::BlindWriter> writer;
  };

  void open(const transport::Participant& participant, ChannelId id, const Channel& channel) {
    transport::BlindTopic topic = blind_topic(channel, reader_.schema_of(channel));
    if (!options_.topics.wants(topic.name)) return;
    const bool latched = is_latched(topic);
    const int depth = depth_of(topic);
    if (const auto other = options_.remap.find(ros_topic(topic.name)); other != options_.remap.end())
      topic.name = dds_topic(other->second);
    try {
      outputs_[id] = {ros_topic(topic.name), latched,
                      std::make_unique<transport::BlindWriter>(participant, topic, depth)};
    } catch (const transport::TransportError& error) {
      summary_.not_sent.emplace_back(error.what());
    }
  }

  int readers() const {
    int count = 0;
    for (const auto& [id, output] : outputs_)
      count += output.writer->readers();
    return count;
  }

  std::vector<std::string> missing_readers() const {
    std::vector<std::string> missing;
    for (const std::string& pattern : options_.expected_readers) {
      const bool is_there = std::any_of(outputs_.begin(), outputs_.end(), [&](const auto& entry) {
        return matches(entry.second.topic, pattern) && entry.second.writer->readers() > 0;
      });
      if (!is_there) missing.push_back(pattern);
    }
    if (options_.expected_readers.empty() && readers() == 0) missing.emplace_back("*");
    return missing;
  }

  /// Until the expected ones are there and no more come.
  void wait_for_readers(const std::atomic<bool>& stop) {
    const Stamp give_up = clock_.now() + from_seconds(options_.patience);
    int known = 0;
    Stamp last_change = clock_.now();
    while (!stop && clock_.now() < give_up) {
      const int now_there = readers();
      if (now_there != known) last_change = clock_.now();
      known = now_there;
      if (missing_readers().empty() && clock_.now() - last_change >= kSettled) break;
      clock_.sleep_until(clock_.now() + kSlice, stop);
    }
    summary_.without_reader = missing_readers();
  }

  /// What a late reader would have got: the last message before the beginning.
  void send_latched() {
    MessageFilter filter;
    filter.wants = [this](const Channel& channel) {
      const auto output = outputs_.find(channel.id);
      return output != outputs_.end() && output->second.is_latched;
    };
    filter.end = start_ - 1;
    std::map<ChannelId, std::pair<Bytes, Stamp>> last;
    MessageCursor cursor = reader_.messages(filter);
    while (const auto message = cursor.next())
      last[message->channel_id] = {{message->payload.begin(), message->payload.end()}, message->publish_time};
    for (const auto& [id, message] : last)
      send(id, message.first, message.second);
  }

  void play(const std::atomic<bool>& stop, ReplayControl& control, const Progress& progress) {
    MessageFilter filter;
    filter.wants = [this](const Channel& channel) { return outputs_.contains(channel.id); };
    filter.start = start_;
    filter.end = end_;
    MessagePrefetch ahead(reader_.messages(filter));
    auto message = ahead.next();
    began_ = clock_.now();
    for (; message; message = ahead.next()) {
      const std::optional<Stamp> due = wait_until_due(*message, stop, control, progress);
      if (stop) return;
      if (due && options_.rate > 0.0) lateness_.add(clock_.now() - *due);
      send(message->channel_id, message->payload, message->publish_time);
      tell(*message, control, progress);
    }
    summary_.damaged = ahead.damaged();
  }

  /// When it was due, or nothing when a step sent it.
  std::optional<Stamp> wait_until_due(const PrefetchedMessage& message, const std::atomic<bool>& stop,
                                      ReplayControl& control, const Progress& progress) {
    while (!stop) {
      const Stamp now = clock_.now();
      if (control.paused) {
        if (control.steps > 0) {
          --control.steps;
          began_ = now - offset_of(message);  // goes on from here
          return std::nullopt;
        }
        tell(message, control, progress);
        clock_.sleep_until(now + kSlice, stop);
        began_ += clock_.now() - now;
        continue;
      }
      const Stamp due = began_ + offset_of(message);
      if (now >= due) return due;
      clock_.sleep_until(std::min(due, now + kSlice), stop);
    }
    return std::nullopt;
  }

  Stamp offset_of(const PrefetchedMessage& message) const {
    if (options_.rate <= 0.0) return 0;
    return static_cast<Stamp>(static_cast<double>(message.log_time - start_) / options_.rate);
  }

  void send(ChannelId channel, ByteView payload, Stamp source_stamp) {
    const bool taken = outputs_.at(channel).writer->write(payload, source_stamp);
    ++(taken ? summary_.sent : summary_.failed);
  }

  void tell(const PrefetchedMessage& message, const ReplayControl& control, const Progress& progress) {
    const Stamp now = clock_.now();
    if (!progress || now - told_ < kTellProgress) return;
    told_ = now;
    progress({message.log_time - reader_.contents().start, summary_.sent, control.paused});
  }

  const McapReader& reader_;
  ReplayerOptions options_;
  PacingClock& clock_;
  Stamp start_ = 0, end_ = 0;  ///< log times
  Stamp began_ = 0;            ///< of the clock, when `start_` was due
  Stamp told_ = 0;
  std::map<ChannelId, Output> outputs_;
  Lateness lateness_;
  ReplaySummary summary_;
};

Replayer::Replayer(const transport::Participant& participant, const McapReader& reader,
                   ReplayerOptions options, PacingClock& clock)
    : impl_(std::make_unique<Impl>(participant, reader, std::move(options), clock)) {}
Replayer::~Replayer() = default;

ReplaySummary Replayer::run(const std::atomic<bool>& stop, ReplayControl& control, const Progress& progress) {
  return impl_->run(stop, control, progress);
}

}  // namespace cosight::recording
