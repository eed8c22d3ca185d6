#include "shared/transport/wearer_publisher.hpp"

#include "shared/transport/matching.hpp"

namespace cosight::transport {

WearerPublisher::WearerPublisher(const Participant& participant, ImageEncoding encoding)
    : images_(participant,
              encoding == ImageEncoding::kMono8 ? topics::kWearableImage : topics::kWearableImageCompressed),
      orientations_(participant, topics::kWearableImu),
      camera_info_(participant, topics::kWearableCameraInfo) {}

void WearerPublisher::publish(const CameraModel& camera, Stamp stamp) {
  camera_info_.publish({stamp, camera});
}

void WearerPublisher::publish(const Sample& sample) {
  if (const auto* const image = std::get_if<ImageSample>(&sample)) images_.publish(*image);
  if (const auto* const orientation = std::get_if<AhrsSample>(&sample)) orientations_.publish(*orientation);
}

bool WearerPublisher::wait_for_robot(std::chrono::milliseconds timeout) const {
  if (!images_.wait_for_readers(1, timeout)) return false;
  wait_for_further_readers(orientations_);
  return true;
}

bool WearerPublisher::wait_until_delivered(std::chrono::milliseconds timeout) {
  const auto end = std::chrono::steady_clock::now() + timeout;
  const bool images = images_.wait_until_delivered(timeout);
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
  return orientations_.wait_until_delivered(std::max(left, std::chrono::milliseconds{1})) && images;
}

SentCounters WearerPublisher::sent() const {
  SentCounters sent;
  const auto images = images_.counters();
  const auto orientations = orientations_.counters();
  const auto camera_info = camera_info_.counters();
  sent.frames = images.sent;
  sent.orientations = orientations.sent;
  sent.bytes = images.bytes + orientations.bytes + camera_info.bytes;
  sent.not_taken = images.refused + images.failed + orientations.refused + orientations.failed +
                   camera_info.refused + camera_info.failed;
  return sent;
}

}  // namespace cosight::transport
