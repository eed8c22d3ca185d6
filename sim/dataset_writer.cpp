#include "sim/dataset_writer.hpp"

#include <array>
#include <iomanip>

namespace cosight::sim {
namespace {

/// 15 digits: more than anything needs, and what a scene file says comes out as it was written.
std::ofstream& exactly(TextFile& file) {
  return static_cast<std::ofstream&>(file.stream() << std::setprecision(15));
}

void write_vector(std::ostream& stream, const Eigen::Vector3d& v) {
  stream << v.x() << ',' << v.y() << ',' << v.z();
}

void write_quaternion(std::ostream& stream, const Eigen::Quaterniond& q) {
  stream << q.x() << ',' << q.y() << ',' << q.z() << ',' << q.w();
}

const char* name_of(Distortion distortion) {
  return distortion == Distortion::kRadtan ? "radtan" : "none";
}

/// A key of two spaces' depth with a 4x4 matrix.
void write_transform(std::ostream& s, const std::string& key, const std::string& meaning, const Pose& T) {
  const Eigen::Matrix3d R = T.q.toRotationMatrix();
  s << "  " << key << ":  # " << meaning << '\n';
  for (Eigen::Index row = 0; row < 3; ++row) {
    s << "    - [" << R(row, 0) << ", " << R(row, 1) << ", " << R(row, 2) << ", " << T.p[row] << "]\n";
  }
  s << "    - [0, 0, 0, 1]\n";
}

/// Seconds with nine decimals, from the integer: a double holds no nanoseconds of this century.
void write_seconds(std::ostream& stream, Stamp stamp) {
  stream << stamp / kNanosecondsPerSecond << '.' << std::setw(9) << std::setfill('0')
         << stamp % kNanosecondsPerSecond;
}

}  // namespace

TextFile::TextFile(const std::filesystem::path& file) : file_(file) {
  std::error_code ignored;  // the open below says what is wrong
  std::filesystem::create_directories(file.parent_path(), ignored);
  stream_.open(file);
  if (!stream_) throw DatasetError(file.string() + ": cannot be written; is the folder writable?");
}

void TextFile::close() {
  stream_.close();
  if (!stream_) throw DatasetError(file_.string() + ": could not be written to the end; is the disk full?");
}

void write_calibration(const std::filesystem::path& file, const CameraModel& lens, const Pose& T_BC) {
  TextFile out(file);
  std::ofstream& s = exactly(out);
  s << "cam0:\n  camera_model: pinhole\n  intrinsics: [" << lens.fx << ", " << lens.fy << ", " << lens.cx
    << ", " << lens.cy << "]\n  resolution: [" << lens.width << ", " << lens.height
    << "]\n  distortion_model: " << name_of(lens.distortion) << '\n';
  if (lens.distortion == Distortion::kRadtan) {
    s << "  distortion_coeffs: [" << lens.coefficients[0] << ", " << lens.coefficients[1] << ", "
      << lens.coefficients[2] << ", " << lens.coefficients[3] << "]\n";
  }
  write_transform(s, "T_BC", "the optical frame in the body: robot B, or the wearer's head H", T_BC);
  out.close();
}

void write_bytes(const std::filesystem::path& file, const std::vector<unsigned char>& bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw DatasetError(file.string() + ": cannot be written; is the folder writable, the disk full?");
}

void write_image_list(const std::filesystem::path& file, const std::vector<Stamp>& stamps,
                      const std::vector<std::string>& names) {
  TextFile out(file);
  out.stream() << "stamp_ns,file\n";
  for (std::size_t k = 0; k < stamps.size(); ++k)
    out.stream() << stamps[k] << ',' << names[k] << '\n';
  out.close();
}

void write_tum(const std::filesystem::path& file, const std::vector<TimedPose>& poses) {
  TextFile out(file);
  std::ofstream& s = exactly(out);
  for (const auto& [stamp, T] : poses) {
    write_seconds(s, stamp);
    s << ' ' << T.p.x() << ' ' << T.p.y() << ' ' << T.p.z() << ' ' << T.q.x() << ' ' << T.q.y() << ' '
      << T.q.z() << ' ' << T.q.w() << '\n';
  }
  out.close();
}

void write_ahrs(const std::filesystem::path& file, const std::vector<AhrsSample>& samples) {
  TextFile out(file);
  std::ofstream& s = exactly(out);
  s << "stamp_ns,qx,qy,qz,qw,wx,wy,wz,ax,ay,az\n" << std::setprecision(9);
  for (const AhrsSample& sample : samples) {
    s << sample.stamp << ',';
    write_quaternion(s, sample.q_WH);
    s << ',';
    write_vector(s, sample.angular_velocity_H);
    s << ',';
    write_vector(s, sample.acceleration_H);
    s << '\n';
  }
  out.close();
}

void write_wearer_poses(const std::filesystem::path& file, const std::vector<WearerPoseSample>& samples) {
  TextFile out(file);
  std::ofstream& s = exactly(out);
  s << "stamp_ns,px,py,pz,qx,qy,qz,qw,sigma_x,sigma_y,sigma_z,sigma_rx,sigma_ry,sigma_rz\n"
    << std::setprecision(12);
  for (const WearerPoseSample& sample : samples) {
    s << sample.stamp << ',';
    write_vector(s, sample.T_SF.T.p);
    s << ',';
    write_quaternion(s, sample.T_SF.T.q);
    for (Eigen::Index k = 0; k < 6; ++k)
      s << ',' << std::sqrt(sample.T_SF.covariance(k, k));
    s << '\n';
  }
  out.close();
}

void write_known_points(const std::filesystem::path& file, const std::vector<KnownPoint>& points) {
  TextFile out(file);
  std::ofstream& s = exactly(out);
  s << "px,py,pz,u,v\n" << std::setprecision(9);
  for (const KnownPoint& point : points) {
    write_vector(s, point.p_W);
    s << ',' << point.pixel->x() << ',' << point.pixel->y() << '\n';
  }
  out.close();
}

void write_laser(const std::filesystem::path& file, const std::vector<LaserScan>& scans) {
  TextFile out(file);
  std::ofstream& s = out.stream();
  s << "stamp_ns";
  for (std::size_t k = 0; !scans.empty() && k < scans.front().ranges.size(); ++k)
    s << ",range_" << k << "_m";
  s << '\n' << std::fixed << std::setprecision(4);
  for (const LaserScan& scan : scans) {
    s << scan.stamp;
    for (const float range : scan.ranges)
      s << ',' << range;
    s << '\n';
  }
  out.close();
}

void write_laser_geometry(const std::filesystem::path& file,
                          const std::vector<std::pair<std::string, LaserPlan>>& lasers) {
  TextFile out(file);
  std::ofstream& s = exactly(out);
  for (const auto& [name, plan] : lasers) {
    s << name << ":\n  points: " << plan.points << "\n  angle_min_rad: " << plan.angle_of(0)
      << "\n  angle_increment_rad: " << plan.angle_of(1) - plan.angle_of(0)
      << "\n  range_min_m: " << plan.range_min << "\n  range_max_m: " << plan.range_max
      << "\n  range_sigma_m: " << plan.sigma << '\n';
    write_transform(s, "T_BL", "the laser (x the middle of its arc, z up) in the robot", plan.T_BL);
  }
  out.close();
}

void write_imu(const std::filesystem::path& file, const std::vector<BiasedImuSample>& samples) {
  TextFile out(file);
  std::ofstream& s = out.stream();
  s << "stamp_ns,wx,wy,wz,ax,ay,az\n" << std::setprecision(9);
  for (const BiasedImuSample& sample : samples) {
    s << sample.measured.stamp << ',';
    write_vector(s, sample.measured.angular_velocity_I);
    s << ',';
    write_vector(s, sample.measured.acceleration_I);
    s << '\n';
  }
  out.close();
}

void write_imu_biases(const std::filesystem::path& file, const std::vector<BiasedImuSample>& samples) {
  TextFile out(file);
  std::ofstream& s = out.stream();
  s << "stamp_ns,bwx,bwy,bwz,bax,bay,baz\n" << std::setprecision(9);
  for (const BiasedImuSample& sample : samples) {
    s << sample.measured.stamp << ',';
    write_vector(s, sample.gyro_bias);
    s << ',';
    write_vector(s, sample.acceleration_bias);
    s << '\n';
  }
  out.close();
}

void write_odometry(const std::filesystem::path& file, const std::vector<WheelOdometrySample>& rows) {
  TextFile out(file);
  std::ofstream& s = out.stream();
  s << "stamp_ns,x_m,y_m,yaw_rad,speed_mps,turn_rate_radps\n" << std::setprecision(9);
  for (const WheelOdometrySample& row : rows) {
    s << row.stamp << ',' << row.x << ',' << row.y << ',' << row.yaw << ',' << row.speed << ','
      << row.turn_rate << '\n';
  }
  out.close();
}

void write_overlap(const std::filesystem::path& file, const std::vector<OverlapTruth>& overlap) {
  TextFile out(file);
  out.stream() << "stamp_ns,share_of_S,share_of_F\n";
  for (const OverlapTruth& row : overlap)
    out.stream() << row.stamp << ',' << row.share_of_S << ',' << row.share_of_F << '\n';
  out.close();
}

}  // namespace cosight::sim
