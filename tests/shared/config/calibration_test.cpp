#include "shared/config/calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "shared/config/config.hpp"

namespace cosight {
namespace {

using testing::HasSubstr;

std::filesystem::path file_with(const std::string& yaml) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "cosight_calibration_test";
  std::filesystem::create_directories(folder);
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  const auto file = folder / (std::string(test->name()) + ".yaml");
  std::ofstream(file) << yaml;
  return file;
}

std::string error_of(const std::string& yaml, const std::string& camera = "cam0") {
  try {
    load_camera_model(file_with(yaml), camera);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

const char* const kKalibr = R"(cam0:
  camera_model: pinhole
  distortion_model: equidistant
  distortion_coeffs: [0.1, 0.2, 0.3, 0.4]
  intrinsics: [190.5, 191.5, 254.9, 256.8]
  resolution: [512, 510]
  rostopic: /cam0/image_raw
  T_cam_imu:
  - [0.0, -1.0, 0.0, 1.0]
  - [1.0, 0.0, 0.0, 2.0]
  - [0.0, 0.0, 1.0, 3.0]
  - [0.0, 0.0, 0.0, 1.0]
)";

TEST(Calibration, ReadsKalibr) {
  const auto file = file_with(kKalibr);
  const CameraModel camera = load_camera_model(file);
  EXPECT_EQ(camera.distortion, Distortion::kEquidistant);
  EXPECT_EQ(camera.coefficients, (std::array{0.1, 0.2, 0.3, 0.4, 0.0}));
  EXPECT_DOUBLE_EQ(camera.fx, 190.5);
  EXPECT_DOUBLE_EQ(camera.fy, 191.5);
  EXPECT_DOUBLE_EQ(camera.cx, 254.9);
  EXPECT_DOUBLE_EQ(camera.cy, 256.8);
  EXPECT_EQ(camera.width, 512);
  EXPECT_EQ(camera.height, 510);
  const auto T_BC = load_body_extrinsics(file);
  ASSERT_TRUE(T_BC);  // Kalibr writes T_CB: the body's point that T_CB moves to C has to come back
  EXPECT_TRUE((*T_BC * Eigen::Vector3d(1, 2, 3)).isZero(1e-12));
  EXPECT_TRUE((*T_BC * Eigen::Vector3d(1 - 1, 2, 3)).isApprox(Eigen::Vector3d(0, 1, 0), 1e-12));
}

TEST(Calibration, ReadsTheOneLineForms) {
  const CameraModel radtan = load_camera_model(
      file_with("cam1: {camera_model: pinhole_radtan, resolution: [752, 480], intrinsics: [1, 2, 3, 4], "
                "distortion: [-0.28, 0.07, 0.0002, 0.00002]}"),
      "cam1");
  EXPECT_EQ(radtan.distortion, Distortion::kRadtan);
  EXPECT_DOUBLE_EQ(radtan.coefficients[0], -0.28);
  const auto file = file_with(
      "left_and_right: {camera_model: pinhole, resolution: [1241, 376], intrinsics: [718, 718, 607, 185], "
      "distortion: []}\nbaseline_m: 0.5");
  EXPECT_EQ(load_camera_model(file, "left").width, 1241);
  EXPECT_EQ(load_camera_model(file, "right").distortion, Distortion::kNone);
  EXPECT_FALSE(load_body_extrinsics(file, "left"));
}

TEST(Calibration, ReadsScenelibAndEuroc) {
  const CameraModel wide =
      load_camera_model(file_with("cam0: {camera_model: scenelib_wide, resolution: [320, 240], fku: 195, "
                                  "fkv: 196, u0: 162, v0: 125, kd1: "
                                  "9.0e-6}"));
  EXPECT_EQ(wide.distortion, Distortion::kScenelibWide);
  EXPECT_DOUBLE_EQ(wide.coefficients[0], 9.0e-6);
  EXPECT_DOUBLE_EQ(wide.fy, 196);
  const auto euroc = file_with(R"(sensor_type: camera
T_BS:
  cols: 4
  rows: 4
  data: [0.0, -1.0, 0.0, 0.1,
         1.0, 0.0, 0.0, 0.2,
         0.0, 0.0, 1.0, 0.3,
         0.0, 0.0, 0.0, 1.0]
resolution: [752, 480]
camera_model: pinhole
intrinsics: [458.654, 457.296, 367.215, 248.375]
distortion_model: radial-tangential
distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
)");
  EXPECT_EQ(load_camera_model(euroc).distortion, Distortion::kRadtan);
  EXPECT_TRUE(load_body_extrinsics(euroc)->p.isApprox(Eigen::Vector3d(0.1, 0.2, 0.3)));
}

TEST(Calibration, AnUnknownDistortionModelIsNamedTogetherWithTheKnownOnes) {
  const std::string error = error_of(
      "cam0:\n  resolution: [4, 3]\n  intrinsics: [1, 1, 1, 1]\n  distortion_model: fov\n  "
      "distortion_coeffs: [1]\n");
  EXPECT_THAT(error, HasSubstr(".yaml:4: cam0.distortion_model: unknown distortion model 'fov'"));
  EXPECT_THAT(error, HasSubstr("radtan, equidistant, none"));
  EXPECT_THAT(error_of("cam0: {camera_model: omni, resolution: [4, 3], intrinsics: [1, 1, 1, 1, 1]}"),
              HasSubstr("unknown camera model 'omni'"));
}

TEST(Calibration, WhatIsMissingOrImpossibleIsNamed) {
  EXPECT_THAT(error_of("cam1: {}"), HasSubstr("cam0: no such camera; the file has cam1"));
  EXPECT_THAT(error_of("cam0: {intrinsics: [1, 1, 1, 1]}"), HasSubstr("cam0.resolution: is missing"));
  EXPECT_THAT(error_of("cam0: {resolution: [4, 3]}"), HasSubstr("cam0.intrinsics: is missing"));
  EXPECT_THAT(error_of("cam0: {resolution: [4, 3], intrinsics: [0, 1, 1, 1]}"), HasSubstr("fx, fy > 0"));
  EXPECT_THAT(error_of("cam0: {resolution: [4.5, 3], intrinsics: [1, 1, 1, 1]}"), HasSubstr("whole pixels"));
  EXPECT_THAT(error_of("cam0: {resolution: [4, -3], intrinsics: [1, 1, 1, 1]}"), HasSubstr("whole pixels"));
  EXPECT_THAT(error_of("cam0: {resolution: [4, 3], intrinsics: [1, nan, 1, 1]}"),
              HasSubstr("not a finite number"));
  EXPECT_THAT(error_of("cam0: {resolution: [4, 3], intrinsics: [1, 1, 1, 1], distortion: [0.1, 0.2, 0, 0]}"),
              HasSubstr("has coefficients but no model"));
  EXPECT_THAT(error_of("cam0: {camera_model: pinhole_radtan, resolution: [4, 3], intrinsics: [1, 1, 1, 1], "
                       "distortion: [0.1, 0.2]}"),
              HasSubstr("[k1, k2, p1, p2]"));
}

TEST(Calibration, ATransformThatIsNoRotationIsRefused) {
  EXPECT_THROW(load_body_extrinsics(file_with("cam0: {T_BC: [[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1, 0]]}")),
               ConfigError);
  EXPECT_THROW(load_body_extrinsics(file_with("cam0: {T_BC: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0]]}")),
               ConfigError);
}

TEST(Calibration, WhatIsWrittenReadsBackToTheLastBit) {
  const double third = 1.0 / 3.0;
  for (const Distortion distortion :
       {Distortion::kNone, Distortion::kRadtan, Distortion::kEquidistant, Distortion::kScenelibWide}) {
    CameraModel camera{500 + third, 501 - third, 320 * third, 239.5, 640, 480, distortion, {}};
    if (distortion != Distortion::kNone) camera.coefficients[0] = 0.1 * third;
    if (distortion == Distortion::kRadtan) camera.coefficients[4] = -0.1 * third;
    const auto file = file_with("");
    write_camera_model(file, camera, "worn");
    const CameraModel again = load_camera_model(file, "worn");
    EXPECT_EQ(again.distortion, distortion);
    EXPECT_EQ(again.coefficients, camera.coefficients);
    EXPECT_EQ(std::tuple(again.fx, again.fy, again.cx, again.cy, again.width, again.height),
              std::tuple(camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height));
  }
  EXPECT_THROW(write_camera_model("/no/such/folder/c.yaml", {}), ConfigError);
}

TEST(Calibration, ReadsTheRealSequencesWhenTheyAreThere) {
  const char* const given = std::getenv("COSIGHT_DATA");
  const std::filesystem::path data = given != nullptr ? given : COSIGHT_SOURCE_DIR "/../shared/data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no " << data;
  EXPECT_EQ(load_camera_model(data / "kitti00/calib.yaml", "right").width, 1241);
  EXPECT_EQ(load_camera_model(data / "tagbox/calib.yaml").distortion, Distortion::kNone);
  EXPECT_EQ(load_camera_model(data / "tello_line/calib.yaml").height, 540);
  EXPECT_EQ(load_camera_model(data / "scenelib/calib.yaml").distortion, Distortion::kScenelibWide);
  EXPECT_EQ(load_camera_model(data / "euroc_v101_views/calib.yaml", "cam1").distortion, Distortion::kRadtan);
  EXPECT_TRUE(load_body_extrinsics(data / "euroc_v101_flight/calib.yaml"));
}

}  // namespace
}  // namespace cosight
