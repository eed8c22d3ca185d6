#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/outbox/yaml_text.hpp"
#include "shared/transport/participant.hpp"
#include "shared/transport/publisher.hpp"
#include "shared/transport/subscriber.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::outbox {

/// At most one event in an interval of the frames' own time.
class Throttle {
 public:
  explicit Throttle(Stamp interval) : interval_(interval) {}

  /// Whether the event is due at `stamp`; if so, the next one is an interval later. A clock that was set back
  /// does not silence it.
  bool due(Stamp stamp);

 private:
  Stamp interval_;
  std::optional<Stamp> last_;
};

/// Publishes what slam says: odometry and overlap of each frame, the map now and then, its health once a
/// second and whenever it changes.
class EstimatePublisher {
 public:
  using MapSource = std::function<std::vector<MapPoint>()>;

  /// `map_interval` in the frames' time [ns].
  explicit EstimatePublisher(const transport::Participant& participant,
                             Stamp map_interval = kNanosecondsPerSecond);

  /// Asks for the map only when it is due. No odometry before the scale is known.
  void publish(const FrameEstimate& estimate, const MapSource& map);

  /// Waits until readers have the last samples, at most `timeout` each.
  void finish(std::chrono::milliseconds timeout);

  /// Sections `dds_odometry`, `dds_overlap`, `dds_diagnostics`, `dds_map`.
  void report(YamlText& text) const;

 private:
  transport::Publisher<OdometrySample> odometry_;
  transport::Publisher<OverlapSample> overlap_;
  transport::Publisher<DiagnosticSample> diagnostics_;
  transport::Publisher<PointCloudSample> map_;
  Throttle map_throttle_;
  Throttle diagnostics_throttle_{kNanosecondsPerSecond};
  std::optional<Tracking> last_tracking_;
};

/// Counters of one topic as a section of a summary.
void report(YamlText& text, std::string_view section, const transport::PublisherCounters& counters);
void report(YamlText& text, std::string_view section, const transport::SubscriberCounters& counters);

}  // namespace cosight::outbox
