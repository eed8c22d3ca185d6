#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "sim/carrier.hpp"
#include "sim/city_scenario.hpp"
#include "sim/world/city.hpp"
#include "sim/world/vehicle_figure.hpp"

namespace cosight::sim {

/// A drive through a city with one seed: everything that the car's sensors say, computed when it is asked
/// for. Const functions may be called from several threads.
class CityRun {
 public:
  /// `scenario` has to outlive this.
  CityRun(const CityScenario& scenario, std::uint64_t seed);
  CityRun(const CityRun&) = delete;
  CityRun& operator=(const CityRun&) = delete;

  const CityScenario& scenario() const { return scenario_; }
  const Route& route() const { return route_; }
  const std::vector<Vehicle>& traffic() const { return traffic_; }
  const Carrier& camera() const { return camera_; }
  double duration() const { return route_.duration(); }

  /// T_WB; B is the car's body, its IMU in it.
  Motion T_WB() const;
  std::vector<BiasedImuSample> imu() const;

  /// What the camera may see at a time [s]: the city around it, and who drives there.
  std::vector<Quad> quads_at(double time) const;

 private:
  void add_city_near(std::vector<Quad>& quads, const Eigen::Vector3d& p_W) const;
  void add_traffic_near(std::vector<Quad>& quads, const Eigen::Vector3d& p_W, double time) const;

  const CityScenario& scenario_;
  std::uint64_t seed_;
  std::mt19937_64 random_;  ///< of route and traffic, as at feature level
  Route route_;
  std::vector<Vehicle> traffic_;
  City city_;
  std::vector<VehicleFigure> figures_;  ///< one for each of traffic_
  Carrier camera_;
};

}  // namespace cosight::sim
