#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "robot_agent/vins/adaptive_vins.hpp"
#include "robot_agent/vins/feature_tracker.hpp"
#include "robot_agent/vins/known_distances.hpp"
#include "robot_agent/vins/track_lengths.hpp"

namespace cosight::vins {

struct VinsThreadOptions {
  VinsOptions vins;
  FeatureTrackerOptions tracker;
  std::size_t max_images = 4;              ///< waiting; more delay, or more frames lost when it is too slow
  std::size_t max_imu_samples = 4000;      ///< waiting for an image: 20 s at 200 Hz
  double max_distance_apart_px = 2.0;      ///< a known distance is a feature's that is so near in the image
  std::chrono::milliseconds patience{20};  ///< of live input with images that are being processed
  bool never_drop = false;  ///< a full queue makes whoever pushes wait: for input that can be paused
};

/// What went in and what was lost on the way.
struct VinsCounters {
  std::uint64_t images = 0;
  std::uint64_t images_dropped = 0;  ///< came faster than they could be processed
  std::uint64_t images_undecodable = 0;
  std::uint64_t images_out_of_order = 0;
  std::uint64_t images_without_imu = 0;  ///< the IMU's samples did not reach around them
  std::uint64_t imu_samples = 0;
  std::uint64_t imu_refused = 0;        ///< not newer than the last, not finite, or nobody took them
  std::uint64_t sightings = 0;          ///< of features, in all images
  std::uint64_t distances = 0;          ///< of others, that came with the images
  std::uint64_t distances_given = 0;    ///< that a feature was near enough for
  std::uint64_t outlier_sightings = 0;  ///< of features lost before they were seen ten times
};

/// AdaptiveVins with its front end in a thread of its own. An image is decoded and processed as soon as IMU
/// samples reach past it. With `never_drop` the estimates depend on the samples and their order alone, not on
/// when they came.
class VinsThread {
 public:
  /// Makes the pixels of an image, in this thread; null when it can't be read.
  using Decode = std::function<std::shared_ptr<const GrayImage>()>;
  /// Gets each estimate, in this thread; the window is the one it was made with.
  using Found = std::function<void(const VinsEstimate& estimate, const Window& window)>;

  VinsThread(const VinsThreadOptions& options, const CameraModel& camera, const Pose& T_BS, Found found);
  ~VinsThread();
  VinsThread(const VinsThread&) = delete;
  VinsThread& operator=(const VinsThread&) = delete;

  void push_imu(const ImuSample& sample);
  /// `distances`: what others know of places of the image.
  void push_image(Stamp stamp, Decode decode, std::vector<DistanceSighting> distances = {});

  /// Until no image up to `stamp` waits any more, but for those that the IMU's samples do not reach yet;
  /// without `never_drop` no longer than `patience`.
  void wait_for(Stamp stamp);

  /// No more samples will come: processes what waits, as far as the IMU reaches, and ends the thread.
  void finish();

  VinsCounters counters() const;

 private:
  struct WaitingImage {
    Stamp stamp = 0;
    Decode decode;
    std::vector<DistanceSighting> distances;
  };

  void run();
  bool can_process() const;
  void process(const WaitingImage& next, const std::vector<ImuSample>& imu);

  VinsThreadOptions options_;
  Found found_;
  double max_apart_;  ///< of a known distance from its feature [rad]
  FeatureTracker tracker_;
  TrackLengths lengths_;
  AdaptiveVins vins_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<WaitingImage> images_;
  std::vector<ImuSample> imu_;
  VinsCounters counters_;
  Stamp last_imu_ = 0;
  Stamp last_image_ = 0;
  bool ended_ = false;
  std::optional<Stamp> in_work_;
  std::thread thread_;
};

}  // namespace cosight::vins
