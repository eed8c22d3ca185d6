#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "robot_agent/inbox/pairing.hpp"

namespace cosight::inbox {

constexpr Stamp ms(std::int64_t milliseconds) {
  return from_milliseconds(milliseconds);
}

/// A pairing whose time is set by hand: `now` is the arrival clock, the stamps are chosen freely.
class PairingFixture : public testing::Test {
 protected:
  void robot(Stamp stamp) { pairing_.add_robot_frame(image(stamp, robot_sequence_++), now_); }
  void worn(Stamp stamp) { pairing_.add_worn_frame(image(stamp, worn_sequence_++), now_); }
  void pose(Stamp stamp, double x = 0.0) {
    WearerPoseSample sample;
    sample.stamp = stamp;
    sample.T_SF.T.p.x() = x;
    sample.T_SF.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
    pairing_.add_pose(sample, now_);
  }
  void ahrs(Stamp stamp) {
    AhrsSample sample;
    sample.stamp = stamp;
    pairing_.add_ahrs(sample, now_);
  }
  /// A wearer that sends everything for `stamp` at once.
  void wearer(Stamp stamp) {
    ahrs(stamp);
    pose(stamp);
    worn(stamp);
  }
  void wait(Stamp duration) { now_ += duration; }
  std::optional<PairedFrame> next() { return pairing_.next(now_); }
  /// Stamp of the worn frame of the next robot frame; -1 without one; -2 when no robot frame is ready.
  Stamp next_worn_stamp() {
    const auto paired = next();
    if (!paired) return -2;
    return paired->worn ? paired->worn->frame.stamp : -1;
  }
  /// The benefit of the doubt at the start is over, and no wearer was heard.
  void pass_start_without_wearer() {
    robot(ms(1));
    wait(ms(10'000));
    ASSERT_EQ(next_worn_stamp(), -1);
  }
  const InboxCounters& counters() const { return pairing_.counters(); }

  static ImageSample image(Stamp stamp, std::uint64_t sequence) {
    ImageSample sample;
    sample.stamp = stamp;
    sample.sequence = sequence;
    sample.bytes.assign(100, 0);
    return sample;
  }

  PairingOptions options_{.max_queued_images = 4, .max_queued_bytes = 10'000, .max_queued_frames = 100};
  Pairing pairing_{options_, InterpolationOptions{}, MountingOptions{}};
  Stamp now_ = ms(50'000);
  std::uint64_t robot_sequence_ = 0;
  std::uint64_t worn_sequence_ = 0;
};

}  // namespace cosight::inbox
