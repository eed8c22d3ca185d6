#include "tools/compare_command.hpp"

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/evaluation/evaluation_error.hpp"
#include "tools/run_agreement.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kNameWidth = 26;
constexpr int kColumnWidth = 16;

struct CompareArguments {
  fs::path reference;
  std::vector<fs::path> runs;
  fs::path json;
};

std::string name_of(const fs::path& run) {
  return fs::absolute(run / "").parent_path().filename().string();
}

void print_head(const std::string& title, const std::vector<fs::path>& runs) {
  std::cout << std::left << std::setw(kNameWidth) << title << std::right;
  for (const fs::path& run : runs)
    std::cout << std::setw(kColumnWidth) << name_of(run);
  std::cout << '\n';
}

void print_row(const std::string& name, const std::vector<std::optional<double>>& values) {
  std::cout << std::left << std::setw(kNameWidth) << name << std::right << std::setprecision(4);
  for (const auto& value : values) {
    std::cout << std::setw(kColumnWidth);
    if (value)
      std::cout << *value;
    else
      std::cout << "-";
  }
  std::cout << '\n';
}

void print_agreement(const CompareArguments& arguments, const std::vector<std::vector<Metric>>& columns) {
  print_head("against " + name_of(arguments.reference), arguments.runs);
  for (std::size_t row = 0; row < columns.front().size(); ++row) {
    std::vector<std::optional<double>> values;
    for (const auto& column : columns)
      values.push_back(column[row].value);
    print_row(columns.front()[row].name, values);
  }
}

void print_counters(const std::vector<fs::path>& runs) {
  const std::vector<CounterRow> rows = differing_counters(runs);
  if (rows.empty()) {
    std::cout << "nothing was counted differently\n";
    return;
  }
  print_head("counted differently", runs);
  for (const CounterRow& row : rows)
    print_row(row.name, {row.counts.begin(), row.counts.end()});
}

void write_json(const CompareArguments& arguments, const std::vector<std::vector<Metric>>& columns) {
  Json all = Json::object();
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const Metric& metric : columns[i])
      all[name_of(arguments.runs[i])][metric.name] = metric.value ? Json(*metric.value) : Json(nullptr);
  std::ofstream file(arguments.json);
  file << all.dump(2) << '\n';
  file.close();
  if (!file) throw EvaluationError(arguments.json.string() + ": cannot be written");
}

void run(const CompareArguments& arguments) {
  std::vector<std::vector<Metric>> columns;
  for (const fs::path& run : arguments.runs)
    columns.push_back(agreement(run, arguments.reference));
  print_agreement(arguments, columns);
  std::vector<fs::path> all{arguments.reference};
  all.insert(all.end(), arguments.runs.begin(), arguments.runs.end());
  print_counters(all);
  if (!arguments.json.empty()) write_json(arguments, columns);
}

}  // namespace

void add_compare_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("compare", "how far runs of the same data agree, live, replayed or offline");
  const auto arguments = std::make_shared<CompareArguments>();
  command->add_option("REFERENCE", arguments->reference, "run folder that the others are compared with")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("RUN", arguments->runs, "run folders")->required()->check(CLI::ExistingDirectory);
  command->add_option("--json", arguments->json, "write the figures to this file too");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cosight
