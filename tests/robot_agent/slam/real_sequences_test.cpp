#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>

#include "robot_agent/slam/collaborative_slam.hpp"
#include "robot_agent/vision/active_search.hpp"
#include "robot_agent/vision/known_points.hpp"
#include "robot_agent/vision/patch_warp.hpp"
#include "shared/evaluation/trajectory_errors.hpp"
#include "shared/image/image_codec.hpp"
#include "tools/prepare/pose_noise.hpp"
#include "tools/prepare/real_sequence.hpp"

namespace cosight::slam {
namespace {

std::filesystem::path data_folder() {
  const char* given = std::getenv("COSIGHT_DATA");
  return given != nullptr ? given : std::filesystem::path(COSIGHT_SOURCE_DIR) / ".." / "shared" / "data";
}

FrameBundle bundle_of(const RecordedImage& recorded, std::uint64_t sequence) {
  FrameBundle bundle;
  bundle.stamp = recorded.stamp;
  bundle.sequence = sequence;
  bundle.image = std::make_shared<GrayImage>(read_image(recorded.file));
  return bundle;
}

/// The robot's images alone; it must track in each. The poses that have a truth, beside it.
std::vector<PosePair> track_alone(CollaborativeSlam& slam, const RealSequence& sequence) {
  std::vector<PosePair> pairs;
  std::uint64_t frame = 0;
  for (const RecordedImage& recorded : sequence.robot_images) {
    const FrameEstimate estimate = slam.process(bundle_of(recorded, frame));
    EXPECT_EQ(estimate.tracking, Tracking::kTracking) << frame;
    if (recorded.T_WC) pairs.push_back({recorded.stamp, estimate.T_WS.T, *recorded.T_WC});
    ++frame;
  }
  return pairs;
}

TEST(RealSequences, TagboxFromSurveyedCornersStaysWithinACentimetre) {
  const auto folder = data_folder() / "tagbox";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no real data: " << folder << " does not exist";
  const RealSequence sequence = read_tagbox(folder);
  SlamOptions options;
  options.mode = Mode::kMono;
  CollaborativeSlam slam(sequence.robot_camera, options, sequence.known_points);
  const std::vector<PosePair> pairs = track_alone(slam, sequence);
  EXPECT_EQ(pairs.size(), 210U);
  const double ate = statistics_of(position_errors(pairs)).rmse;
  RecordProperty("ate_m", std::to_string(ate));
  EXPECT_LE(ate, 0.01);
}

TEST(RealSequences, Kitti00HoldsItsScaleFromTheFirstOverlap) {
  const auto folder = data_folder() / "kitti00";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no real data: " << folder << " does not exist";
  const RealSequence sequence = read_kitti(folder);
  PoseNoise noise;
  noise.position_sigma.setConstant(0.01);
  noise.rotation_sigma.setConstant(0.05 * std::numbers::pi / 180.0);
  PoseNoiseSource tracker(noise, 1);
  CollaborativeSlam slam(sequence.robot_camera, SlamOptions{});
  constexpr std::size_t kFirst = 15;  // KITTI's own poses are wrong by 1.3 m before it
  constexpr std::size_t kLast = 40;
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i <= kLast; ++i) {
    const RecordedImage& robot = sequence.robot_images[i];
    const RecordedImage& worn = sequence.wearer_images[i];
    FrameBundle bundle = bundle_of(robot, i);
    WearerView& wearer = bundle.wearer.emplace();
    wearer.stamp = worn.stamp;
    wearer.image = std::make_shared<GrayImage>(read_image(worn.file));
    wearer.camera = sequence.wearer_camera;
    wearer.T_SF = tracker.observe(robot.T_WC->inverse() * *worn.T_WC);
    const FrameEstimate estimate = slam.process(bundle);
    EXPECT_EQ(estimate.tracking, Tracking::kTracking) << i;
    if (i >= kFirst) pairs.push_back({robot.stamp, estimate.T_WS.T, *robot.T_WC});
  }
  const auto scale = estimated_scale(pairs);
  ASSERT_TRUE(scale);
  RecordProperty("scale", std::to_string(*scale));
  EXPECT_NEAR(*scale, 1.0, 0.04);
}

/// The four surveyed corners of the desk's target, found again in later images by their patches of the first:
/// a pose of the camera that knows nothing of the map.
class DeskTarget {
 public:
  DeskTarget(const RealSequence& sequence, const Pose& T_WC)
      : camera_(sequence.robot_camera), points_(sequence.known_points), T_WC_(T_WC) {
    const GrayImage image = read_image(sequence.robot_images.front().file);
    for (const KnownPoint& point : points_)
      references_.push_back(vision::cut_reference(image, *point.pixel));
  }

