#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <map>
#include <string>

#include "shared/transport/publisher.hpp"
#include "tests/interop/cyclone_peer.hpp"
#include "tests/shared/transport/example_samples.hpp"
#include "tests/shared/transport/inbox_of.hpp"

namespace cosight::transport {
namespace {

std::string text(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.17g", value);
  return buffer.data();
}

class ExpectedFields {
 public:
  explicit ExpectedFields(const Fields& printed) : printed_(printed) {}
  ~ExpectedFields() {
    EXPECT_EQ(expected_, printed_.size()) << "Cyclone printed a field that nobody expected";
  }
  ExpectedFields(const ExpectedFields&) = delete;
  ExpectedFields& operator=(const ExpectedFields&) = delete;

  void expect(const std::string& name, const std::string& value) {
    ++expected_;
    const auto field = printed_.find(name);
    ASSERT_NE(field, printed_.end()) << name << " was not printed";
    EXPECT_EQ(field->second, value) << name;
  }
  void expect(const std::string& name, double value) { expect(name, text(value)); }
  void expect(const std::string& name, const Eigen::Vector3d& v) {
    expect(name + ".x", v.x());
    expect(name + ".y", v.y());
    expect(name + ".z", v.z());
  }
  template <int N>
  void expect_rows(const std::string& name, const Eigen::Matrix<double, N, N>& m) {
    for (int i = 0; i < N * N; ++i)
      expect(name + "." + std::to_string(i), m(i / N, i % N));
  }
  void expect_row(const std::string& name, std::initializer_list<double> values) {
    int i = 0;
    for (const double value : values)
      expect(name + "." + std::to_string(i++), value);
  }
  void expect_header(const std::string& name, const std::string& frame_id) {
    expect(name + ".sec", std::to_string(ExampleSamples::kStamp / kNanosecondsPerSecond));
    expect(name + ".nanosec", std::to_string(ExampleSamples::kStamp % kNanosecondsPerSecond));
    expect(name + ".frame_id", frame_id);
  }
  void expect_octets(const std::string& name, const std::vector<std::uint8_t>& bytes) {
    std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
    for (const std::uint8_t byte : bytes)
      hash = (hash ^ byte) * 1099511628211ULL;
    expect(name + ".length", std::to_string(bytes.size()));
    expect(name + ".hash", std::to_string(hash));
  }

 private:
  const Fields& printed_;
  std::size_t expected_ = 0;
};

TEST(Cyclone, ReadsEveryFieldThatTheWearableSends) {
  ExampleSamples example;
  const ImageSample jpeg = example.image(ImageEncoding::kJpeg, 300, 200);
  const ImageSample raw = example.image(ImageEncoding::kMono8, 752, 480);
  const CameraInfoSample info = example.camera_info(Distortion::kRadtan);
  const AhrsSample ahrs = example.ahrs();

  const Participant wearable(loopback("wearable"));
  Publisher<ImageSample> compressed_images(wearable, topics::kWearableImageCompressed);
  Publisher<ImageSample> raw_images(wearable, topics::kWearableImage);
  Publisher<CameraInfoSample> infos(wearable, topics::kWearableCameraInfo);
  Publisher<AhrsSample> orientations(wearable, topics::kWearableImu);
  ASSERT_TRUE(compressed_images.publish(jpeg) && raw_images.publish(raw));
  ASSERT_TRUE(infos.publish(info) && orientations.publish(ahrs));

  CyclonePeer cyclone("receive");
  ASSERT_EQ(cyclone.wait(), 0);
  const Fields printed = cyclone.printed();
  ExpectedFields fields(printed);
  fields.expect_header("compressed", "wearer_camera");
  fields.expect("compressed.format", "jpeg");
  fields.expect_octets("compressed.data", jpeg.bytes);

  fields.expect_header("image", "wearer_camera");
  fields.expect("image.height", "480");
  fields.expect("image.width", "752");
  fields.expect("image.encoding", "mono8");
  fields.expect("image.is_bigendian", "0");
  fields.expect("image.step", "752");
  fields.expect_octets("image.data", raw.bytes);

  const CameraModel& c = info.camera;
  fields.expect_header("info", "wearer_camera");
  fields.expect("info.height", "480");
  fields.expect("info.width", "752");
  fields.expect("info.model", "plumb_bob");
  fields.expect_row("info.d", {c.coefficients[0], c.coefficients[1], c.coefficients[2], c.coefficients[3],
                               c.coefficients[4]});
  fields.expect_row("info.k", {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1});
  fields.expect_row("info.r", {1, 0, 0, 0, 1, 0, 0, 0, 1});
  fields.expect_row("info.p", {c.fx, 0, c.cx, 0, 0, c.fy, c.cy, 0, 0, 0, 1, 0});
  fields.expect("info.binning_x", "0");
  fields.expect("info.binning_y", "0");
  fields.expect("info.roi", "0/0/0/0/0");

  fields.expect_header("imu", "wearer_head");
  fields.expect("imu.q", Eigen::Vector3d(ahrs.q_WH.vec()));
  fields.expect("imu.q.w", ahrs.q_WH.w());
  fields.expect("imu.omega", ahrs.angular_velocity_H);
  fields.expect("imu.a", ahrs.acceleration_H);
  fields.expect_rows<3>("imu.q_covariance", ahrs.orientation_covariance);
  fields.expect_rows<3>("imu.omega_covariance", Eigen::Matrix3d::Zero());
  fields.expect_rows<3>("imu.a_covariance", Eigen::Matrix3d::Zero());
}

TEST(Cyclone, SendsFramesAndOrientationsThatTheRobotReads) {
  const Participant robot(loopback("robot"));
  InboxOf<ImageSample> images(robot, topics::kWearableImage);
  InboxOf<AhrsSample> orientations(robot, topics::kWearableImu);
  const CyclonePeer cyclone("send");
  ASSERT_TRUE(images.wait_for(3, 20000ms));
  ASSERT_TRUE(orientations.wait_for(3, 20000ms));

  const ImageSample image = images.received().front().sample;
  EXPECT_EQ(image.stamp, 1'700'000'000'123'456'789);
  EXPECT_EQ(image.width, 320);
  EXPECT_EQ(image.height, 240);
  ASSERT_EQ(image.bytes.size(), 320U * 240U);
  for (std::size_t i = 0; i < image.bytes.size(); ++i) {
    ASSERT_EQ(image.bytes[i], static_cast<std::uint8_t>(i * 7 + i / 320));
  }
  const AhrsSample ahrs = orientations.received().front().sample;
  EXPECT_TRUE(ahrs.q_WH.coeffs().isApprox(Eigen::Vector4d(0.1, 0.7, -0.1, 0.7), 1e-12));
  EXPECT_TRUE(ahrs.orientation_covariance.isApprox(
      Eigen::Matrix3d(Eigen::Vector3d(0.01, 0.02, 0.03).asDiagonal()), 1e-12));
  EXPECT_EQ(ahrs.angular_velocity_H, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(ahrs.acceleration_H, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(images.subscriber.counters().invalid, 0U);
}

}  // namespace
}  // namespace cosight::transport
