#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include "experiments/csv_file.hpp"
#include "experiments/figures.hpp"
#include "experiments/observability/rank.hpp"
#include "shared/program/program.hpp"

namespace {

using namespace cosight;               // NOLINT(google-build-using-namespace): a program's own file
using namespace cosight::experiments;  // NOLINT(google-build-using-namespace)

constexpr std::array<const char*, 5> kCaseNames{"none", "one", "two", "three", "four"};
constexpr std::uint64_t kFirstSeed = 1;

/// Ranks over all states drawn; they are the same at every one, or the state is not generic.
struct Ranks {
  int lowest = static_cast<int>(PlanarSystem::kDim);
  int highest = 0;

  void add(int rank) {
    lowest = std::min(lowest, rank);
    highest = std::max(highest, rank);
  }
};

struct CaseResult {
  Ranks symbolic;
  Ranks numeric;
  bool scale_unobservable = true;
};

CaseResult examine(const ObservabilityCase& setup, int states, CsvFile& csv) {
  CaseResult result;
  for (int i = 0; i < states; ++i) {
    const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(i);
    result.symbolic.add(symbolic_rank(setup, seed));
    result.scale_unobservable = result.scale_unobservable && scale_is_unobservable(setup, seed);
    const Eigen::VectorXd values = singular_values(setup, seed);
    result.numeric.add(numeric_rank(values));
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      csv.row({static_cast<double>(setup.pseudo_stereo), static_cast<double>(setup.order),
               setup.common_anchor ? 1.0 : 0.0, setup.at_rest ? 1.0 : 0.0, static_cast<double>(k + 1),
               values(k)});
    }
  }
  return result;
}

void print_row(const char* setup, const ObservabilityCase& chosen, const CaseResult& result) {
  std::printf("%-34s %-5s  %5d  %4d  %6d..%d  %10d  %s\n", setup, kCaseNames.at(chosen.pseudo_stereo),
              chosen.order, result.symbolic.highest, result.numeric.lowest, result.numeric.highest,
              static_cast<int>(PlanarSystem::kDim) - result.symbolic.highest,
              result.scale_unobservable ? "unobservable" : "-");
}

struct Variant {
  const char* name;
  ObservabilityCase setup;
};

void run(const std::filesystem::path& folder, int states) {
  constexpr std::array<Variant, 5> kVariants{{
      {"the paper's", {}},
      {"camera at rest", {.at_rest = true}},
      {"second order", {.order = 2}},
      {"first seen from one place", {.common_anchor = true}},
      {"from one place, third order", {.order = 3, .common_anchor = true}},
  }};
  CsvFile csv(folder / "singular_values.csv",
              "pseudo_stereo,order,common_anchor,at_rest,index,singular_value");
  Figures figures;
  std::printf("%-34s %-5s  %5s  %4s  %9s  %10s  %s\n", "system (10 states, 4 bearings)", "depth", "order",
              "rank", "in double", "modes lost", "scale");
  for (const Variant& variant : kVariants) {
    for (std::size_t depths = 0; depths <= 2; ++depths) {
      ObservabilityCase setup = variant.setup;
      setup.pseudo_stereo = depths;
      const CaseResult result = examine(setup, states, csv);
      print_row(variant.name, setup, result);
      if (&variant == &kVariants.front())
        figures.set("rank", kCaseNames.at(depths), static_cast<double>(result.symbolic.highest));
    }
  }
  csv.close();
  figures.write_summary(folder);
}

}  // namespace

int main(int argc, char** argv) {
  Program program({.name = "experiment_observability",
                   .purpose = "Rank of the observability matrix of the planar collaborative system.",
                   .examples = "  experiment_observability --out runs/observability\n"});
  std::filesystem::path folder;
  int states = 200;
  program.command_line().add_option("--out", folder, "folder for the results")->required();
  program.command_line()
      .add_option("--states", states, "random states")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  return program.run(argc, argv, [&](const ConfigFile& config, const std::atomic<bool>&) {
    config.refuse_unknown_keys();
    std::filesystem::create_directories(folder);
    run(folder, states);
    return ExitCode::kDone;
  });
}
