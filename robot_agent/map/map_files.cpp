#include "robot_agent/map/map_files.hpp"

#include <bit>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "robot_agent/map/map_archive.hpp"

namespace cosight::map {
namespace {

/// One point as both formats hold it, byte for byte.
struct Row {
  float x, y, z, intensity, sigma;
  std::uint32_t id, observations;
};
static_assert(sizeof(Row) == 28);
static_assert(std::endian::native == std::endian::little, "the files say so");

Row row_of(const MapPoint& point) {
  return {static_cast<float>(point.p_W.x()),
          static_cast<float>(point.p_W.y()),
          static_cast<float>(point.p_W.z()),
          static_cast<float>(point.intensity),
          static_cast<float>(worst_sigma(point)),
          static_cast<std::uint32_t>(point.id),
          static_cast<std::uint32_t>(point.observations)};
}

std::string ply_header(std::size_t points) {
  std::ostringstream header;
  header << "ply\nformat binary_little_endian 1.0\nelement vertex " << points << '\n';
  for (const char* name : {"x", "y", "z", "intensity", "sigma"})
    header << "property float " << name << '\n';
  header << "property uint id\nproperty uint observations\nend_header\n";
  return header.str();
}

std::string pcd_header(std::size_t points) {
  std::ostringstream header;
  header << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
            "FIELDS x y z intensity sigma id observations\nSIZE 4 4 4 4 4 4 4\n"
            "TYPE F F F F F U U\nCOUNT 1 1 1 1 1 1 1\n"
         << "WIDTH " << points << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << points
         << "\nDATA binary\n";
  return header.str();
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw MapFileError(path.string() + ": the map can't be written: " + reason);
}

/// The file appears beside `path` and takes its place only if it is whole.
void write_whole_file(const std::filesystem::path& path, const std::string& header,
                      std::span<const MapPoint> points) {
  std::vector<Row> rows;
  rows.reserve(points.size());
  for (const MapPoint& point : points)
    rows.push_back(row_of(point));
  std::filesystem::path part = path;
  part += ".part";
  std::ofstream file(part, std::ios::binary);
  file << header;
  file.write(reinterpret_cast<const char*>(rows.data()),
             static_cast<std::streamsize>(rows.size() * sizeof(Row)));
  file.close();
  std::error_code error;
  if (!file) {
    std::filesystem::remove(part, error);
    fail(path, "no room, or no permission");
  }
  std::filesystem::rename(part, path, error);
  if (error) fail(path, error.message());
}

}  // namespace

void write_ply(const std::filesystem::path& path, std::span<const MapPoint> points) {
  write_whole_file(path, ply_header(points.size()), points);
}

void write_pcd(const std::filesystem::path& path, std::span<const MapPoint> points) {
  write_whole_file(path, pcd_header(points.size()), points);
}

}  // namespace cosight::map
