#pragma once

#include "robot_agent/vins/adaptive_model.hpp"
#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

/// How far each landmark's sightings are from where the window's present states put it: root mean square
/// [rad] over all its sightings but the first and that of the newest frame, whose state is a prediction. Zero
/// with fewer than two such sightings: nothing is known against it.
///
/// Fills in Landmark::misfit and Window::typical_misfit, their median. A point on a moving vehicle bends away
/// from every static explanation; the median is the noise of the static majority, whatever the camera. Before
/// a red light the static ones may be few, and the median is that of the vehicles: so the median's own usual
/// value is followed too, over a minute, as Window::usual_misfit; within seconds until it `is_learned`.
void measure_misfits(Window& window, std::size_t min_observations, bool is_learned = true);

/// Whether so many landmarks bend away that the guarded mode has to act: sets Window::many_bend when the
/// share of landmarks whose misfit is above `misfit_width` times the reference goes over `many_bend_on`, and
/// takes it back when it falls under `many_bend_off`. Needs measure_misfits().
void watch_for_movers(Window& window, const TrustOptions& options);

}  // namespace cosight::vins
