#include "robot_agent/map/map_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace cosight::map {
namespace {

namespace fs = std::filesystem;

class MapFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cosight_map_files_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

std::vector<MapPoint> three_points() {
  std::vector<MapPoint> points(3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].id = 100 + i;
    points[i].p_W = {1.5 * static_cast<double>(i), -2.0, 0.25};
    points[i].covariance = 0.04 * Eigen::Matrix3d::Identity();
    points[i].intensity = static_cast<std::uint8_t>(200 + i);
    points[i].observations = static_cast<int>(5 + i);
  }
  return points;
}

struct Row {
  std::array<float, 5> x_y_z_intensity_sigma;
  std::array<std::uint32_t, 2> id_observations;
};

/// Header text up to and with the line that ends it, and the rows after it.
struct Contents {
  std::string header;
  std::vector<Row> rows;
};

Contents read(const fs::path& path, const std::string& last_header_line) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  const std::string all = text.str();
  const std::size_t end = all.find(last_header_line) + last_header_line.size();
  Contents contents{all.substr(0, end), std::vector<Row>((all.size() - end) / sizeof(Row))};
  std::memcpy(contents.rows.data(), all.data() + end, contents.rows.size() * sizeof(Row));
  return contents;
}

void expect_three_points(const Contents& contents) {
  ASSERT_EQ(contents.rows.size(), 3U);
  const Row& last = contents.rows[2];
  EXPECT_EQ(last.x_y_z_intensity_sigma, (std::array<float, 5>{3.0F, -2.0F, 0.25F, 202.0F, 0.2F}));
  EXPECT_EQ(last.id_observations, (std::array<std::uint32_t, 2>{102, 7}));
}

TEST_F(MapFiles, PlyHoldsEveryField) {
  write_ply(folder_ / "map.ply", three_points());
  const Contents contents = read(folder_ / "map.ply", "end_header\n");
  EXPECT_NE(contents.header.find("format binary_little_endian 1.0"), std::string::npos);
  EXPECT_NE(contents.header.find("element vertex 3"), std::string::npos);
  for (const char* property :
       {"float x", "float y", "float z", "float intensity", "float sigma", "uint id", "uint observations"}) {
    EXPECT_NE(contents.header.find(std::string("property ") + property + "\n"), std::string::npos)
        << contents.header;
  }
  expect_three_points(contents);
}

TEST_F(MapFiles, PcdHoldsEveryField) {
  write_pcd(folder_ / "map.pcd", three_points());
  const Contents contents = read(folder_ / "map.pcd", "DATA binary\n");
  EXPECT_NE(contents.header.find("FIELDS x y z intensity sigma id observations\n"), std::string::npos);
  EXPECT_NE(contents.header.find("POINTS 3\n"), std::string::npos) << contents.header;
  expect_three_points(contents);
}

TEST_F(MapFiles, AnEmptyMapIsAFileWithoutPoints) {
  write_ply(folder_ / "map.ply", {});
  write_pcd(folder_ / "map.pcd", {});
  const Contents ply = read(folder_ / "map.ply", "end_header\n");
  const Contents pcd = read(folder_ / "map.pcd", "DATA binary\n");
  EXPECT_NE(ply.header.find("element vertex 0"), std::string::npos) << ply.header;
  EXPECT_NE(pcd.header.find("POINTS 0\n"), std::string::npos) << pcd.header;
  EXPECT_TRUE(ply.rows.empty());
  EXPECT_TRUE(pcd.rows.empty());
}

TEST_F(MapFiles, AFolderThatIsNotThereIsAnErrorThatNamesTheFile) {
  for (const auto write : {&write_ply, &write_pcd}) {
    try {
      write(folder_ / "missing" / "map", three_points());
      FAIL() << "no error";
    } catch (const MapFileError& error) {
      EXPECT_NE(std::string(error.what()).find("missing/map"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace cosight::map
