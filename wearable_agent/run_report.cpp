#include "wearable_agent/run_report.hpp"

#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace cosight::wearable {
namespace {

double per_second(double amount, double duration) {
  return duration > 0.0 ? amount / duration : 0.0;
}

std::string line(const char* key, double value) {
  char text[96];
  std::snprintf(text, sizeof text, "%s: %.6g\n", key, value);
  return text;
}

std::string line(const char* key, std::uint64_t value) {
  return std::string(key) + ": " + std::to_string(value) + "\n";
}

std::string source_yaml(const char* name, const SourceCounters& counters) {
  return std::string(name) + ":\n" + line("  read", counters.delivered) +
         line("  unreadable", counters.unreadable) + line("  wrong_size", counters.wrong_size) +
         line("  not_finite", counters.not_finite) + line("  stamp_went_back", counters.stamp_went_back) +
         line("  gaps", counters.gaps);
}

}  // namespace

std::string status_text(const RunReport& report, int frame_readers) {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "%.1f s  %" PRIu64 " frames (%.1f/s)  %" PRIu64 " orientations  %.2f MB/s  %d readers  lost %" PRIu64,
      report.duration, report.sent.frames,
      per_second(static_cast<double>(report.sent.frames), report.duration), report.sent.orientations,
      1e-6 * per_second(static_cast<double>(report.sent.bytes), report.duration), frame_readers,
      report.frames.lost() + report.orientations.lost() + report.sent.not_taken);
  return text;
}

std::string summary_yaml(const RunReport& report) {
  return line("frames_sent", report.sent.frames) + line("orientations_sent", report.sent.orientations) +
         line("bytes_sent", report.sent.bytes) + line("not_taken", report.sent.not_taken) +
         line("duration_s", report.duration) +
         line("frames_per_s", per_second(static_cast<double>(report.sent.frames), report.duration)) +
         line("bytes_per_s", per_second(static_cast<double>(report.sent.bytes), report.duration)) +
         line("cpu_percent", 100.0 * per_second(report.cpu_seconds, report.duration)) +
         line("peak_memory_mb", report.peak_memory_mb) + source_yaml("input_frames", report.frames) +
         source_yaml("input_orientations", report.orientations);
}

void write_summary(const std::filesystem::path& file, const RunReport& report) {
  std::ofstream out(file);
  out << summary_yaml(report);
  if (!out.flush())
    throw std::runtime_error(file.string() + ": can't be written; check the folder and free space");
}

}  // namespace cosight::wearable
