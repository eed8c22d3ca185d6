#include "robot_agent/vins/vins_thread.hpp"

#include <sys/resource.h>

#include <utility>

namespace cosight::vins {
namespace {

/// The calling thread alone. Slam must not wait for VINS where cores are few; VINS has time until the next
/// image.
void take_second_place() {
  constexpr int kSteps = 5;
  ::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + kSteps);
}

}  // namespace

VinsThread::VinsThread(const VinsThreadOptions& options, const CameraModel& camera, const Pose& T_BS,
                       Found found)
    : options_(options),
      found_(std::move(found)),
      max_apart_(options.max_distance_apart_px / (0.5 * (camera.fx + camera.fy))),
      tracker_(camera, options.tracker),
      vins_(options.vins, T_BS) {
  thread_ = std::thread([this] { run(); });
}

VinsThread::~VinsThread() {
  finish();
}

void VinsThread::push_imu(const ImuSample& sample) {
  {
    std::unique_lock lock(mutex_);
    const auto has_room = [&] { return imu_.size() < options_.max_imu_samples; };
    // Samples that no image takes would wait for ever: then, as for live input, the old ones go.
    if (options_.never_drop) changed_.wait(lock, [&] { return ended_ || has_room() || !can_process(); });
    if (!has_room()) {
      counters_.imu_refused += imu_.size();
      imu_.clear();
    }
    ++counters_.imu_samples;
    imu_.push_back(sample);
    last_imu_ = sample.stamp;
  }
  changed_.notify_all();
}

void VinsThread::push_image(Stamp stamp, Decode decode, std::vector<DistanceSighting> distances) {
  {
    std::unique_lock lock(mutex_);
    const auto has_room = [&] { return images_.size() < options_.max_images; };
    // Without IMU samples the queue would never empty: then, as for live input, the oldest image goes.
    if (options_.never_drop) changed_.wait(lock, [&] { return ended_ || has_room() || !can_process(); });
    ++counters_.images;
    if (stamp <= last_image_) {
      ++counters_.images_out_of_order;
      return;
    }
    last_image_ = stamp;
    if (!has_room()) {
      ++counters_.images_dropped;
      images_.pop_front();
    }
    images_.push_back({stamp, std::move(decode), std::move(distances)});
  }
  changed_.notify_all();
}

void VinsThread::wait_for(Stamp stamp) {
  std::unique_lock lock(mutex_);
  const auto is_in_work = [&] { return in_work_ && *in_work_ <= stamp; };
  const auto waits = [&] { return can_process() && images_.front().stamp <= stamp; };
  const auto is_done = [&] { return !is_in_work() && !waits(); };
  if (options_.never_drop) {
    changed_.wait(lock, is_done);
  } else {
    changed_.wait_for(lock, options_.patience, is_done);
  }
}

void VinsThread::finish() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

VinsCounters VinsThread::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

bool VinsThread::can_process() const {
  return !images_.empty() && last_imu_ >= images_.front().stamp;
}

void VinsThread::run() {
  take_second_place();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ended_ || can_process(); });
    if (!can_process()) break;
    const WaitingImage next = std::move(images_.front());
    images_.pop_front();
    in_work_ = next.stamp;
    const std::vector<ImuSample> imu = std::exchange(imu_, {});
    lock.unlock();
    changed_.notify_all();
    process(next, imu);
    lock.lock();
    in_work_.reset();
    changed_.notify_all();
  }
  counters_.images_without_imu += images_.size();
}

void VinsThread::process(const WaitingImage& next, const std::vector<ImuSample>& imu) {
  std::uint64_t refused = 0;
  for (const ImuSample& sample : imu)
    refused += vins_.add_imu(sample) ? 0 : 1;
  const auto image = next.decode();
  std::optional<VinsEstimate> estimate;
  int distances_given = 0;
  if (image) {
    FeatureFrame frame = tracker_.track(next.stamp, *image);
    distances_given = give_distances(next.distances, max_apart_, frame);
    lengths_.add(frame);
    estimate = vins_.process(frame);
  }
  {
    const std::lock_guard lock(mutex_);
    counters_.imu_refused += refused;
    counters_.distances += next.distances.size();
    counters_.distances_given += static_cast<std::uint64_t>(distances_given);
    counters_.sightings = lengths_.sightings();
    counters_.outlier_sightings = lengths_.outlier_sightings();
    if (!estimate) ++counters_.images_undecodable;
    if (estimate && estimate->status == VinsStatus::kWaitingForImu) ++counters_.images_without_imu;
  }
  if (estimate && found_) found_(*estimate, vins_.odometry().window());
}

}  // namespace cosight::vins
