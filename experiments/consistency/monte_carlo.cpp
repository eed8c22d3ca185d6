#include "experiments/consistency/monte_carlo.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace cosight::experiments {
namespace {

void add(const NisSum& from, NisSum& to) {
  to.nis += from.nis;
  to.rows += from.rows;
}

void add(const MatchCounts& from, MatchCounts& to) {
  to.right += from.right;
  to.right_fused += from.right_fused;
  to.wrong += from.wrong;
  to.wrong_fused += from.wrong_fused;
  to.validation_s += from.validation_s;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

ConsistencyCourse monte_carlo(const RunOptions& options, int runs) {
  constexpr unsigned kFirstSeed = 1'000;
  ConsistencyCourse course;
  course.runs = runs;
  course.mean.resize(static_cast<std::size_t>(options.steps));
  for (int r = 0; r < runs; ++r) {
    ConsistencyRun run(kFirstSeed + static_cast<unsigned>(r), options);
    StepResult now;
    for (StepResult& mean : course.mean) {
      now = run.step();
      mean.pose_nees += now.pose_nees / runs;
      mean.position_nees += now.position_nees / runs;
      mean.position_error += now.position_error / runs;
      mean.heading_error += now.heading_error / runs;
      add(now.pixels, mean.pixels);
      add(now.points, mean.points);
      add(now.joint, mean.joint);
      add(now.matches, course.matches);
    }
    course.final_errors.push_back(now.position_error);
    course.heading_errors.push_back(now.heading_error);
  }
  return course;
}

double mean_final_error(const ConsistencyCourse& course) {
  return mean(course.final_errors);
}

Band average_band(int dof, int runs) {
  return {ekf::chi_squared_quantile(0.025, dof * runs) / runs,
          ekf::chi_squared_quantile(0.975, dof * runs) / runs};
}

ConsistencyFigures figures_of(const ConsistencyCourse& course) {
  const Band pose = average_band(6, course.runs);
  const Band position = average_band(3, course.runs);
  const double share = 1.0 / static_cast<double>(course.mean.size());
  ConsistencyFigures figures;
  NisSum pixels;
  NisSum points;
  NisSum joint;
  for (const StepResult& step : course.mean) {
    figures.pose_in_band += pose.contains(step.pose_nees) ? share : 0.0;
    figures.position_in_band += position.contains(step.position_nees) ? share : 0.0;
    figures.pose_nees += share * step.pose_nees;
    figures.position_nees += share * step.position_nees;
    add(step.pixels, pixels);
    add(step.points, points);
    add(step.joint, joint);
  }
  figures.nis_pixel = pixels.mean_per_row();
  figures.nis_point = points.mean_per_row();
  figures.nis_joint = joint.mean_per_row();
  return figures;
}

void summarise(const ConsistencyCourse& course, const std::string& mode, Figures& figures) {
  const ConsistencyFigures f = figures_of(course);
  constexpr double kPercent = 100.0;
  figures.set(mode, "nees_in_band_percent", kPercent * f.pose_in_band);
  figures.set(mode, "pose_nees_mean", f.pose_nees);
  figures.set(mode, "position_in_band_percent", kPercent * f.position_in_band);
  figures.set(mode, "position_nees_mean", f.position_nees);
  figures.set(mode, "nis_pixel_per_row", f.nis_pixel);
  figures.set(mode, "nis_point_per_row", f.nis_point);
  figures.set(mode, "nis_joint_per_row", f.nis_joint);
  figures.set(mode, "final_error_m_mean", mean(course.final_errors));
  figures.set(mode, "final_error_m_median", median(course.final_errors));
  figures.set(mode, "final_error_m_max",
              *std::max_element(course.final_errors.begin(), course.final_errors.end()));
  figures.set(mode, "heading_error_deg_max",
              *std::max_element(course.heading_errors.begin(), course.heading_errors.end()) * 180.0 /
                  std::numbers::pi);
  figures.set(mode, "runs", course.runs);
}

void summarise_matches(const ConsistencyCourse& course, const std::string& mode, Figures& figures) {
  constexpr double kPercent = 100.0;
  constexpr double kMicroseconds = 1e6;
  const MatchCounts& m = course.matches;
  const double frames = static_cast<double>(course.runs) * static_cast<double>(course.mean.size());
  figures.set(mode, "wrong_accepted_percent", m.wrong > 0 ? kPercent * m.wrong_fused / m.wrong : 0.0);
  figures.set(mode, "right_lost_percent", kPercent * (m.right - m.right_fused) / m.right);
  figures.set(mode, "validation_us", kMicroseconds * m.validation_s / frames);
  figures.set(mode, "final_error_m_mean", mean(course.final_errors));
  figures.set(mode, "final_error_m_max",
              *std::max_element(course.final_errors.begin(), course.final_errors.end()));
}

}  // namespace cosight::experiments
