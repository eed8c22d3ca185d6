// Whole frames of the robot: CollaborativeSlam::process on images, without decoding and without DDS. Each
// benchmark runs its sequence several times; a frame's time is its median over the runs, in CPU time of
// all threads. Counters: ms_median and ms_p99 over the frames, and how much there was to do in the median
// frame.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "robot_agent/slam/collaborative_slam.hpp"
#include "shared/image/image_codec.hpp"
#include "tests/bench/rendered_walk.hpp"
#include "tools/prepare/real_sequence.hpp"

namespace cosight::bench {
namespace {

using slam::CollaborativeSlam;
using slam::SlamOptions;
using MakeSlam = std::function<CollaborativeSlam()>;

/// CPU time of all threads: what other programs do does not count, what OpenCV's own threads do does.
Stamp cpu_time() {
  std::timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return time.tv_sec * kNanosecondsPerSecond + time.tv_nsec;
}

/// Of sorted or unsorted values; `share` 0 … 1.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// What one frame took, run by run, and what it did.
struct FrameRecord {
  std::vector<double> ms;
  FrameEstimate estimate;
};

void run_once(CollaborativeSlam slam, const std::vector<FrameBundle>& bundles,
              std::vector<FrameRecord>& records) {
  for (std::size_t i = 0; i < bundles.size(); ++i) {
    const Stamp began = cpu_time();
    FrameEstimate estimate = slam.process(bundles[i]);
    records[i].ms.push_back(static_cast<double>(cpu_time() - began) * 1e-6);
    records[i].estimate = std::move(estimate);
  }
}

template <class Of>
double median_of(const std::vector<FrameRecord>& records, Of of) {
  std::vector<double> values;
  for (const FrameRecord& record : records)
    values.push_back(static_cast<double>(of(record)));
  return quantile(std::move(values), 0.5);
}

/// `warm_up` frames are run and not counted: the map has to fill first.
void time_frames(benchmark::State& state, const std::vector<FrameBundle>& bundles, const MakeSlam& make_slam,
                 std::size_t warm_up, int runs = 5) {
  std::vector<FrameRecord> records(bundles.size());
  for (auto _ : state) {
    for (int run = 0; run < runs; ++run)
      run_once(make_slam(), bundles, records);
  }
  records.erase(records.begin(), records.begin() + static_cast<std::ptrdiff_t>(warm_up));
  std::vector<double> ms;
  for (const FrameRecord& record : records)
    ms.push_back(quantile(record.ms, 0.5));
  state.counters["ms_median"] = quantile(ms, 0.5);
  state.counters["ms_p99"] = quantile(ms, 0.99);
  state.counters["ms_worst"] = quantile(ms, 1.0);
  state.counters["landmarks"] = median_of(records, [](const auto& r) { return r.estimate.landmarks; });
  state.counters["searched"] = median_of(records, [](const auto& r) { return r.estimate.search.searched; });
  state.counters["fused"] = median_of(
      records, [](const auto& r) { return r.estimate.search.fused_pixels + r.estimate.pseudo_stereo.fused; });
  state.counters["described"] =
      median_of(records, [](const auto& r) { return r.estimate.pseudo_stereo.described; });
  const auto stage = [&](double StageTimings::*part) {
    return median_of(records, [part](const auto& r) { return r.estimate.timings.*part; });
  };
  state.counters["search_ms"] = stage(&StageTimings::search);
  state.counters["pseudo_stereo_ms"] = stage(&StageTimings::pseudo_stereo);
  state.counters["validate_ms"] = stage(&StageTimings::validate);
  state.counters["update_ms"] = stage(&StageTimings::update);
  state.counters["map_ms"] = stage(&StageTimings::map);
  const FrameEstimate& last = records.back().estimate;
  state.counters["tracking_at_end"] = last.tracking == Tracking::kTracking ? 1.0 : 0.0;
}

/// The goal's setting: 100 landmarks in the map, 40 measured a frame, known ones by guided ZNCC, new points
/// by ORB.
SlamOptions collaborative_options() {
  SlamOptions options;
  options.start.T_WS = RenderedWalk::T_WS(0);
  options.pseudo_stereo.matching = slam::Matching::kOrb;
  options.map.max_landmarks = 100;
  options.map.min_distance_px = 20;
  options.search.max_measured = 40;
  return options;
}

/// `interval_s`: between two worn frames that are used; 0: the cameras meet in every frame.
void frame_collaborative(benchmark::State& state, double interval_s) {
  const RenderedWalk& walk = RenderedWalk::instance();
  SlamOptions options = collaborative_options();
  options.pseudo_stereo.interval_s = interval_s;
  constexpr std::size_t kWarmUp = 20;
  time_frames(
      state, walk.bundles(), [&] { return CollaborativeSlam(walk.camera(), options, {}, cpu_time); },
      kWarmUp);
}
BENCHMARK_CAPTURE(frame_collaborative, every_frame, 0.0)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame_collaborative, default_interval, SlamOptions{}.pseudo_stereo.interval_s)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// The same hall with as many landmarks in the filter as are measured.
void frame_growth(benchmark::State& state) {
  const RenderedWalk& walk = RenderedWalk::instance();
  SlamOptions options = collaborative_options();
  options.pseudo_stereo.matching = slam::Matching::kBand;
  options.map.max_landmarks = static_cast<int>(state.range(0));
  options.map.min_distance_px = 9;
  options.search.max_measured = static_cast<int>(state.range(0));
  options.candidates.max_candidates = static_cast<int>(state.range(0));
  const std::vector<FrameBundle> bundles(walk.bundles().begin(), walk.bundles().begin() + 50);
  constexpr std::size_t kWarmUp = 30;  // the map fills before
  time_frames(
      state, bundles, [&] { return CollaborativeSlam(walk.camera(), options, {}, cpu_time); }, kWarmUp, 1);
}
BENCHMARK(frame_growth)
    ->Arg(25)
    ->Arg(50)
    ->Arg(100)
    ->Arg(200)
    ->Arg(400)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

std::filesystem::path data_folder() {
  const char* given = std::getenv("COSIGHT_DATA");
  return given != nullptr ? given : std::filesystem::path(COSIGHT_SOURCE_DIR) / ".." / "shared" / "data";
}

/// MonoSLAM's own desk and setting: one camera of 320x240, 15 landmarks in the filter, about seven measured.
void frame_mono_small(benchmark::State& state) {
  const auto folder = data_folder() / "scenelib";
  if (!std::filesystem::exists(folder)) {
    state.SkipWithError(("no real data: " + folder.string() + " does not exist").c_str());
    return;
  }
  const RealSequence sequence = read_scenelib(folder);
  std::vector<FrameBundle> bundles;
  for (const RecordedImage& recorded : sequence.robot_images) {
    FrameBundle bundle;
    bundle.stamp = recorded.stamp;
    bundle.sequence = bundles.size();
    bundle.image = std::make_shared<GrayImage>(read_image(recorded.file));
    bundles.push_back(std::move(bundle));
  }
  SlamOptions options;
  options.mode = slam::Mode::kMono;
  options.map.max_landmarks = 15;
  options.search.max_measured = 12;
  const auto make = [&] {
    return CollaborativeSlam(sequence.robot_camera, options, sequence.known_points, cpu_time);
  };
  constexpr std::size_t kWarmUp = 20;
  time_frames(state, bundles, make, kWarmUp);
}
BENCHMARK(frame_mono_small)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cosight::bench
