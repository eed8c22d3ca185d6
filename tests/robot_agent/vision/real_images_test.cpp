// On real sequences, where they lie in $COSIGHT_DATA or beside the project; skipped elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "robot_agent/vision/active_search.hpp"
#include "robot_agent/vision/band_search.hpp"
#include "robot_agent/vision/corner_detector.hpp"
#include "robot_agent/vision/descriptor.hpp"
#include "robot_agent/vision/descriptor_matcher.hpp"
#include "robot_agent/vision/epipolar_band.hpp"
#include "robot_agent/vision/known_points.hpp"
#include "robot_agent/vision/point_tracker.hpp"

namespace cosight::vision {
namespace {

std::filesystem::path data_folder() {
  const char* given = std::getenv("COSIGHT_DATA");  // NOLINT(concurrency-mt-unsafe): tests have one thread
  return given != nullptr ? given : std::filesystem::path(COSIGHT_SOURCE_DIR) / ".." / "shared" / "data";
}

GrayImage read_image(const std::filesystem::path& path) {
  const cv::Mat pixels = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
  return {pixels.cols, pixels.rows,
          std::vector<std::uint8_t>(pixels.begin<std::uint8_t>(), pixels.end<std::uint8_t>())};
}

GrayImage read_kitti(const std::string& camera, int frame) {
  std::string name = std::to_string(frame);
  name.insert(0, 6 - name.size(), '0');
  return read_image(data_folder() / "kitti00" / camera / (name + ".jpg"));
}

const CameraModel kKittiCamera{718.856, 718.856, 607.1928, 185.2157, 1241, 376, Distortion::kNone, {}};
constexpr double kKittiBaseline = 0.5371657;

class Kitti : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(data_folder() / "kitti00"))
      GTEST_SKIP() << "no kitti00 in " << data_folder();
    left_ = read_kitti("left", 0);
    right_ = read_kitti("right", 0);
    ASSERT_EQ(left_.width, 1241);
    T_SF_.T.p.x() = kKittiBaseline;
    T_SF_.covariance.diagonal() << Eigen::Vector3d::Constant(1e-4), Eigen::Vector3d::Constant(7.6e-7);
  }

  GrayImage left_;
  GrayImage right_;
  UncertainPose T_SF_;
};

/// In rectified images a match lies in its own row, to the left.
bool is_rectified(const Eigen::Vector2d& in_left, const Eigen::Vector2d& in_right) {
  const Eigen::Vector2d d = in_left - in_right;
  return std::abs(d.y()) < 1.5 && d.x() > -1.0 && d.x() < 150.0;
}

TEST_F(Kitti, MatchesAlongTheBandLieInTheirRow) {
  const View slam{kKittiCamera, Pose{}};
  const View worn{kKittiCamera, T_SF_.T};
  BandSearch search;
  ImagePyramid pyramid;
  build_pyramid(right_, pyramid);
  int found = 0;
  int rectified = 0;
  const std::vector<Corner> corners = CornerDetector().detect(left_, {}, 100);
  ASSERT_EQ(corners.size(), 100U);
  for (const Corner& corner : corners) {
    const auto band = EpipolarBand::predict(kKittiCamera, kKittiCamera, T_SF_, corner.pixel,
                                            InverseDistanceRange::between(3.0, 200.0));
    if (!band) continue;
    const PatchMatch match =
        search.find(pyramid, {cut_reference(left_, corner.pixel), slam, slam, worn, corner.pixel}, *band);
    if (!match) continue;
    ++found;
    rectified += is_rectified(corner.pixel, match.pixel) ? 1 : 0;
  }
  RecordProperty("found", found);
  RecordProperty("rectified", rectified);
  EXPECT_GE(found, 50);
  EXPECT_GE(rectified, 0.9 * found);
}

int count_rectified(const DescribedFeatures& a, const DescribedFeatures& b,
                    const DescriptorMatches& matches) {
  int rectified = 0;
  for (const DescriptorMatch& match : matches.matches) {
    rectified += is_rectified(a.pixels[match.index_S], b.pixels[match.index_F]) ? 1 : 0;
  }
  return rectified;
}

class KittiDescriptors : public Kitti, public testing::WithParamInterface<DescriptorKind> {};

