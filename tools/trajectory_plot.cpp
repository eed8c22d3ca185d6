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

std::string script_of(const std::filesystem::path& png, const std::string& title,
                      const std::vector<PlottedRun>& runs) {
  std::ostringstream script;
  script << "set terminal pngcairo size 1400,1000 font 'DejaVu Sans,11'\n"
         << "set output " << quoted(png.string())
         << "\nset datafile separator ','\nset datafile columnheaders\n"
         << "set grid\nset key below horizontal noenhanced\nset tics nomirror\nset offsets graph 0.05, graph "
            "0.05, "
            "graph 0.05, graph 0.05\n"
         << "set multiplot layout 2,2 title " << quoted(title) << " noenhanced font ',14'\n"
         << "set size ratio -1\nset title 'from above'\nset xlabel 'x [m]'\nset ylabel 'y [m]'\n"
         << trajectory_curves(runs, "3:4", "6:7") << "\nset title 'from the side'\nset ylabel 'z [m]'\n"
         << trajectory_curves(runs, "3:5", "6:8")
         << "\nset size noratio\nset xlabel 'time [s]'\nset yrange [0:*]\n"
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
