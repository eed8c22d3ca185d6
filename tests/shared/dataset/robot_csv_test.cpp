#include "shared/dataset/robot_csv.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "shared/config/config.hpp"
#include "tests/shared/dataset/dataset_fixture.hpp"

namespace cosight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kLasers = R"(
front:
  points: 3
  angle_min_rad: -1.5
  angle_increment_rad: 1.5
  range_min_m: 0.3
  range_max_m: 20
  T_BL:
    - [0, -1, 0, 0.4]
    - [1, 0, 0, 0.1]
    - [0, 0, 1, 0.5]
    - [0, 0, 0, 1]
)";

class RobotCsv : public DatasetFixture {
 protected:
  std::vector<LaserMounting> lasers(const std::string& yaml) const {
    return read_laser_mountings(write("lasers.yaml", yaml));
  }
  std::string error_of_lasers(const std::string& yaml) const {
    return error_of<ConfigError>([&] { lasers(yaml); });
  }
};

TEST_F(RobotCsv, AMountingSaysWhereALaserSitsAndHowItMeasures) {
  const auto read = lasers(kLasers);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].laser, "laser_front");
  EXPECT_EQ(read[0].points, 3);
  EXPECT_DOUBLE_EQ(read[0].angle_min, -1.5);
  EXPECT_DOUBLE_EQ(read[0].range_max, 20.0);
  // A point a metre ahead of this laser is a metre to the robot's left of where the laser sits.
  EXPECT_TRUE((read[0].T_BL * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(0.4, 1.1, 0.5)));
}

TEST_F(RobotCsv, AMountingThatLacksSomethingIsAnErrorThatNamesIt) {
  EXPECT_THAT(error_of_lasers("front: {points: 3}\n"),
              HasSubstr("lasers.yaml:1: front.angle_min_rad: is missing"));
  EXPECT_THAT(error_of_lasers("{}\n"), HasSubstr("names no laser"));
  EXPECT_THAT(error_of_lasers(std::string(kLasers) + "  colour: red\n"), HasSubstr("colour"));
}

TEST_F(RobotCsv, AScanKeepsItsAnglesAndSaysWhereNothingCameBack) {
  const auto source =
      open_laser_csv(write("laser_front.csv", "stamp_ns,a,b,c\n7,1.5,inf,nan\n"), lasers(kLasers)[0]);
  const auto scan = std::get<LaserScanSample>(*source->next());
  EXPECT_EQ(scan.stamp, 7);
  EXPECT_EQ(scan.laser, "laser_front");
  EXPECT_FLOAT_EQ(scan.angle_min, -1.5F);
  EXPECT_FLOAT_EQ(scan.angle_increment, 1.5F);
  EXPECT_FLOAT_EQ(scan.range_min, 0.3F);
  EXPECT_FLOAT_EQ(scan.ranges.at(0), 1.5F);
  EXPECT_TRUE(std::isinf(scan.ranges.at(1)));
  EXPECT_TRUE(std::isinf(scan.ranges.at(2)));
  EXPECT_FALSE(source->next());
}

TEST_F(RobotCsv, ScansThatCannotBeUsedAreCounted) {
  const auto source = open_laser_csv(
      write("laser_front.csv",
            "stamp_ns,a,b,c\n1,1,1,1\n2,1,1\n3,1,x,1\nx,1,1,1\n1,1,1,1\n2,1,1,1\n3,1,1,1\n9,1,1,1\n"),
      lasers(kLasers)[0]);
  EXPECT_THAT(stamps_of(all_of(*source)), ElementsAre(1, 2, 3, 9));
  EXPECT_EQ(source->counters(SampleKind::kLaserScan).not_finite, 3U);
  EXPECT_EQ(source->counters().stamp_went_back, 1U);
  EXPECT_EQ(source->counters().gaps, 1U);
  EXPECT_EQ(source->counters().delivered, 4U);
}

TEST_F(RobotCsv, AScanOfAnotherLengthThanTheLasersIsAnErrorAtTheStart) {
  EXPECT_THAT(error_of<DatasetError>([&] {
                open_laser_csv(write("laser_front.csv", "stamp_ns,a,b\n1,1,1\n"), lasers(kLasers)[0]);
              }),
              HasSubstr("laser_front.csv:1: has 3 columns; expected is stamp_ns and 3 ranges"));
}

TEST_F(RobotCsv, ReadsImuAndOdometry) {
  const auto imu =
      open_imu_csv(write("imu.csv", "stamp_ns,wx,wy,wz,ax,ay,az\n5,1,2,3,4,5,6\n6,1,2,3,4,5,nan\n"));
  const auto rates = std::get<ImuSample>(*imu->next());
  EXPECT_EQ(rates.stamp, 5);
  EXPECT_EQ(rates.angular_velocity_I, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(rates.acceleration_I, Eigen::Vector3d(4, 5, 6));
  EXPECT_FALSE(imu->next());
  EXPECT_EQ(imu->counters().not_finite, 1U);
  const auto odometry = open_odometry_csv(write("odometry.csv", "5,1,2,0.5,0.7,0.1\n"));
  const auto row = std::get<WheelOdometrySample>(*odometry->next());
  EXPECT_EQ(row.x, 1.0);
  EXPECT_EQ(row.y, 2.0);
  EXPECT_EQ(row.yaw, 0.5);
  EXPECT_EQ(row.speed, 0.7);
  EXPECT_EQ(row.turn_rate, 0.1);
}

}  // namespace
}  // namespace cosight
