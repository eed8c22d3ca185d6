#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// One frame on disk. Nothing has been opened yet.
struct ImageEntry {
  Stamp stamp = 0;
  std::uint64_t sequence = 0;  ///< place in the list as it was written, dropped rows included
  std::filesystem::path file;
};

/// Frames in the order of their stamps, and what was dropped to get there.
struct ImageList {
  std::vector<ImageEntry> entries;
  SourceCounters counters;
  std::string description;
};

/// A csv of stamps and files. The columns are found by name: `stamp_ns`, `timestamp` or `t_ns` [ns], or `t_s`
/// [s]; `file` or `filename`. Without a header: stamp [ns], file. Files are relative to the csv, or to the
/// folder `data` or the one named like the csv beside it (EuRoC; `cam0.csv` with `cam0/`).
/// All of these throw DatasetError when there is nothing to play.
ImageList read_image_csv(const std::filesystem::path& csv);

/// KITTI: one time [s] a line, for the images of `folder` in the order of their names.
ImageList read_image_times(const std::filesystem::path& times, const std::filesystem::path& folder);

/// The images of a folder in the order of their names, `rate_hz` a second from stamp zero.
ImageList list_image_folder(const std::filesystem::path& folder, double rate_hz);

/// Finds out which of these `path` is: a csv; an EuRoC folder (`mav0/cam0`, `cam0` or the camera's own, with
/// data.csv); a folder with NAME.csv or `times.txt` inside or beside it; else, given a rate, a plain folder.
ImageList find_images(const std::filesystem::path& path, double rate_hz = 0.0);

}  // namespace cosight
