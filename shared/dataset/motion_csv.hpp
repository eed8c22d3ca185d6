#pragma once

#include <filesystem>
#include <numbers>
#include <vector>

#include "shared/dataset/known_point.hpp"
#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// Standard deviation of an AHRS's roll, pitch [rad] and yaw [rad]; a csv does not say it.
struct AhrsNoise {
  double tilt = 0.5 * std::numbers::pi / 180.0;
  double yaw = 1.0 * std::numbers::pi / 180.0;
};

/// Of a tracked wearer's pose whose csv has no covariance columns.
struct WearerPoseNoise {
  double position = 0.01;                            ///< [m]
  double rotation = 0.5 * std::numbers::pi / 180.0;  ///< [rad]
};

/// Samples from memory, in their order.
class SampleListSource : public SampleSource {
 public:
  SampleListSource(std::vector<Sample> samples, SampleKind kind, const SourceCounters& dropped,
                   std::string description);

  std::optional<Sample> next() override;
  SourceCounters counters(SampleKind kind) const override;
  using SampleSource::counters;
  std::string description() const override { return description_; }

 private:
  std::vector<Sample> samples_;
  SampleKind kind_;
  SourceCounters counters_;
  std::string description_;
  std::size_t position_ = 0;
};

/// `stamp_ns,qx,qy,qz,qw[,wx,wy,wz,ax,ay,az]`: q_WH, rates [rad/s] and specific force [m/s^2] in H. Rows with
/// a NaN, without a quaternion of unit length, or out of order are counted and skipped. Throws DatasetError.
std::unique_ptr<SampleSource> open_ahrs_csv(const std::filesystem::path& csv, const AhrsNoise& noise = {});

/// `stamp_ns,px,py,pz,qx,qy,qz,qw`: T_SF, then nothing, six standard deviations (three [m], three [rad]) or
/// the 21 entries of the covariance's upper triangle row by row, of [dp, dtheta] in the axes of S. A position
/// without an orientation leaves the four cells of the quaternion empty. Throws DatasetError.
std::unique_ptr<SampleSource> open_wearer_pose_csv(const std::filesystem::path& csv,
                                                   const WearerPoseNoise& noise = {});

/// `px,py,pz[,u,v]`: surveyed points p_W [m] and the pixels of the first image that show them, when known. A
/// row that is not finite is an error here: a survey is checked by hand. Throws DatasetError.
std::vector<KnownPoint> read_known_points(const std::filesystem::path& csv);

}  // namespace cosight
