#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

#include "robot_agent/vins/adaptive_vins.hpp"
#include "robot_agent/vins/feature_tracker.hpp"

namespace cosight::vins {

struct VinsThreadOptions {
  VinsOptions vins;
  FeatureTrackerOptions tracker;
  std::size_t max_images = 4;          ///< waiting; more delay, or more frames lost when it is too slow
  std::size_t max_imu_samples = 4000;  ///< waiting for an image: 20 s at 200 Hz
  bool never_drop = false;             ///< a full queue makes push_image wait: for input that can be paused
};

/// What went in and what was lost on the way.
struct VinsCounters {
  std::uint64_t images = 0;
  std::uint64_t images_dropped = 0;  ///< came faster than they could be processed
  std::uint64_t images_out_of_order = 0;
  std::uint64_t images_without_imu = 0;  ///< the IMU's samples did not reach around them
  std::uint64_t imu_samples = 0;
  std::uint64_t imu_refused = 0;  ///< not newer than the last, not finite, or nobody took them
};

/// AdaptiveVins with its front end in a thread of its own. An image is processed as soon as IMU samples reach
/// past it. With `never_drop` the estimates depend on the samples alone, not on when they came.
class VinsThread {
 public:
  VinsThread(const VinsThreadOptions& options, const CameraModel& camera, const Pose& T_BS);
  ~VinsThread();
  VinsThread(const VinsThread&) = delete;
  VinsThread& operator=(const VinsThread&) = delete;

  void push_imu(const ImuSample& sample);
  void push_image(Stamp stamp, GrayImage image);

  /// What was estimated since the last call.
  std::vector<VinsEstimate> poll();

  /// No more samples will come: processes what waits, as far as the IMU reaches, and ends the thread.
  void finish();

  VinsCounters counters() const;

 private:
  struct StampedImage {
    Stamp stamp = 0;
    GrayImage image;
  };

  void run();
  bool can_process() const;
  void process(const StampedImage& next, const std::vector<ImuSample>& imu);

  VinsThreadOptions options_;
  FeatureTracker tracker_;
  AdaptiveVins vins_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<StampedImage> images_;
  std::vector<ImuSample> imu_;
  std::vector<VinsEstimate> estimates_;
  VinsCounters counters_;
  Stamp last_imu_ = 0;
  Stamp last_image_ = 0;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace cosight::vins
