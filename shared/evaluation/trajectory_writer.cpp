#include "shared/evaluation/trajectory_writer.hpp"

#include <fstream>
#include <iomanip>

#include "shared/dataset/number_text.hpp"
#include "shared/evaluation/evaluation_error.hpp"

namespace cosight {
namespace {

void write_tum_row(std::ostream& out, const StampedPose& pose) {
  const auto& [q, p] = pose.T_WC;
  out << seconds_text(pose.stamp) << ' ' << p.x() << ' ' << p.y() << ' ' << p.z() << ' ' << q.x() << ' '
      << q.y() << ' ' << q.z() << ' ' << q.w() << '\n';
}

void write_euroc_row(std::ostream& out, const StampedPose& pose) {
  const auto& [q, p] = pose.T_WC;
  out << pose.stamp << ',' << p.x() << ',' << p.y() << ',' << p.z() << ',' << q.w() << ',' << q.x() << ','
      << q.y() << ',' << q.z() << '\n';
}

void write_kitti_row(std::ostream& out, const StampedPose& pose) {
  const Eigen::Matrix3d R = pose.T_WC.q.toRotationMatrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      out << R(row, column) << ' ';
    out << pose.T_WC.p(row) << (row < 2 ? ' ' : '\n');
  }
}

}  // namespace

void write_trajectory(std::ostream& out, const Trajectory& trajectory, TrajectoryFormat format,
                      const std::string& comment) {
  out << std::fixed << std::setprecision(9);
  if (format == TrajectoryFormat::kTum) out << "# " << comment << '\n';
  if (format == TrajectoryFormat::kEuroc) {
    out << "#timestamp [ns],p_WC_x [m],p_WC_y [m],p_WC_z [m],q_WC_w [],q_WC_x [],q_WC_y [],q_WC_z []\n";
  }
  for (const StampedPose& pose : trajectory) {
    switch (format) {
      case TrajectoryFormat::kTum:
        write_tum_row(out, pose);
        break;
      case TrajectoryFormat::kEuroc:
        write_euroc_row(out, pose);
        break;
      case TrajectoryFormat::kKitti:
        write_kitti_row(out, pose);
        break;
    }
  }
}

void write_trajectory(const std::filesystem::path& path, const Trajectory& trajectory,
                      TrajectoryFormat format, const std::string& comment) {
  std::ofstream file(path);
  write_trajectory(file, trajectory, format, comment);
  file.close();
  if (!file)
    throw EvaluationError(path.string() + ": cannot be written; is the folder there and the disk not full?");
}

}  // namespace cosight
