#include "experiments/urban_canyon/courses.hpp"

#include "experiments/csv_file.hpp"

namespace cosight::experiments {
namespace {

namespace fs = std::filesystem;

void write_path(const fs::path& file, const Trajectory& path) {
  CsvFile csv(file, "t,x,y");
  for (const StampedPose& pose : path)
    csv.row({to_seconds(pose.stamp - path.front().stamp), pose.T_WC.p.x(), pose.T_WC.p.y()});
  csv.close();
}

void write_errors(const fs::path& file, const std::vector<double>& rpe) {
  CsvFile csv(file, "t,rpe");
  for (std::size_t i = 0; i < rpe.size(); ++i)
    csv.row({static_cast<double>(i + 1), rpe[i]});
  csv.close();
}

void write_window(const fs::path& file, const vins::TrackRun& run, double focal_length) {
  CsvFile csv(file, "t,g,n,misfit,acts");
  for (const vins::WindowReport& report : run.reports) {
    csv.row({to_seconds(report.stamp - run.estimate.front().stamp), report.geometry_factor,
             report.mean_times_tracked, focal_length * report.typical_misfit, report.many_bend ? 1.0 : 0.0});
  }
  csv.close();
}

}  // namespace

void write_courses(const fs::path& folder, const vins::TrackSequence& sequence,
                   const vins::TrackRunOptions& window, const std::vector<Method>& methods) {
  write_path(folder / "truth.csv", sequence.truth);
  for (const Method& method : methods) {
    const vins::TrackRun drive = run(sequence, window, method);
    write_path(folder / ("path_" + method.name + ".csv"), drive.estimate);
    write_errors(folder / ("rpe_" + method.name + ".csv"), drive.rpe);
    write_window(folder / ("window_" + method.name + ".csv"), drive, method.trust.focal_length);
  }
}

}  // namespace cosight::experiments
