#include "robot_agent/vins/misfit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cosight::vins {
namespace {

double misfit(const Window& window, const Landmark& landmark) {
  const Observation& host = landmark.observations.front();
  const Pose T_WSi = window.T_WS(window.slot(host.frame));
  const Eigen::Vector3d f_i = window.ray(landmark);
  double squares = 0.0;
  int count = 0;
  for (std::size_t k = 1; k < landmark.observations.size(); ++k) {
    const Observation& seen = landmark.observations[k];
    if (seen.frame == window.frames.back().id) continue;
    const Pose T_ji = window.T_WS(window.slot(seen.frame)).inverse() * T_WSi;
    const Eigen::Vector3d h = T_ji.q * f_i + landmark.lambda * T_ji.p;
    squares += (h.normalized() - seen.sighting.bearing()).squaredNorm();
    ++count;
  }
  constexpr int kMinSightings = 2;
  return count < kMinSightings ? 0.0 : std::sqrt(squares / count);
}

/// Slow, so that ten seconds between moving vehicles raise it by a third only; slower up than down, since
/// disturbances only add. It begins with what the first window had, which after a start from rest is hardly
/// any: until it is learned it rises fast.
void follow_usual_misfit(Window& window, bool is_learned) {
  const double kUp = is_learned ? 0.03 : 0.3;  // [1/s]
  constexpr double kDown = 0.1;                // [1/s]
  if (window.usual_misfit <= 0.0) window.usual_misfit = window.typical_misfit;
  const std::size_t count = window.frames.size();
  if (count < 2) return;
  const double dt = to_seconds(window.frames[count - 1].stamp - window.frames[count - 2].stamp);
  window.usual_misfit *= std::exp(window.typical_misfit > window.usual_misfit ? kUp * dt : -kDown * dt);
}

}  // namespace

void measure_misfits(Window& window, std::size_t min_observations, bool is_learned) {
  std::vector<double> known;
  for (auto& [id, landmark] : window.landmarks) {
    landmark.misfit = window.is_used(landmark, min_observations) ? misfit(window, landmark) : 0.0;
    if (landmark.misfit > 0.0) known.push_back(landmark.misfit);
  }
  window.typical_misfit = 0.0;
  if (known.empty()) return;
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  window.typical_misfit = *middle;
  follow_usual_misfit(window, is_learned);
}

void watch_for_movers(Window& window, const TrustOptions& options) {
  constexpr int kMinKnown = 10;
  int known = 0;
  int bent = 0;
  for (const auto& [id, landmark] : window.landmarks) {
    if (landmark.misfit <= 0.0) continue;
    ++known;
    if (landmark.misfit > options.misfit_width * window.reference_misfit()) ++bent;
  }
  if (known < kMinKnown) return;
  const double share = static_cast<double>(bent) / known;
  window.many_bend = share > (window.many_bend ? options.many_bend_off : options.many_bend_on);
}

}  // namespace cosight::vins
