#include "robot_agent/wearer/declination.hpp"

#include <GeographicLib/MagneticModel.hpp>
#include <cmath>
#include <numbers>

namespace cosight::wearer {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

double declination(const MagneticPlace& place) {
  const GeographicLib::MagneticModel model(place.name, place.folder.string());
  double east = 0.0;
  double north = 0.0;
  double up = 0.0;
  model(place.year, place.latitude, place.longitude, place.height, east, north, up);
  return std::atan2(east, north);
}

double read_declination(const ConfigNode& node) {
  const double given = kDegree * node.number("declination_deg", 0.0, -180.0, 180.0);
  MagneticPlace place;
  place.folder = node.path("magnetic_model_folder", {});
  place.name = node.text("magnetic_model", place.name);
  place.latitude = node.number("latitude_deg", place.latitude, -90.0, 90.0);
  place.longitude = node.number("longitude_deg", place.longitude, -180.0, 360.0);
  place.height = node.number("height_m", place.height, -1e4, 1e6);
  place.year = node.number("year", place.year, 1900.0, 2100.0);
  if (place.folder.empty()) return given;
  if (node.has("declination_deg"))
    throw node.error("declination_deg", "says the same as magnetic_model_folder; leave one of them out");
  try {
    return declination(place);
  } catch (const GeographicLib::GeographicErr& error) {
    throw node.error("magnetic_model_folder",
                     place.folder.string() + " has no usable " + place.name + ".wmm and " + place.name +
                         ".wmm.cof (" + error.what() +
                         "); geographiclib-get-magnetic of the package geographiclib-tools fetches them, or "
                         "give declination_deg");
  }
}

}  // namespace cosight::wearer
