#include "shared/transport/middleware_log.hpp"

#include <spdlog/spdlog.h>

#include <fastdds/dds/log/Log.hpp>
#include <memory>
#include <mutex>

namespace cosight::transport {

namespace {

using eprosima::fastdds::dds::Log;

// Its warnings are mostly about peers that just left: for whoever looks closer.
class LogConsumer : public eprosima::fastdds::dds::LogConsumer {
  void Consume(const Log::Entry& entry) override {
    const char* category = entry.context.category == nullptr ? "" : entry.context.category;
    spdlog::log(entry.kind == Log::Error ? spdlog::level::warn : spdlog::level::debug, "dds: [{}] {}",
                category, entry.message);
  }
};

}  // namespace

void route_middleware_log() {
  static std::once_flag routed;
  std::call_once(routed, [] {
    Log::ClearConsumers();
    Log::SetVerbosity(Log::Kind::Warning);
    Log::RegisterConsumer(std::make_unique<LogConsumer>());
  });
}

}  // namespace cosight::transport
