#pragma once

#include <vector>

#include "robot_agent/ekf/filter.hpp"

namespace cosight::slam {

/// What is assumed of a point without depth: the median depth of the landmarks in view [m]; 4 m without any.
double usual_depth(const std::vector<ekf::PixelPrediction>& predictions);

/// Half of the nearest landmark's depth [m], 0 without any: a band that goes on to the lens would cost ten
/// times as much, for points that the next frames see anyway.
double expected_near(const std::vector<ekf::PixelPrediction>& predictions);

/// The median of the predictions' standard deviations, one axis [px]. There must be one.
double median_sigma(const std::vector<ekf::PixelPrediction>& predictions);

}  // namespace cosight::slam
