#include "sim/city_run.hpp"

#include "sim/city/streets.hpp"
#include "sim/random.hpp"

namespace cosight::sim {
namespace {

constexpr double kReach = 350.0;         // the city is seen so far [m]
constexpr double kTrafficReach = 160.0;  // [m]

double reach_of(const Quad& quad) {
  return 0.5 * (quad.edge_s + quad.edge_t).norm();
}

}  // namespace

CityRun::CityRun(const CityScenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      seed_(seed),
      random_(seed),
      route_(scenario.length, random_, scenario.route),
      traffic_(make_traffic(route_, scenario.traffic, random_)),
      city_(build_city(streets_of(route_, traffic_), scenario.city, kGroundBelowCar, seed)),
      camera_{scenario.camera,
              Camera(scenario.camera.lens),
              Exposure(scenario.camera.exposure, mix_bits(seed + 1)),
              {},
              {},
              ticks(scenario.camera.timing, route_.duration(), RandomStream(seed, "car camera"))} {
  for (std::size_t k = 0; k < traffic_.size(); ++k)
    figures_.emplace_back(city_.scene, traffic_[k].size, seed, k);
  camera_.T_WC = [this](double time) { return route_.T_WB(time) * scenario_.camera.T_BC; };
  camera_.quads_at = [this](double time) { return quads_at(time); };
}

Motion CityRun::T_WB() const {
  return [this](double time) { return route_.T_WB(time); };
}

std::vector<BiasedImuSample> CityRun::imu() const {
  return simulate_imu(scenario_.imu, T_WB(), duration(), seed_);
}

std::vector<Quad> CityRun::quads_at(double time) const {
  const Eigen::Vector3d p_W = route_.T_WB(time).p;
  std::vector<Quad> quads;
  add_city_near(quads, p_W);
  add_traffic_near(quads, p_W, time);
  return quads;
}

void CityRun::add_city_near(std::vector<Quad>& quads, const Eigen::Vector3d& p_W) const {
  for (const Quad& quad : city_.scene.quads) {
    const Eigen::Vector3d middle = quad.origin + 0.5 * (quad.edge_s + quad.edge_t);
    if ((middle - p_W).norm() < kReach + reach_of(quad)) quads.push_back(quad);
  }
}

void CityRun::add_traffic_near(std::vector<Quad>& quads, const Eigen::Vector3d& p_W, double time) const {
  for (std::size_t k = 0; k < traffic_.size(); ++k) {
    if (time < traffic_[k].from || time > traffic_[k].to) continue;
    const Pose T_WV = traffic_[k].T_WV(time);
    if ((T_WV.p - p_W).norm() > kTrafficReach) continue;
    const Eigen::Vector3d middle = T_WV * Eigen::Vector3d(0.0, 0.0, 1.0);
    figures_[k].add_to(quads, T_WV, city_.lighting.at(middle, Eigen::Vector3d::UnitZ()),
                       scenario_.city.night);
  }
}

}  // namespace cosight::sim
