#include "shared/transport/codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "tests/shared/transport/equal_samples.hpp"
#include "tests/shared/transport/example_samples.hpp"

namespace cosight::transport {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Payload = std::vector<std::uint8_t>;

class Codec : public ::testing::Test {
 protected:
  template <class Sample>
  Sample there_and_back(const Topic<Sample>& topic, const Sample& sample) {
    Payload payload;
    EXPECT_EQ(encode(sample, topic.profile, payload), Fault::kNone);
    Sample back;
    EXPECT_EQ(decode(payload, topic.profile, back), Fault::kNone);
    return back;
  }

  template <class Sample>
  Fault encoding(const Topic<Sample>& topic, const Sample& sample) {
    Payload payload;
    return encode(sample, topic.profile, payload);
  }

  ExampleSamples example;
};

TEST_F(Codec, EverySampleComesBackAsItWent) {
  const auto same = [this](const auto& topic, const auto& sample) {
    expect_equal(there_and_back(topic, sample), sample);
  };
  same(topics::kWearableImageCompressed, example.image(ImageEncoding::kJpeg, 30, 20));
  same(topics::kWearableImageCompressed, example.image(ImageEncoding::kPng, 30, 20));
  same(topics::kWearableImage, example.image(ImageEncoding::kMono8, 30, 20));
  for (const Distortion distortion :
       {Distortion::kNone, Distortion::kRadtan, Distortion::kEquidistant, Distortion::kScenelibWide}) {
    same(topics::kWearableCameraInfo, example.camera_info(distortion));
  }
  same(topics::kWearableImu, example.ahrs());
  same(topics::kRobotLaserFront, example.scan(133));
  same(topics::kRobotLaserFront, example.scan(0));
  same(topics::kRobotImu, example.imu());
  same(topics::kRobotWheelOdometry, example.wheel_odometry());
  same(topics::kRobotWearerPose, example.wearer_pose(true));
  same(topics::kRobotOdometry, example.odometry());
  same(topics::kRobotMap, example.cloud(100));
  same(topics::kRobotMap, example.cloud(0));
  same(topics::kRobotOverlap, example.overlap());
  same(topics::kRobotDiagnostics, example.diagnostic());
  same(topics::kRobotHeartbeat, example.heartbeat());
}

TEST_F(Codec, PositionOnlyPoseLosesItsOrientationAndNothingElse) {
  const WearerPoseSample sample = example.wearer_pose(false);
  const WearerPoseSample back = there_and_back(topics::kRobotWearerPose, sample);
  EXPECT_FALSE(back.has_orientation);
  EXPECT_EQ(back.T_SF.T.p, sample.T_SF.T.p);
  EXPECT_EQ(back.T_SF.T.q.coeffs(), Eigen::Quaterniond::Identity().coeffs());
  EXPECT_EQ((back.T_SF.covariance.topLeftCorner<3, 3>()), (sample.T_SF.covariance.topLeftCorner<3, 3>()));
  EXPECT_TRUE((back.T_SF.covariance.rightCols<3>().isZero()));
  EXPECT_TRUE((back.T_SF.covariance.bottomRows<3>().isZero()));
}

TEST_F(Codec, RangesMayBeInfiniteOrNoNumberForNothingCameBack) {
  LaserScanSample scan = example.scan(3);
  scan.ranges[1] = std::numeric_limits<float>::infinity();
  scan.ranges[2] = std::numeric_limits<float>::quiet_NaN();
  const LaserScanSample back = there_and_back(topics::kRobotLaserFront, scan);
  ASSERT_EQ(back.ranges.size(), 3U);
  EXPECT_TRUE(std::isinf(back.ranges[1]));
  EXPECT_TRUE(std::isnan(back.ranges[2]));
}

TEST_F(Codec, ALaserIsKnownByItsTopic) {
  EXPECT_EQ(there_and_back(topics::kRobotLaserRear, example.scan(3)).laser, "laser_rear");
}

TEST_F(Codec, AScanOfMoreRaysThanAnyLaserHasIsRefused) {
  EXPECT_EQ(encoding(topics::kRobotLaserFront, example.scan(10'001)), Fault::kDimensions);
}

TEST_F(Codec, WheelsThatWentRoundMoreThanOnceKeepTheirHeading) {
  WheelOdometrySample sample = example.wheel_odometry();
  sample.yaw = 7.0;
  const double yaw = there_and_back(topics::kRobotWheelOdometry, sample).yaw;
  EXPECT_NEAR(std::remainder(yaw - 7.0, 2.0 * std::acos(-1.0)), 0.0, 1e-12);
  EXPECT_LE(std::abs(yaw), std::acos(-1.0));
}

TEST_F(Codec, StampsBeforeTheEpochKeepTheirNanoseconds) {
  AhrsSample sample = example.ahrs();
  sample.stamp = -1;
  EXPECT_EQ(there_and_back(topics::kWearableImu, sample).stamp, -1);
  sample.stamp = 0;
  EXPECT_EQ(there_and_back(topics::kWearableImu, sample).stamp, 0);
}

TEST_F(Codec, StampThatNoMessageCanSayIsRefused) {
  AhrsSample sample = example.ahrs();
  sample.stamp = (Stamp{1} << 31) * kNanosecondsPerSecond;
  EXPECT_EQ(encoding(topics::kWearableImu, sample), Fault::kStamp);
}

TEST_F(Codec, NotANumberIsRefusedWhereverItStands) {
  AhrsSample ahrs = example.ahrs();
  ahrs.acceleration_H.y() = kNan;
  EXPECT_EQ(encoding(topics::kWearableImu, ahrs), Fault::kNotFinite);
  ahrs = example.ahrs();
  ahrs.q_WH.x() = kNan;
  EXPECT_EQ(encoding(topics::kWearableImu, ahrs), Fault::kNotFinite);
  ahrs = example.ahrs();
  ahrs.orientation_covariance(1, 2) = kInfinity;
  EXPECT_EQ(encoding(topics::kWearableImu, ahrs), Fault::kNotFinite);
  OdometrySample odometry = example.odometry();
  odometry.twist_covariance(5, 5) = kNan;
  EXPECT_EQ(encoding(topics::kRobotOdometry, odometry), Fault::kNotFinite);
  LaserScanSample scan = example.scan(3);
  scan.angle_increment = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(encoding(topics::kRobotLaserFront, scan), Fault::kNotFinite);
  ImuSample imu = example.imu();
  imu.angular_velocity_I.x() = kNan;
  EXPECT_EQ(encoding(topics::kRobotImu, imu), Fault::kNotFinite);
  WheelOdometrySample wheels = example.wheel_odometry();
  wheels.yaw = kInfinity;
  EXPECT_EQ(encoding(topics::kRobotWheelOdometry, wheels), Fault::kNotFinite);
  WearerPoseSample pose = example.wearer_pose(false);
  pose.T_SF.T.p.z() = kInfinity;
  EXPECT_EQ(encoding(topics::kRobotWearerPose, pose), Fault::kNotFinite);
  PointCloudSample cloud = example.cloud(3);
  cloud.points[1].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(encoding(topics::kRobotMap, cloud), Fault::kNotFinite);
  CameraInfoSample info = example.camera_info(Distortion::kRadtan);
  info.camera.coefficients[3] = kNan;
  EXPECT_EQ(encoding(topics::kWearableCameraInfo, info), Fault::kNotFinite);
  OverlapSample overlap = example.overlap();
  overlap.roi_in_F[2].y() = kNan;
  EXPECT_EQ(encoding(topics::kRobotOverlap, overlap), Fault::kNotFinite);
}

TEST_F(Codec, QuaternionThatIsNoRotationIsRefused) {
  AhrsSample ahrs = example.ahrs();
  ahrs.q_WH.coeffs() *= 1.01;
  EXPECT_EQ(encoding(topics::kWearableImu, ahrs), Fault::kRotation);
  ahrs.q_WH.coeffs().setZero();
  EXPECT_EQ(encoding(topics::kWearableImu, ahrs), Fault::kRotation);
}

TEST_F(Codec, CovarianceThatIsNoneIsRefused) {
  WearerPoseSample pose = example.wearer_pose(true);
  pose.T_SF.covariance(0, 1) += 0.1;
  EXPECT_EQ(encoding(topics::kRobotWearerPose, pose), Fault::kCovariance);
  pose = example.wearer_pose(true);
  pose.T_SF.covariance(0, 0) = -0.1;
  EXPECT_EQ(encoding(topics::kRobotWearerPose, pose), Fault::kCovariance);
}

TEST_F(Codec, RawImageMustHaveAsManyBytesAsPixels) {
  ImageSample frame = example.image(ImageEncoding::kMono8, 30, 20);
  frame.bytes.pop_back();
  EXPECT_EQ(encoding(topics::kWearableImage, frame), Fault::kSize);
  frame.width = 0;
  EXPECT_EQ(encoding(topics::kWearableImage, frame), Fault::kDimensions);
  frame.width = -30;
  EXPECT_EQ(encoding(topics::kWearableImage, frame), Fault::kDimensions);
}

TEST_F(Codec, FrameLargerThanTheTopicAllowsIsRefusedOnBothSides) {
  TopicProfile tight = topics::kWearableImage.profile;
  const ImageSample frame = example.image(ImageEncoding::kMono8, 100, 100);
  Payload payload;
  ASSERT_EQ(encode(frame, tight, payload), Fault::kNone);
  tight.max_bytes = 10000;
  Payload refused;
  EXPECT_EQ(encode(frame, tight, refused), Fault::kTooLarge);
  ImageSample back;
  EXPECT_EQ(decode(payload, tight, back), Fault::kTooLarge);
}

TEST_F(Codec, AgentNameMayNotCarryControlCharacters) {
  HeartbeatSample heartbeat = example.heartbeat();
  heartbeat.agent_id = "a\x1b[2J";
  EXPECT_EQ(encoding(topics::kRobotHeartbeat, heartbeat), Fault::kText);
  heartbeat.agent_id = std::string(10000, 'a');
  EXPECT_EQ(encoding(topics::kRobotHeartbeat, heartbeat), Fault::kText);
}

// After the encapsulation: stamp 8, length of "map" 4, "map" 4, height 4, width 4, number of fields.
constexpr std::size_t kNumberOfFields = 4 + 8 + 4 + 4 + 4 + 4;

TEST_F(Codec, CloudWithMoreFieldsThanAnyCloudHasIsRefusedBeforeTheyAreRead) {
  Payload payload;
  ASSERT_EQ(encode(example.cloud(100), topics::kRobotMap.profile, payload), Fault::kNone);
  ASSERT_EQ(payload[kNumberOfFields], 5);
  payload[kNumberOfFields] = 65;
  PointCloudSample back;
  EXPECT_EQ(decode(payload, topics::kRobotMap.profile, back), Fault::kDimensions);
}

TEST_F(Codec, CloudWithoutBytesIsEmptyWhateverItsHeightSays) {
  Payload payload;
  ASSERT_EQ(encode(example.cloud(0), topics::kRobotMap.profile, payload), Fault::kNone);
  for (std::size_t i = 0; i < 4; ++i)
    payload[kNumberOfFields - 8 + i] = 0xFF;  // four milliard rows of nothing
  PointCloudSample back = example.cloud(3);
  EXPECT_EQ(decode(payload, topics::kRobotMap.profile, back), Fault::kNone);
  EXPECT_TRUE(back.points.empty());
}

/// All payloads of the wire, each with the function that reads it.
class HostilePayload : public ::testing::Test {
 protected:
  struct Case {
    Payload payload;
    std::function<Fault(std::span<const std::uint8_t>)> read;
  };

  template <class Sample>
  void add(const Topic<Sample>& topic, const Sample& sample) {
    Case one;
    ASSERT_EQ(encode(sample, topic.profile, one.payload), Fault::kNone);
    one.read = [&profile = topic.profile](std::span<const std::uint8_t> payload) {
      Sample back;
      return decode(payload, profile, back);
    };
    cases.push_back(std::move(one));
  }

  void SetUp() override {
    ExampleSamples example;
    add(topics::kWearableImageCompressed, example.image(ImageEncoding::kJpeg, 30, 20));
    add(topics::kWearableImage, example.image(ImageEncoding::kMono8, 30, 20));
    add(topics::kWearableCameraInfo, example.camera_info(Distortion::kRadtan));
    add(topics::kWearableImu, example.ahrs());
    add(topics::kRobotLaserFront, example.scan(20));
    add(topics::kRobotImu, example.imu());
    add(topics::kRobotWheelOdometry, example.wheel_odometry());
    add(topics::kRobotWearerPose, example.wearer_pose(true));
    add(topics::kRobotOdometry, example.odometry());
    add(topics::kRobotMap, example.cloud(10));
    add(topics::kRobotOverlap, example.overlap());
    add(topics::kRobotDiagnostics, example.diagnostic());
    add(topics::kRobotHeartbeat, example.heartbeat());
  }

  std::vector<Case> cases;
};

TEST_F(HostilePayload, CutAnywhereIsRefused) {
  for (const Case& one : cases) {
    for (std::size_t length = 0; length < one.payload.size(); ++length) {
      const Payload cut(one.payload.begin(), one.payload.begin() + static_cast<std::ptrdiff_t>(length));
      ASSERT_EQ(one.read(cut), Fault::kMalformed) << "cut at " << length;
    }
  }
}

TEST_F(HostilePayload, RandomBytesAreRefused) {
  std::mt19937_64 random(1);
  for (const Case& one : cases) {
    for (int i = 0; i < 2000; ++i) {
      Payload noise(random() % 600);
      for (std::uint8_t& byte : noise)
        byte = static_cast<std::uint8_t>(random());
      if (noise.size() >= 2) noise[0] = 0, noise[1] = 1;  // at least its encapsulation is right
      ASSERT_NE(one.read(noise), Fault::kNone);
    }
  }
}

TEST_F(HostilePayload, EveryWordReplacedByALyingLengthIsReadSafely) {
  for (const Case& one : cases) {
    for (std::size_t at = 0; at + 4 <= one.payload.size(); ++at) {
      for (const std::uint32_t lie : {0xFFFFFFFFU, 0x7FFFFFFFU, 0x80000000U, 0x00010000U, 0U}) {
        Payload lying = one.payload;
        std::memcpy(lying.data() + at, &lie, sizeof lie);
        one.read(lying);  // may be valid when it hit a value; may not crash, throw, or take the memory
      }
    }
  }
}

TEST_F(HostilePayload, FlippedBitsAreReadSafely) {
  std::mt19937_64 random(2);
  for (const Case& one : cases) {
    for (int i = 0; i < 5000; ++i) {
      Payload flipped = one.payload;
      for (int n = 0; n < 3; ++n)
        flipped[random() % flipped.size()] ^= static_cast<std::uint8_t>(1U << (random() % 8));
      one.read(flipped);
    }
  }
}

}  // namespace
}  // namespace cosight::transport
