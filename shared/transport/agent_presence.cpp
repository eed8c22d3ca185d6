#include "shared/transport/agent_presence.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <random>
#include <set>
#include <thread>
#include <utility>

#include "shared/transport/publisher.hpp"
#include "shared/transport/subscriber.hpp"

namespace cosight::transport {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPeriod{100};

std::uint64_t draw_instance_id() {
  std::random_device device;
  return (std::uint64_t{device()} << 32) | device();
}

Stamp now() {
  return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

bool is_older(const HeartbeatSample& heartbeat, std::uint64_t own_beats, std::uint64_t own_instance) {
  constexpr std::uint64_t kSameTime = 5;  // beats
  if (heartbeat.beat > own_beats + kSameTime) return true;
  if (own_beats > heartbeat.beat + kSameTime) return false;
  return heartbeat.instance_id < own_instance;
}

class AgentPresence::Impl {
 public:
  Impl(const Participant& participant, const Topic<HeartbeatSample>& topic, std::string agent_id)
      : publisher_(participant, topic),
        subscriber_(participant, topic,
                    [this](HeartbeatSample&& heartbeat, const Reception&) { judge(heartbeat); }) {
    beat_.agent_id = std::move(agent_id);
    beat_.instance_id = draw_instance_id();
    is_ready_ = true;
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void update(const AgentProgress& progress) {
    const std::lock_guard lock(mutex_);
    beat_.frames_sent = progress.frames_sent;
    beat_.orientations_sent = progress.orientations_sent;
    beat_.frames = progress.frames;
    beat_.orientations = progress.orientations;
  }

  bool has_older_namesake() const { return has_older_namesake_; }

  std::uint64_t newer_namesakes() const {
    const std::lock_guard lock(mutex_);
    return newer_.size();
  }

 private:
  void run(const std::stop_token& stop) {
    auto due = std::chrono::steady_clock::now();
    while (!stop.stop_requested()) {
      HeartbeatSample heartbeat;
      {
        const std::lock_guard lock(mutex_);
        ++beat_.beat;
        beat_.stamp = now();
        heartbeat = beat_;
      }
      publisher_.publish(heartbeat);
      due += kPeriod;
      std::unique_lock lock(mutex_);
      wake_.wait_until(lock, stop, due, [] { return false; });
    }
  }

  void judge(const HeartbeatSample& heartbeat) {
    if (!is_ready_) return;
    const std::lock_guard lock(mutex_);
    if (heartbeat.agent_id != beat_.agent_id || heartbeat.instance_id == beat_.instance_id) return;
    if (is_older(heartbeat, beat_.beat, beat_.instance_id)) {
      if (!has_older_namesake_.exchange(true)) {
        spdlog::error("an agent with the id '{}' is already running; stop it, or give this one another id",
                      beat_.agent_id);
      }
      return;
    }
    constexpr std::size_t kMostRemembered = 1000;
    if (newer_.size() < kMostRemembered && newer_.insert(heartbeat.instance_id).second) {
      spdlog::warn("another agent with the id '{}' has started; it will end, this one goes on",
                   beat_.agent_id);
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  HeartbeatSample beat_;
  std::set<std::uint64_t> newer_;
  std::atomic<bool> has_older_namesake_ = false;
  std::atomic<bool> is_ready_ = false;
  Publisher<HeartbeatSample> publisher_;
  Subscriber<HeartbeatSample> subscriber_;
  std::jthread thread_;  // last: stops first
};

AgentPresence::AgentPresence(const Participant& participant, const Topic<HeartbeatSample>& topic,
                             std::string agent_id)
    : impl_(std::make_unique<Impl>(participant, topic, std::move(agent_id))) {}

AgentPresence::~AgentPresence() = default;

void AgentPresence::update(const AgentProgress& progress) {
  impl_->update(progress);
}

bool AgentPresence::has_older_namesake() const {
  return impl_->has_older_namesake();
}

std::uint64_t AgentPresence::newer_namesakes() const {
  return impl_->newer_namesakes();
}

}  // namespace cosight::transport
