#include "robot_agent/wearer/declination.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <vector>

namespace cosight::wearer {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

/// A folder with a model of the earth as a tilted dipole, of which the declination is known in closed form:
/// on a sphere, the needle points to the dipole's pole.
class DipoleModel : public testing::Test {
 protected:
  static constexpr double kPoleLatitude = 80.0, kPoleLongitude = -72.0;

  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("declination_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    std::ofstream(folder_ / "dipole.wmm") << "WMMF-1\nName dipole\nRadius 6371200\nEpoch 2020\nMinTime 2020\n"
                                             "MaxTime 2030\nMinHeight -1000\nMaxHeight 850000\nType linear\n"
                                             "Normalization schmidt\nByteOrder little\nID DIPOLE00\n";
    const double tilt = kDegree * (90.0 - kPoleLatitude);
    const double longitude = kDegree * kPoleLongitude;
    constexpr double kField = -30'000.0;  // [nT]; the pole in the north is a magnetic south pole
    const double g10 = kField * std::cos(tilt);
    const double g11 = kField * std::sin(tilt) * std::cos(longitude);
    const double h11 = kField * std::sin(tilt) * std::sin(longitude);
    std::ofstream file(folder_ / "dipole.wmm.cof", std::ios::binary);
    file << "DIPOLE00";
    write(file, {g10, g11, h11});
    write(file, {0.0, 0.0, 0.0});  // change in a year
  }
  void TearDown() override { fs::remove_all(folder_); }

  double read(const std::string& yaml) const {
    const ConfigFile file = ConfigFile::parse(yaml, "robot.yaml");
    return read_declination(file.root());
  }

  fs::path folder_;

 private:
  /// Degree and order 1: C00, C10, C11, S11.
  static void write(std::ofstream& file, const std::vector<double>& coefficients) {
    const std::int32_t size[2] = {1, 1};
    file.write(reinterpret_cast<const char*>(size), sizeof size);
    const double all[4] = {0.0, coefficients[0], coefficients[1], coefficients[2]};
    file.write(reinterpret_cast<const char*>(all), sizeof all);
  }
};

TEST_F(DipoleModel, PointsToThePole) {
  for (const double longitude : {-150.0, -72.0, 0.0, 60.0}) {
    // Spherical triangle of place, true pole and magnetic pole; on the equator sphere and ellipsoid agree.
    const double d = kDegree * (kPoleLongitude - longitude);
    const double expected =
        std::atan2(std::sin(d) * std::cos(kDegree * kPoleLatitude), std::sin(kDegree * kPoleLatitude));
    EXPECT_NEAR(declination({folder_, "dipole", 0.0, longitude, 0.0, 2025.0}), expected, 1e-9) << longitude;
  }
}

TEST_F(DipoleModel, IsReadFromTheConfiguration) {
  const double east = read("{magnetic_model_folder: " + folder_.string() +
                           ", magnetic_model: dipole, latitude_deg: 0, longitude_deg: -150, year: 2024.5}");
  EXPECT_GT(east, 5.0 * kDegree);
}

TEST_F(DipoleModel, OfWhichAFileIsMissingIsAnErrorWithKeyAndFix) {
  try {
    read("magnetic_model_folder: " + (folder_ / "nothing").string());
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("magnetic_model_folder"));
    EXPECT_THAT(error.what(), HasSubstr("wmm2020.wmm"));
    EXPECT_THAT(error.what(), HasSubstr("declination_deg"));
  }
}

TEST_F(DipoleModel, AndADeclinationByHandExcludeEachOther) {
  EXPECT_THROW(read("{declination_deg: 3, magnetic_model_folder: " + folder_.string() + "}"), ConfigError);
}

TEST_F(DipoleModel, IsNotNeededForADeclinationByHand) {
  EXPECT_NEAR(read("declination_deg: 3"), 3.0 * kDegree, 1e-12);
  EXPECT_EQ(read("{}"), 0.0);
}

}  // namespace
}  // namespace cosight::wearer
