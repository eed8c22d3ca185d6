// A publisher that lives until it is killed: `transport_test_peer DOMAIN`.
#include <atomic>
#include <cstdlib>
#include <thread>

#include "shared/transport/publisher.hpp"
#include "tests/shared/transport/example_samples.hpp"

int main(int argc, char** argv) {
  using namespace cosight;             // NOLINT(google-build-using-namespace): a test's main
  using namespace cosight::transport;  // NOLINT(google-build-using-namespace): a test's main
  if (argc != 2) return 2;
  ParticipantOptions options;
  options.domain = static_cast<int>(std::strtol(argv[1], nullptr, 10));
  options.name = "peer";
  options.interfaces = {"lo"};
  const Participant participant(options);
  Publisher<HeartbeatSample> heartbeats(participant, topics::kWearableHeartbeat);
  Publisher<ImageSample> frames(participant, topics::kWearableImageCompressed);
  ExampleSamples example;
  HeartbeatSample heartbeat = example.heartbeat();
  const ImageSample frame = example.image(ImageEncoding::kJpeg, 200, 200);
  for (;;) {
    ++heartbeat.beat;
    heartbeats.publish(heartbeat);
    frames.publish(frame);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}
