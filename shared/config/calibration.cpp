#include "shared/config/calibration.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>

#include "shared/config/config.hpp"

namespace cosight {
namespace {

bool is_camera(const ConfigNode& file, const std::string& key) {
  return key != "camera_model" && !key.empty() && file.has(key) &&
         (key.starts_with("cam") || key.find("_and_") != std::string::npos || key == "left" ||
          key == "right");
}

bool stands_for(const std::string& key, const std::string& camera_name) {
  if (key == camera_name) return true;
  const auto conjunction = key.find("_and_");
  return conjunction != std::string::npos &&
         (key.substr(0, conjunction) == camera_name || key.substr(conjunction + 5) == camera_name);
}

ConfigNode camera_section(const ConfigFile& file, const std::string& camera_name) {
  const ConfigNode& root = file.root();
  if (root.has("camera_model")) return root;  // EuRoC's sensor.yaml: the file is the camera
  std::string cameras;
  for (const auto& key : root.keys()) {
    if (stands_for(key, camera_name)) return root.section(key);
    if (is_camera(root, key)) cameras += (cameras.empty() ? "" : ", ") + key;
  }
  throw root.error(camera_name, cameras.empty()
                                    ? "no such camera, nor any other; write a section " + camera_name
                                    : "no such camera; the file has " + cameras);
}

/// A list that has to be there, of a length that has to be right.
std::vector<double> required_numbers(const ConfigNode& camera, const std::string& key, std::size_t size) {
  if (!camera.has(key)) throw camera.error(key, "is missing; the camera can't be used without");
  auto values = camera.numbers(key, {});
  if (values.size() != size) {
    throw camera.error(
        key, "has to be " + std::to_string(size) + " numbers, not " + std::to_string(values.size()));
  }
  return values;
}

double required_number(const ConfigNode& camera, const std::string& key, double min, double max) {
  if (!camera.has(key)) throw camera.error(key, "is missing; the camera can't be used without");
  return camera.number(key, min, min, max);
}

void read_resolution(const ConfigNode& camera, CameraModel& model) {
  constexpr double kMaxSide = 20'000;
  const auto size = required_numbers(camera, "resolution", 2);
  for (const double side : size) {
    if (side < 1 || side > kMaxSide || side != static_cast<int>(side)) {
      throw camera.error("resolution", "has to be [width, height] in whole pixels");
    }
  }
  model.width = static_cast<int>(size[0]);
  model.height = static_cast<int>(size[1]);
}

void read_intrinsics(const ConfigNode& camera, CameraModel& model) {
  const auto values = required_numbers(camera, "intrinsics", 4);
  if (values[0] <= 0 || values[1] <= 0) {
    throw camera.error("intrinsics", "has to be [fx, fy, cx, cy] in pixels with fx, fy > 0");
  }
  model.fx = values[0];
  model.fy = values[1];
  model.cx = values[2];
  model.cy = values[3];
}

Distortion distortion_named(const ConfigNode& camera, const std::string& key, const std::string& name) {
  if (name == "none") return Distortion::kNone;
  if (name == "radtan" || name == "radial-tangential" || name == "plumb_bob") return Distortion::kRadtan;
  if (name == "equidistant") return Distortion::kEquidistant;
  throw camera.error(key, "unknown distortion model '" + name + "'; known are radtan, equidistant, none");
}

void read_coefficients(const ConfigNode& camera, CameraModel& model) {
  std::string key = "distortion";
  for (const char* other : {"distortion_coeffs", "distortion_coefficients"}) {
    if (camera.has(other)) key = other;
  }
  const auto values = camera.numbers(key, {});
  const auto wanted = [&](std::size_t least, std::size_t most, const char* names) {
    if (values.size() >= least && values.size() <= most) return;
    throw camera.error(
        key, std::string("has to be ") + names + ", not " + std::to_string(values.size()) + " numbers");
  };
  if (model.distortion == Distortion::kRadtan) wanted(4, 5, "[k1, k2, p1, p2] or [k1, k2, p1, p2, k3]");
  if (model.distortion == Distortion::kEquidistant) wanted(4, 4, "[k1, k2, k3, k4]");
  if (model.distortion == Distortion::kNone && !values.empty() &&
      std::any_of(values.begin(), values.end(), [](double k) { return k != 0; })) {
    throw camera.error(key, "has coefficients but no model; add distortion_model: radtan or equidistant");
  }
  if (model.distortion != Distortion::kNone) {
    std::copy(values.begin(), values.end(), model.coefficients.begin());
  }
}

void read_scenelib(const ConfigNode& camera, CameraModel& model) {
  constexpr double kMaxPixels = 1e5;
  model.fx = required_number(camera, "fku", 1.0, kMaxPixels);
  model.fy = required_number(camera, "fkv", 1.0, kMaxPixels);
  model.cx = required_number(camera, "u0", -kMaxPixels, kMaxPixels);
  model.cy = required_number(camera, "v0", -kMaxPixels, kMaxPixels);
  model.distortion = Distortion::kScenelibWide;
  model.coefficients[0] = required_number(camera, "kd1", 0.0, 1.0);
}

CameraModel read_camera(const ConfigNode& camera) {
  CameraModel model;
  read_resolution(camera, model);
  const std::string name = camera.text("camera_model", "pinhole");
  if (name == "scenelib_wide") {
    read_scenelib(camera, model);
    return model;
  }
  if (!name.starts_with("pinhole") || (name.size() > 7 && name[7] != '_')) {
    throw camera.error("camera_model", "unknown camera model '" + name +
                                           "'; known are pinhole, pinhole_radtan, pinhole_equidistant, "
                                           "scenelib_wide");
  }
  read_intrinsics(camera, model);
  if (name.size() > 8) {
    model.distortion = distortion_named(camera, "camera_model", name.substr(8));
  } else {
    model.distortion = distortion_named(camera, "distortion_model", camera.text("distortion_model", "none"));
  }
  read_coefficients(camera, model);
  return model;
}

std::string full(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

Pose read_transform(const ConfigNode& node, const std::string& key) {
  const auto values = node.numbers(key, {});
  if (values.size() != 12 && values.size() != 16) throw node.error(key, "has to be a 3x4 or 4x4 transform");
  using RowMajor34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const RowMajor34 matrix = Eigen::Map<const RowMajor34>(values.data());
  const Eigen::Matrix3d R = matrix.leftCols<3>();
  constexpr double kTolerance = 1e-3;  // the precision that people write down
  if (!(R * R.transpose()).isIdentity(kTolerance) || R.determinant() < 0) {
    throw node.error(key, "is no rigid transform: its left 3x3 part is not a rotation");
  }
  return Pose{Eigen::Quaterniond(R).normalized(), matrix.col(3)};
}

CameraModel load_camera_model(const std::filesystem::path& file, const std::string& camera_name) {
  return read_camera(camera_section(ConfigFile::load(file), camera_name));
}

std::optional<Pose> load_body_extrinsics(const std::filesystem::path& file, const std::string& camera_name) {
  const ConfigFile config = ConfigFile::load(file);
  const ConfigNode camera = camera_section(config, camera_name);
  if (camera.has("T_BC")) return read_transform(camera, "T_BC");
  if (camera.has("T_cam_imu")) return read_transform(camera, "T_cam_imu").inverse();
  if (camera.has("T_BS")) return read_transform(camera.section("T_BS"), "data");
  return std::nullopt;
}

void write_camera_model(const std::filesystem::path& file, const CameraModel& camera,
                        const std::string& camera_name) {
  const auto& k = camera.coefficients;
  std::string text = camera_name + ":\n";
  const std::string size = std::to_string(camera.width) + ", " + std::to_string(camera.height);
  if (camera.distortion == Distortion::kScenelibWide) {
    text += "  camera_model: scenelib_wide\n  fku: " + full(camera.fx) + "\n  fkv: " + full(camera.fy) +
            "\n  u0: " + full(camera.cx) + "\n  v0: " + full(camera.cy) + "\n  kd1: " + full(k[0]) + "\n";
  } else {
    text += "  camera_model: pinhole\n  intrinsics: [" + full(camera.fx) + ", " + full(camera.fy) + ", " +
            full(camera.cx) + ", " + full(camera.cy) + "]\n";
    const std::string four = full(k[0]) + ", " + full(k[1]) + ", " + full(k[2]) + ", " + full(k[3]);
    if (camera.distortion == Distortion::kRadtan) {
      text += "  distortion_model: radtan\n  distortion_coeffs: [" + four + ", " + full(k[4]) + "]\n";
    } else if (camera.distortion == Distortion::kEquidistant) {
      text += "  distortion_model: equidistant\n  distortion_coeffs: [" + four + "]\n";
    } else {
      text += "  distortion_model: none\n  distortion_coeffs: []\n";
    }
  }
  text += "  resolution: [" + size + "]\n";
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw ConfigError(file.string() + ": can't be written; check the folder and free space");
}

}  // namespace cosight