  /// Looks within 20 px of where `guess` puts them. Nothing unless all four are there and fit one pose.
  std::optional<Pose> find(const GrayImage& image, const Pose& guess) {
    std::vector<vision::KnownPoint> found;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto pixel = camera_.project(guess.inverse() * points_[i].p_W);
      const auto A = vision::predicted_warp({camera_, T_WC_}, {camera_, guess}, points_[i].p_W,
                                            Eigen::Vector3d(Eigen::Vector3d::UnitX()));
      const auto patch = pixel && A ? vision::warp_pyramid(references_[i], *A, 13) : std::nullopt;
      if (!patch) return std::nullopt;
      const auto match = search_.find(image, *patch, *pixel, 40.0 * Eigen::Matrix2d::Identity());
      if (!match) return std::nullopt;
      found.push_back({points_[i].p_W, match.pixel});
    }
    const auto pose = vision::estimate_pose(camera_, found);
    if (!pose || pose->rms_error_px > 1.0) return std::nullopt;
    return pose->T_WC.T;
  }

 private:
  const CameraModel& camera_;
  std::vector<KnownPoint> points_;
  Pose T_WC_;
  std::vector<vision::ReferencePatch> references_;
  vision::ActiveSearch search_{{.min_score = 0.85}};
};

TEST(RealSequences, ScenelibKeepsTheScaleOfItsFourCorners) {
  const auto folder = data_folder() / "scenelib";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no real data: " << folder << " does not exist";
  const RealSequence sequence = read_scenelib(folder);
  SlamOptions options;
  options.mode = Mode::kMono;
  CollaborativeSlam slam(sequence.robot_camera, options, sequence.known_points);
  std::optional<DeskTarget> target;
  std::vector<double> scales;
  int frames = 0;
  for (const RecordedImage& recorded : sequence.robot_images) {
    const FrameBundle bundle = bundle_of(recorded, static_cast<std::uint64_t>(frames++));
    const FrameEstimate estimate = slam.process(bundle);
    EXPECT_EQ(estimate.tracking, Tracking::kTracking) << frames;
    if (!target) target.emplace(sequence, estimate.T_WS.T);
    const auto T_WC = target->find(*bundle.image, estimate.T_WS.T);
    if (T_WC) scales.push_back(estimate.T_WS.T.p.norm() / T_WC->p.norm());
  }
  EXPECT_EQ(frames, 500);
  ASSERT_GT(scales.size(), 400U);
  const auto late = scales.end() - 100;
  std::nth_element(late, late + 50, scales.end());
  RecordProperty("scale", std::to_string(*(late + 50)));
  EXPECT_NEAR(*(late + 50), 1.0, 0.02);
}

TEST(RealSequences, TelloFliesAlongWithoutAnyScale) {
  const auto folder = data_folder() / "tello_line";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no real data: " << folder << " does not exist";
  const RealSequence sequence = read_tello(folder);
  SlamOptions options;
  options.start.assumed_depth = 3.0;
  CollaborativeSlam slam(sequence.robot_camera, options);
  const std::vector<PosePair> pairs = track_alone(slam, sequence);
  const auto similarity = align(pairs, Alignment::kSim3);
  ASSERT_TRUE(similarity);
  const double ate = statistics_of(position_errors(aligned(pairs, *similarity))).rmse;
  RecordProperty("ate_m", std::to_string(ate));
  EXPECT_LE(ate, 0.05);
}

}  // namespace
}  // namespace cosight::slam
