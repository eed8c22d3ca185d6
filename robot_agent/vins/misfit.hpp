#pragma once

#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

/// How far each landmark's sightings are from where the window's present states put it: root mean square
/// [rad] over all its sightings but the first and that of the newest frame, whose state is a prediction. Zero
/// with fewer than two such sightings: nothing is known against it.
///
/// Fills in Landmark::misfit and Window::typical_misfit, their median. A point on a moving vehicle bends away
/// from every static explanation; the median is the noise of the static majority, whatever the camera.
void measure_misfits(Window& window, std::size_t min_observations);

}  // namespace cosight::vins
