#include "tools/trajectory_plot.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>

#include "shared/evaluation/evaluation_error.hpp"

namespace cosight {
namespace {

constexpr std::array<const char*, 6> kColours{"#0060ad", "#d1495b", "#2a9d4a",
                                              "#8e5ea2", "#e08e0b", "#3b8ea5"};
constexpr const char* kTruthColour = "#404040";

/// A text in gnuplot's single quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char letter : text)
    result += letter == '\'' ? std::string("''") : std::string(1, letter);
  return result + "'";
}

/// The truth of the first run in gray, then each run's estimate; columns of the errors csv.
std::string trajectory_curves(const std::vector<PlottedRun>& runs, const char* truth_columns,
                              const char* estimate_columns) {
  std::ostringstream plot;
  plot << "plot " << quoted(runs.front().errors_csv.string()) << " using " << truth_columns
       << " with lines lw 3 lc rgb '" << kTruthColour << "' title 'truth'";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    plot << ", " << quoted(runs[i].errors_csv.string()) << " using " << estimate_columns
         << " with lines lw 2 lc rgb '" << kColours[i % kColours.size()] << "' title "
         << quoted(runs[i].name);
  }
  return plot.str();
}

std::string error_curves(const std::vector<PlottedRun>& runs, int column) {
  std::ostringstream plot;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    plot << (i == 0 ? "plot " : ", ") << quoted(runs[i].errors_csv.string()) << " using 2:" << column
         << " with lines lw 2 lc rgb '" << kColours[i % kColours.size()] << "' title "
         << quoted(runs[i].name);
  }
  return plot.str();
}

/// Gnuplot statements that leave LOW_name and HIGH_name, the extent of one coordinate: that of the truth and
/// of the estimates, these as far as the truth's whole length L beyond it (a run that flies away must not
/// shrink the picture to a dot).
std::string extent_of(const std::vector<PlottedRun>& runs, char name, int truth_column, int estimate_column) {
  std::ostringstream script;
  script << "stats " << quoted(runs.front().errors_csv.string()) << " using " << truth_column << " nooutput\n"
         << "T0 = STATS_min; T1 = STATS_max; LOW_" << name << " = T0; HIGH_" << name << " = T1\n";
  for (const PlottedRun& run : runs) {
    script << "stats " << quoted(run.errors_csv.string()) << " using " << estimate_column << " nooutput\n"
           << "LOW_" << name << " = least(LOW_" << name << ", most(STATS_min, T0 - L))\n"
           << "HIGH_" << name << " = most(HIGH_" << name << ", least(STATS_max, T1 + L))\n";
  }
  return script.str();
}

/// Both axes on one scale, filling a box that is 0.72 times as high as wide.
std::string equal_axes(char across, char up) {
  std::ostringstream script;
  script << "R = 0.54 * most(HIGH_" << across << " - LOW_" << across << ", (HIGH_" << up << " - LOW_" << up
         << ") / 0.72)\nR = most(R, 1e-3)\n"
         << "C = 0.5 * (LOW_" << across << " + HIGH_" << across << "); set xrange [C - R : C + R]\n"
         << "C = 0.5 * (LOW_" << up << " + HIGH_" << up << "); set yrange [C - 0.72 * R : C + 0.72 * R]\n";
  return script.str();
}

std::string extents_of(const std::vector<PlottedRun>& runs) {
  std::ostringstream script;
  script << "least(a, b) = a < b ? a : b\nmost(a, b) = a > b ? a : b\nL = 0\n";
  for (const int column : {3, 4, 5}) {
    script << "stats " << quoted(runs.front().errors_csv.string()) << " using " << column
           << " nooutput\nL = most(L, STATS_max - STATS_min)\n";
  }
  script << extent_of(runs, 'x', 3, 6) << extent_of(runs, 'y', 4, 7) << extent_of(runs, 'z', 5, 8);
  return script.str();
}

std::string script_of(const std::filesystem::path& png, const std::string& title,
                      const std::vector<PlottedRun>& runs) {
  std::ostringstream script;
  script << "set terminal pngcairo size 1400,1000 font 'DejaVu Sans,11'\n"
         << "set output " << quoted(png.string()) << "\nset datafile separator ','\n"
         << "set datafile columnheaders\n"
         << extents_of(runs) << "set grid\nset key inside left top opaque noenhanced\nset tics nomirror\n"
         << "set multiplot layout 2,2 title " << quoted(title) << " noenhanced font ',14'\n"
         << "set size ratio -1\nset title 'from above'\nset xlabel 'x [m]'\nset ylabel 'y [m]'\n"
         << equal_axes('x', 'y') << trajectory_curves(runs, "3:4", "6:7")
         << "\nset title 'from the side'\nset ylabel 'z [m]'\n"
         << equal_axes('x', 'z') << trajectory_curves(runs, "3:5", "6:8")
         << "\nset size noratio\nset xlabel 'time [s]'\nset xrange [0:*]\nset yrange [0:*]\n"
         << "set title 'position error'\nset ylabel 'error [m]'\n"
         << error_curves(runs, 9) << "\nset title 'rotation error'\nset ylabel 'error [deg]'\n"
         << error_curves(runs, 10) << "\nunset multiplot\n";
  return script.str();
}

/// A word for the shell.
std::string shell_word(const std::string& text) {
  std::string result = "'";
  for (const char letter : text)
    result += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return result + "'";
}

}  // namespace

bool plot_trajectories(const std::filesystem::path& png, const std::string& title,
                       const std::vector<PlottedRun>& runs) {
  if (runs.empty()) return false;
  std::filesystem::path script = png;
  script.replace_extension(".gnuplot");
  std::ofstream file(script);
  file << script_of(png, title, runs);
  file.close();
  if (!file) throw EvaluationError(script.string() + ": cannot be written; is the folder there?");
  const std::string command = "gnuplot " + shell_word(script.string()) + " >/dev/null 2>&1";
  return std::system(command.c_str()) == 0;  // NOLINT(concurrency-mt-unsafe): one thread, quoted words only
}

}  // namespace cosight
