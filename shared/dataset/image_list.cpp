#include "shared/dataset/image_list.hpp"

#include <algorithm>
#include <initializer_list>
#include <optional>

#include "shared/dataset/csv_rows.hpp"
#include "shared/dataset/dataset_error.hpp"
#include "shared/dataset/number_text.hpp"
#include "shared/dataset/stamp_order.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;

std::optional<std::size_t> first_column(const CsvRows& rows, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const auto column = rows.column(name)) return column;
  }
  return std::nullopt;
}

/// Which columns of an image csv say what.
struct ImageColumns {
  std::size_t stamp = 0;
  std::size_t file = 1;
  bool in_seconds = false;
};

ImageColumns find_columns(const CsvRows& rows) {
  if (rows.header().empty()) return {};
  const auto nanoseconds = first_column(rows, {"stamp_ns", "timestamp", "t_ns"});
  const auto seconds = first_column(rows, {"t_s", "stamp_s"});
  const auto file = first_column(rows, {"file", "filename"});
  if (!file || (!nanoseconds && !seconds)) {
    throw DatasetError(rows.header_place() +
                       ": no column for the stamp (stamp_ns, timestamp, t_ns or t_s) or the file (file, "
                       "filename); write the header 'stamp_ns,file'");
  }
  return {nanoseconds ? *nanoseconds : *seconds, *file, !nanoseconds};
}

/// The folder that the csv's files are in, judged by the first that exists.
fs::path image_folder(const fs::path& csv, const CsvRows& rows, const ImageColumns& columns) {
  const fs::path here = csv.parent_path();
  for (const fs::path& folder : {here, here / "data", here / csv.stem()}) {
    for (std::size_t i = 0; i < std::min<std::size_t>(rows.size(), 20); ++i) {
      const auto cells = rows.row(i);
      if (columns.file < cells.size() && fs::is_regular_file(folder / cells[columns.file])) return folder;
    }
  }
  throw DatasetError(rows.place(0) + ": none of the first images exists, neither in " +
                     (here.empty() ? "." : here.string()) + " nor in data/ or " + csv.stem().string() + "/");
}

ImageList finish(std::vector<ImageEntry> entries, SourceCounters counters, const std::string& name) {
  ImageList list{std::move(entries), counters, ""};
  keep_in_order(list.entries, list.counters);
  if (list.entries.empty()) throw DatasetError(name + ": has no usable row");
  list.description = "images " + name + " (" + std::to_string(list.entries.size()) + " frames)";
  return list;
}

std::vector<fs::path> sorted_images(const fs::path& folder) {
  std::error_code failure;
  fs::directory_iterator files(folder, failure);
  if (failure) throw DatasetError(folder.string() + ": no such folder; check the path");
  std::vector<fs::path> images;
  for (const auto& entry : files) {
    const auto extension = entry.path().extension();
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") images.push_back(entry.path());
  }
  if (images.empty()) throw DatasetError(folder.string() + ": has no .png, .jpg or .jpeg");
  std::sort(images.begin(), images.end());
  return images;
}

}  // namespace

ImageList read_image_csv(const fs::path& csv) {
  const CsvRows rows = CsvRows::read(csv);
  const ImageColumns columns = find_columns(rows);
  const fs::path folder = image_folder(csv, rows, columns);
  SourceCounters counters;
  std::vector<ImageEntry> entries;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto cells = rows.row(i);
    std::optional<Stamp> stamp;
    if (std::max(columns.stamp, columns.file) < cells.size() && !cells[columns.file].empty()) {
      stamp =
          columns.in_seconds ? parse_seconds(cells[columns.stamp]) : parse_nanoseconds(cells[columns.stamp]);
    }
    if (!stamp) {
      ++counters.not_finite;
      continue;
    }
    entries.push_back({*stamp, i, folder / cells[columns.file]});
  }
  return finish(std::move(entries), counters, csv.string());
}

ImageList read_image_times(const fs::path& times, const fs::path& folder) {
  const CsvRows rows = CsvRows::read(times);
  const auto images = sorted_images(folder);
  if (rows.size() != images.size()) {
    throw DatasetError(times.string() + ": has " + std::to_string(rows.size()) + " times for the " +
                       std::to_string(images.size()) + " images of " + folder.string());
  }
  SourceCounters counters;
  std::vector<ImageEntry> entries;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (const auto stamp = parse_seconds(rows.row(i)[0])) {
      entries.push_back({*stamp, i, images[i]});
    } else {
      ++counters.not_finite;
    }
  }
  return finish(std::move(entries), counters, folder.string());
}

ImageList list_image_folder(const fs::path& folder, double rate_hz) {
  std::vector<ImageEntry> entries;
  for (auto& image : sorted_images(folder)) {
    const auto index = static_cast<double>(entries.size());
    entries.push_back({from_seconds(index / rate_hz), entries.size(), std::move(image)});
  }
  return finish(std::move(entries), {}, folder.string());
}

ImageList find_images(const fs::path& path, double rate_hz) {
  if (!fs::exists(path)) throw DatasetError(path.string() + ": no such file or folder; check the path");
  if (fs::is_regular_file(path)) return read_image_csv(path);
  for (const char* csv : {"mav0/cam0/data.csv", "cam0/data.csv", "data.csv", "cam0.csv"}) {
    if (fs::is_regular_file(path / csv)) return read_image_csv(path / csv);
  }
  if (rate_hz > 0.0) return list_image_folder(path, rate_hz);
  const fs::path folder = path.has_filename() ? path : path.parent_path();
  fs::path csv = folder;
  csv += ".csv";
  if (fs::is_regular_file(csv)) return read_image_csv(csv);
  for (const fs::path& times : {folder / "times.txt", folder.parent_path() / "times.txt"}) {
    if (fs::is_regular_file(times)) return read_image_times(times, folder);
  }
  throw DatasetError(path.string() + ": has neither a csv of stamps nor times.txt; give input.rate_hz");
}

}  // namespace cosight
