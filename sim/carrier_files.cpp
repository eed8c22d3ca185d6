#include "sim/carrier_files.hpp"

#include <array>
#include <cstdio>
#include <string>

#include "sim/parallel.hpp"

namespace cosight::sim {
namespace {

std::string image_name(std::size_t frame) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%06zu.jpg", frame);
  return name.data();
}

}  // namespace

void write_camera(const CarrierFolder& camera) {
  const auto& [carrier, folder] = camera;
  write_calibration(folder / "calibration.yaml", carrier.camera.calibration(), carrier.plan.T_BC);
  std::vector<Stamp> stamps;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < carrier.ticks.size(); ++k) {
    stamps.push_back(carrier.ticks[k].stamp);
    names.push_back("cam0/" + image_name(k));
  }
  write_image_list(folder / "cam0.csv", stamps, names);
}

void write_frames(const std::vector<CarrierFolder>& cameras, unsigned threads,
                  const std::atomic<bool>& stop) {
  std::vector<std::size_t> starts;  // of each camera's jobs
  std::size_t jobs = 0;
  for (const CarrierFolder& camera : cameras) {
    std::filesystem::create_directories(camera.folder / "cam0");
    starts.push_back(jobs);
    jobs += camera.carrier.ticks.size();
  }
  const auto make_films = [&] {
    std::vector<Film> films;
    for (const CarrierFolder& camera : cameras)
      films.push_back(camera.carrier.film());
    return films;
  };
  const auto work = [&](std::vector<Film>& films, std::size_t job) {
    if (stop) return;
    std::size_t k = cameras.size() - 1;
    while (job < starts[k])
      --k;
    const std::size_t frame = job - starts[k];
    write_bytes(cameras[k].folder / "cam0" / image_name(frame),
                cameras[k].carrier.sample(films[k], frame).bytes);
  };
  for_each_job(jobs, threads, make_films, work);
}

std::vector<TimedPose> truth_of(const Carrier& carrier) {
  std::vector<TimedPose> poses;
  for (const Tick& tick : carrier.ticks)
    poses.push_back({tick.stamp, carrier.T_WC(tick.time)});
  return poses;
}

std::vector<TimedPose> truth_of(const Motion& T_WB, double duration) {
  std::vector<TimedPose> poses;
  for (const Tick& tick : ticks({.rate = 100.0}, duration, RandomStream(0, "truth")))
    poses.push_back({tick.stamp, T_WB(tick.time)});
  return poses;
}

}  // namespace cosight::sim
