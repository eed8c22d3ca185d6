#include "robot_agent/map/map_files.hpp"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <cstring>
#include <exception>
#include <fstream>
#include <functional>
#include <string>
#include <system_error>

#include "robot_agent/map/map_archive.hpp"

namespace cosight::map {
namespace {

struct Row {
  float x, y, z, intensity, sigma;
  std::uint32_t id, observations;
};
static_assert(sizeof(Row) == 28);

Row row_of(const MapPoint& point) {
  return {static_cast<float>(point.p_W.x()),
          static_cast<float>(point.p_W.y()),
          static_cast<float>(point.p_W.z()),
          static_cast<float>(point.intensity),
          static_cast<float>(worst_sigma(point)),
          static_cast<std::uint32_t>(point.id),
          static_cast<std::uint32_t>(point.observations)};
}

pcl::PCLPointField field(const char* name, std::size_t offset, std::uint8_t datatype) {
  pcl::PCLPointField result;
  result.name = name;
  result.offset = static_cast<pcl::uindex_t>(offset);
  result.datatype = datatype;
  result.count = 1;
  return result;
}

pcl::PCLPointCloud2 cloud_of(std::span<const MapPoint> points) {
  using Field = pcl::PCLPointField;
  pcl::PCLPointCloud2 cloud;
  cloud.fields = {field("x", offsetof(Row, x), Field::FLOAT32),
                  field("y", offsetof(Row, y), Field::FLOAT32),
                  field("z", offsetof(Row, z), Field::FLOAT32),
                  field("intensity", offsetof(Row, intensity), Field::FLOAT32),
                  field("sigma", offsetof(Row, sigma), Field::FLOAT32),
                  field("id", offsetof(Row, id), Field::UINT32),
                  field("observations", offsetof(Row, observations), Field::UINT32)};
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(points.size());
  cloud.point_step = sizeof(Row);
  cloud.row_step = static_cast<pcl::uindex_t>(points.size() * sizeof(Row));
  cloud.is_dense = 1;
  cloud.data.resize(points.size() * sizeof(Row));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Row row = row_of(points[i]);
    std::memcpy(cloud.data.data() + i * sizeof(Row), &row, sizeof(Row));
  }
  return cloud;
}

const Eigen::Vector4f kOrigin = Eigen::Vector4f::Zero();
const Eigen::Quaternionf kOrientation = Eigen::Quaternionf::Identity();

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw MapFileError(path.string() + ": the map can't be written: " + reason);
}

/// PCL refuses clouds without points; their header alone is a valid file.
void write_header(const std::filesystem::path& path, const std::string& header) {
  std::ofstream file(path, std::ios::binary);
  file << header;
}

/// `write` fills a file beside `path`, which takes its place only if it is whole.
void write_whole_file(const std::filesystem::path& path, std::size_t min_bytes,
                      const std::function<void(const std::filesystem::path&)>& write) {
  std::filesystem::path part = path;
  part += ".part";
  std::error_code error;
  try {
    write(part);
  } catch (const std::exception& exception) {
    std::filesystem::remove(part, error);
    fail(path, exception.what());
  }
  const auto bytes = std::filesystem::file_size(part, error);
  if (error || bytes < min_bytes) {
    std::filesystem::remove(part, error);
    fail(path, "no room, or no permission");
  }
  std::filesystem::rename(part, path, error);
  if (error) fail(path, error.message());
}

}  // namespace

void write_ply(const std::filesystem::path& path, std::span<const MapPoint> points) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const pcl::PCLPointCloud2 cloud = cloud_of(points);
  write_whole_file(path, cloud.data.size() + 1, [&](const std::filesystem::path& part) {
    pcl::PLYWriter writer;
    if (points.empty())
      return write_header(part, writer.generateHeaderBinary(cloud, kOrigin, kOrientation, false, 0));
    writer.writeBinary(part.string(), cloud, kOrigin, kOrientation, false);
  });
}

void write_pcd(const std::filesystem::path& path, std::span<const MapPoint> points) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const pcl::PCLPointCloud2 cloud = cloud_of(points);
  write_whole_file(path, cloud.data.size() + 1, [&](const std::filesystem::path& part) {
    pcl::PCDWriter writer;
    const std::string header = writer.generateHeaderBinary(cloud, kOrigin, kOrientation) + "DATA binary\n";
    if (points.empty()) return write_header(part, header);
    writer.writeBinary(part.string(), cloud, kOrigin, kOrientation);
    std::filesystem::resize_file(part, header.size() + cloud.data.size());  // PCL leaves the page's rest
  });
}

}  // namespace cosight::map
