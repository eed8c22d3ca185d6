#include "experiments/urban_canyon/study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace cosight::experiments {
namespace {

using vins::TrackMetrics;
using vins::TrustMode;

/// The paper's Tables 2 and 3.
struct PaperRow {
  TrustMode mode;
  double mean, std, max, drift, improvement;
};
constexpr std::array<PaperRow, 4> kTable2{{{TrustMode::kFixed, 0.33, 0.31, 1.84, 2.16, 0.0},
                                           {TrustMode::kGeometry, 0.32, 0.30, 1.35, 1.85, 3.03},
                                           {TrustMode::kTracking, 0.30, 0.30, 1.70, 2.69, 9.09},
                                           {TrustMode::kRobust, 0.30, 0.29, 1.44, 2.71, 9.09}}};
constexpr std::array<PaperRow, 4> kTable3{{{TrustMode::kFixed, 0.79, 0.96, 5.58, 2.10, 0.0},
                                           {TrustMode::kGeometry, 0.69, 0.86, 6.39, 2.04, 12.66},
                                           {TrustMode::kTracking, 0.64, 0.84, 7.32, 4.10, 18.99},
                                           {TrustMode::kRobust, 0.59, 0.75, 7.26, 3.73, 25.32}}};

/// Cells after printf's rules, as a string.
template <class... Cells>
std::string line(const char* format, Cells... cells) {
  std::array<char, 256> text{};
  const int length = std::snprintf(text.data(), text.size(), format, cells...);
  return {text.data(), static_cast<std::size_t>(length)};
}

std::string paper_cells(const std::string& method, int paper_table) {
  if (paper_table != 2 && paper_table != 3) return "";
  for (const PaperRow& row : paper_table == 2 ? kTable2 : kTable3) {
    if (to_string(row.mode) != method) continue;
    return line(" | %5.2f %5.2f %5.2f %6.2f %6.1f", row.mean, row.std, row.max, row.drift, row.improvement);
  }
  return " |     -     -     -      -      -";
}

MethodSummary average(const std::vector<TrackMetrics>& drives) {
  MethodSummary summary;
  const double share = 1.0 / static_cast<double>(drives.size());
  for (const TrackMetrics& drive : drives) {
    summary.rpe_mean += share * drive.rpe_mean;
    summary.rpe_std += share * drive.rpe_std;
    summary.rpe_max = std::max(summary.rpe_max, drive.rpe_max);
    summary.rpe_frame_mean += share * drive.rpe_frame_mean;
    summary.drift_percent += share * drive.drift_percent;
    summary.outlier_percent += share * drive.outlier_percent;
  }
  return summary;
}

/// Standard error of the improvement: from the drives' own differences, so that a hard drive, hard for all
/// modes, does not hide it.
double improvement_sigma(const std::vector<TrackMetrics>& fixed, const std::vector<TrackMetrics>& other,
                         double fixed_mean) {
  const double n = static_cast<double>(fixed.size());
  if (n < 2.0) return 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const double gain = 100.0 * (fixed[i].rpe_mean - other[i].rpe_mean) / fixed_mean;
    sum += gain;
    squares += gain * gain;
  }
  return std::sqrt(std::max(0.0, squares - sum * sum / n) / (n - 1.0) / n);
}

MethodStudy empty_study(const std::vector<Method>& methods, int drives) {
  MethodStudy study;
  for (const Method& method : methods)
    study.names.push_back(method.name);
  study.metrics.assign(methods.size(), std::vector<TrackMetrics>(static_cast<std::size_t>(drives)));
  return study;
}

}  // namespace

vins::TrackRun run(const vins::TrackSequence& sequence, vins::TrackRunOptions window, const Method& method) {
  window.window.solver.graph.trust = method.trust;
  return vins::run_tracks(sequence, window);
}

std::vector<Method> modes(const vins::TrustOptions& options) {
  std::vector<Method> methods;
  for (const TrustMode mode : {TrustMode::kFixed, TrustMode::kGeometry, TrustMode::kTracking,
                               TrustMode::kRobust, TrustMode::kGuarded}) {
    methods.push_back({to_string(mode), options});
    methods.back().trust.mode = mode;
  }
  return methods;
}

std::vector<Method> readings(const vins::TrustOptions& options) {
  std::vector<Method> methods{{to_string(TrustMode::kFixed), options}};
  methods.front().trust.mode = TrustMode::kFixed;
  const auto add = [&](TrustMode mode, vins::InformationReading information, const std::string& suffix) {
    methods.push_back({to_string(mode) + suffix, options});
    methods.back().trust.mode = mode;
    methods.back().trust.information = information;
  };
  for (const TrustMode mode : {TrustMode::kGeometry, TrustMode::kTracking, TrustMode::kRobust}) {
    add(mode, vins::InformationReading::kScalesRoot, "/root");
    add(mode, vins::InformationReading::kScalesInformation, "/inf");
    add(mode, vins::InformationReading::kAsPrinted, "/printed");
  }
  add(TrustMode::kRobust, vins::InformationReading::kScalesInformation, "/inf/rootN");
  methods.back().trust.threshold = vins::ThresholdReading::kRoot;
  add(TrustMode::kRobust, vins::InformationReading::kScalesInformation, "/inf/Ms.2");
  methods.back().trust.huber_scale = 0.2;
  return methods;
}