TEST_P(KittiDescriptors, MatchMoreAndBetterWithinTheBand) {
  const ConvexPolygon whole{{0, 0}, {1240, 0}, {1240, 375}, {0, 375}};
  const auto extractor = make_descriptor_extractor(GetParam());
  const DescribedFeatures a = extractor->detect_and_describe(left_, whole, 500);
  const DescribedFeatures b = extractor->detect_and_describe(right_, whole, 500);
  const DescriptorMatches free = match_descriptors(a, b);
  std::vector<std::optional<EpipolarBand>> bands;
  for (const Eigen::Vector2d& pixel : a.pixels) {
    bands.push_back(EpipolarBand::predict(kKittiCamera, kKittiCamera, T_SF_, pixel,
                                          InverseDistanceRange::between(3.0, 200.0)));
  }
  const DescriptorMatches gated = match_descriptors(
      a, b, {}, [&](std::size_t i, std::size_t k) { return bands[i] && bands[i]->inside(b.pixels[k]); });
  RecordProperty("free", free.counts.matched);
  RecordProperty("free_rectified", count_rectified(a, b, free));
  RecordProperty("gated", gated.counts.matched);
  RecordProperty("gated_rectified", count_rectified(a, b, gated));
  EXPECT_GE(count_rectified(a, b, free), 0.75 * free.counts.matched);
  EXPECT_GT(gated.counts.matched, free.counts.matched);
}

INSTANTIATE_TEST_SUITE_P(Kinds, KittiDescriptors,
                         testing::Values(DescriptorKind::kOrb, DescriptorKind::kSift, DescriptorKind::kSurf));

TEST_F(Kitti, TracksToTheNextFrameAgreeWithActiveSearch) {
  const GrayImage next = read_kitti("left", 1);
  PointTracker tracker;
  tracker.advance(left_);
  tracker.advance(next);
  ActiveSearch search;
  std::vector<TrackStart> starts;
  std::vector<Patch> patches;
  for (const Corner& corner : CornerDetector().detect(left_, {}, 150)) {
    starts.push_back({corner.pixel, corner.pixel, nullptr});
    patches.push_back(cut_patch(left_, corner.pixel, 13));
  }
  for (std::size_t i = 0; i < starts.size(); ++i)
    starts[i].first = &patches[i];
  const std::vector<Track> tracks = tracker.track(starts);
  int tracked = 0;
  int both = 0;
  int agree = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!tracks[i]) continue;
    ++tracked;
    const auto patch =
        warp_pyramid(cut_reference(left_, starts[i].previous), Eigen::Matrix2d::Identity(), 13);
    const PatchMatch match =
        search.find(next, *patch, starts[i].previous, 150.0 * Eigen::Matrix2d::Identity());
    if (!match) continue;
    ++both;
    agree += (match.pixel - tracks[i].pixel).norm() < 1.0 ? 1 : 0;
  }
  RecordProperty("tracked", tracked);
  RecordProperty("both", both);
  RecordProperty("agree", agree);
  EXPECT_GE(tracked, 75);
  EXPECT_GE(agree, 0.9 * both);
}

TEST(Tagbox, SurveyedCornersGiveThePose) {
  const std::filesystem::path folder = data_folder() / "tagbox";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no tagbox in " << data_folder();
  const CameraModel camera{420.506712, 420.610940, 355.208298, 250.336787, 752, 480, Distortion::kNone, {}};
  std::vector<KnownPoint> points(12);
  std::ifstream corners(folder / "p_W_corners.txt");
  std::ifstream pixels(folder / "detected_corners.txt");
  for (KnownPoint& point : points) {
    char comma = 0;
    Eigen::Vector3d centimetres;
    ASSERT_TRUE(corners >> centimetres.x() >> comma >> centimetres.y() >> comma >> centimetres.z());
    point.p_W = 0.01 * centimetres;
    ASSERT_TRUE(pixels >> point.pixel.x() >> point.pixel.y());
  }
  const auto pose = estimate_pose(camera, points);
  ASSERT_TRUE(pose);
  EXPECT_LT(pose->rms_error_px, 1.5);
  EXPECT_NEAR(pose->T_WC.T.p.norm(), 0.5, 0.2);
  EXPECT_LT(std::sqrt(pose->T_WC.covariance.topLeftCorner<3, 3>().trace()), 0.01);
  const auto robust = estimate_pose_ransac(camera, points);
  ASSERT_TRUE(robust);
  EXPECT_LT((robust->T_WC.T.p - pose->T_WC.T.p).norm(), 0.01);
}

}  // namespace
}  // namespace cosight::vision