vins::TrackRunOptions window_for(const CanyonOptions& canyon) {
  vins::TrackRunOptions options;
  options.noise = canyon.imu;
  options.window.solver.graph.trust.pixel_noise = canyon.calibrated_noise;
  options.start.accelerometer_bias = canyon.start_accelerometer_bias;
  options.start.gyroscope_bias = canyon.start_gyroscope_bias;
  return options;
}

MethodStudy study_canyon(const CanyonOptions& canyon, const vins::TrackRunOptions& window,
                         const std::vector<Method>& methods, unsigned first_seed, int drives,
                         const Workers& workers) {
  MethodStudy study = empty_study(methods, drives);
  study.moving_percent.assign(static_cast<std::size_t>(drives), 0.0);
  workers.run("drives", drives, [&](int i) {
    const CanyonDrive drive = make_canyon_drive(canyon, first_seed + static_cast<unsigned>(i));
    study.moving_percent[static_cast<std::size_t>(i)] = drive.moving_percent;
    for (std::size_t m = 0; m < methods.size() && !workers.must_stop(); ++m)
      study.metrics[m][static_cast<std::size_t>(i)] = run(drive.sequence, window, methods[m]).metrics;
  });
  return study;
}

MethodStudy study_tracks(const vins::TrackSequence& sequence, const vins::TrackRunOptions& window,
                         const std::vector<Method>& methods, const Workers& workers) {
  MethodStudy study = empty_study(methods, 1);
  workers.run("the recorded drive, methods", static_cast<int>(methods.size()), [&](int m) {
    const auto method = static_cast<std::size_t>(m);
    study.metrics[method].front() = run(sequence, window, methods[method]).metrics;
  });
  return study;
}

std::vector<MethodSummary> summarise(const MethodStudy& study) {
  std::vector<MethodSummary> summaries;
  const auto& fixed = study.metrics.front();
  const double fixed_mean = average(fixed).rpe_mean;
  for (const auto& drives : study.metrics) {
    MethodSummary summary = average(drives);
    summary.improvement_percent = 100.0 * (1.0 - summary.rpe_mean / fixed_mean);
    summary.improvement_sigma = improvement_sigma(fixed, drives, fixed_mean);
    for (std::size_t i = 0; i < drives.size(); ++i) {
      summary.worst_max_ratio = std::max(summary.worst_max_ratio, drives[i].rpe_max / fixed[i].rpe_max);
    }
    summaries.push_back(summary);
  }
  return summaries;
}

std::string table(const std::string& title, const MethodStudy& study, int paper_table) {
  std::string text =
      title + ": RPE over one second, " + std::to_string(study.metrics.front().size()) + " drive(s)" +
      (paper_table > 0 ? "; right: the paper's Table " + std::to_string(paper_table) : "") + "\n";
  text += line("%-17s %7s %7s %7s %8s %7s %14s %6s %8s%s\n", "method", "mean m", "std m", "max m", "frame m",
               "drift%", "improved %", "outl.%", "max/vins",
               paper_table > 0 ? " |  mean   std   max drift% impr.%" : "");
  const std::vector<MethodSummary> summaries = summarise(study);
  for (std::size_t m = 0; m < summaries.size(); ++m) {
    const MethodSummary& s = summaries[m];
    text += line("%-17s %7.3f %7.3f %7.2f %8.4f %7.2f %7.1f +-%5.1f %6.1f %8.2f", study.names[m].c_str(),
                 s.rpe_mean, s.rpe_std, s.rpe_max, s.rpe_frame_mean, s.drift_percent, s.improvement_percent,
                 s.improvement_sigma, s.outlier_percent, s.worst_max_ratio);
    text += paper_cells(study.names[m], paper_table) + "\n";
  }
  if (!study.moving_percent.empty()) {
    const double sum = std::accumulate(study.moving_percent.begin(), study.moving_percent.end(), 0.0);
    text += line("%.1f %% of the sightings are on vehicles\n",
                 sum / static_cast<double>(study.moving_percent.size()));
  }
  return text;
}

std::vector<std::pair<std::string, double>> named(const MethodSummary& summary) {
  return {{"rpe_m_mean", summary.rpe_mean},
          {"rpe_m_std", summary.rpe_std},
          {"rpe_m_max", summary.rpe_max},
          {"rpe_frame_m_mean", summary.rpe_frame_mean},
          {"drift_percent", summary.drift_percent},
          {"improvement_percent", summary.improvement_percent},
          {"improvement_percent_sigma", summary.improvement_sigma},
          {"outlier_percent", summary.outlier_percent},
          {"worst_max_ratio", summary.worst_max_ratio}};
}

}  // namespace cosight::experiments
