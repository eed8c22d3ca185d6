#include "sim/world/city.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/random.hpp"
#include "sim/world/city_ground.hpp"
#include "sim/world/decorations.hpp"
#include "sim/world/house_front.hpp"
#include "sim/world/materials.hpp"
#include "sim/world/sheet.hpp"
#include "sim/world/solids.hpp"
#include "sim/world/vehicle_figure.hpp"

namespace cosight::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLampHeight = 8.0;     // [m]
constexpr double kLampLateral = 8.0;    // from the middle of the street [m]
constexpr double kParkedLateral = 6.3;  // likewise

/// Where the lamps of the main streets are.
std::vector<Vector3d> lamps_along(const std::vector<Street>& streets, double spacing, double ground) {
  std::vector<Vector3d> lamps;
  for (const Street& street : streets) {
    if (!street.main) continue;
    double side = 1.0;
    for (double along = 0.5 * spacing; along < street.length; along += spacing) {
      const Vector2d place = street.at(along, side * kLampLateral);
      lamps.emplace_back(place.x(), place.y(), ground + kLampHeight);
      side = -side;
    }
  }
  return lamps;
}

Lighting light_of(const std::vector<Street>& streets, const CityPlan& plan, double ground) {
  if (!plan.night) return {{}, {.ambient = 1.0, .lamp = 0.0, .reach = 8.0}};
  return {lamps_along(streets, plan.lamp_spacing, ground), {.ambient = 0.2, .lamp = 0.9, .reach = 8.0}};
}

/// Builds one thing after the other.
class Builder {
 public:
  Builder(const std::vector<Street>& streets, const CityPlan& plan, double ground, std::uint64_t seed)
      : streets_(streets),
        plan_(plan),
        ground_(ground),
        seed_(seed),
        city_{{}, light_of(streets, plan, ground)} {}

  City build() {
    lay_ground(city_.scene, streets_, ground_, city_.lighting, seed_);
    std::size_t number = 0;
    for (const HouseLine& line : house_lines(streets_))
      build_row(line, RandomStream(seed_, "houses", number++));
    build_towers();
    set_lamp_posts();
    park_cars();
    hang_sky();
    return std::move(city_);
  }

 private:
  /// Upright, from `from` to `to` on the ground, seen from its left.
  Quad upright(const Vector2d& from, const Vector2d& to, double height) const {
    Quad quad;
    quad.origin = {to.x(), to.y(), ground_ + height};
    quad.edge_s = {from.x() - to.x(), from.y() - to.y(), 0.0};
    quad.edge_t = {0.0, 0.0, -height};
    return quad;
  }

  /// By day the sun makes one side of a street brighter.
  double sun_on(const Quad& quad) const {
    if (plan_.night) return 1.0;
    const Vector3d outward = -quad.inward_normal().normalized();
    return 0.95 + 0.25 * outward.dot(Vector3d(0.6, -0.75, 0.28));
  }

  void add_front(const Quad& quad, RandomStream random) {
    HouseFront front = paint_house_front(quad.edge_s.norm(), quad.edge_t.norm(), plan_.front_texel,
                                         RandomStream(random.bits(), "front"));
    city_.lighting.bake(quad, front.picture);
    if (plan_.night) light_windows(front, 0.25, RandomStream(random.bits(), "windows"));
    const Quad sheet = sheet_of(city_.scene, front.picture, static_cast<float>(sun_on(quad)));
    city_.scene.quads.push_back(wearing(quad, sheet));
  }

  /// Houses side by side, each a little farther back than the line or not.
  void build_row(const HouseLine& line, RandomStream random) {
    const Vector2d along = (line.to - line.from).normalized();
    const Vector2d back(along.y(), -along.x());
    const double length = (line.to - line.from).norm();
    for (double x = 0.0; x < length;) {
      double width = random.uniform(10.0, 22.0);
      if (length - x - width < 8.0) width = length - x;
      const Vector2d shift =
          random.chance(0.5) ? Vector2d(random.uniform(0.0, 2.2) * back) : Vector2d(0.0, 0.0);
      build_house(line.from + x * along + shift, line.from + (x + width) * along + shift, back, random);
      x += width;
    }
  }

  void build_house(const Vector2d& from, const Vector2d& to, const Vector2d& back, RandomStream& random) {
    constexpr double kDepth = 4.0;     // of the sides that can be seen [m]
    constexpr double kBetween = 0.02;  // so that no two surfaces are one [m]
    const double height = random.uniform(plan_.lowest_house, plan_.highest_house);
    const Vector2d inset = kBetween * (to - from).normalized();
    add_front(upright(from, to, height), RandomStream(random.bits(), "house"));
    add_front(upright(from + inset + kDepth * back, from + inset, height),
              RandomStream(random.bits(), "left"));
    add_front(upright(to - inset, to - inset + kDepth * back, height), RandomStream(random.bits(), "right"));
  }

  void add_box(const Vector2d& place, double bottom, const Vector3d& size, const Quad& sheet) {
    const Pose T_WX{Eigen::Quaterniond::Identity(), {place.x(), place.y(), ground_ + bottom}};
    const std::vector<Quad> sides = box_sides(T_WX, size);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d middle = sides[k].origin + 0.5 * (sides[k].edge_s + sides[k].edge_t);
      const double light = city_.lighting.at(middle, -sides[k].inward_normal().normalized());
      city_.scene.quads.push_back(wearing(sides[k], sheet, static_cast<float>(light * sun_on(sides[k]))));
    }
  }

  /// High houses that look over the roofs.
  void build_towers() {
    constexpr double kTexel = 0.12;
    constexpr std::size_t kLooks = 8;
    std::vector<Quad> looks;
    for (std::size_t k = 0; k < kLooks; ++k) {
      looks.push_back(sheet_of(
          city_.scene, paint_house_front(26.0, 90.0, kTexel, RandomStream(seed_, "tower", k)).picture));
    }
    RandomStream random(seed_, "towers");
    for (const Street& street : streets_) {
      if (!street.main) continue;
      for (double along = 0.0; along < street.length; along += random.uniform(30.0, 80.0)) {
        const double side = random.chance(0.5) ? 1.0 : -1.0;
        const Vector2d place = street.at(along, side * random.uniform(40.0, 110.0));
        const Vector3d size(random.uniform(18.0, 30.0), random.uniform(18.0, 30.0),
                            random.uniform(35.0, 110.0));
        const bool in_the_way = std::any_of(streets_.begin(), streets_.end(),
                                            [&](const Street& other) { return other.contains(place, 22.0); });
        if (!in_the_way) add_box(place, 0.0, size, looks[static_cast<std::size_t>(random.below(kLooks))]);
      }
    }
  }

  void set_lamp_posts() {
    const Quad post = sheet_of(
        city_.scene, paint_material(Material::kConcrete, 0.3, kLampHeight, 0.03, RandomStream(seed_, "post")),
        0.7F);
    const Quad lamp = sheet_of(city_.scene, cv::Mat(4, 4, CV_8U, cv::Scalar(plan_.night ? 255 : 190)));
    RandomStream random(seed_, "posts");
    for (const Vector3d& place : lamps_along(streets_, plan_.lamp_spacing, ground_)) {
      add_box(place.head<2>(), 0.0, {0.16, 0.16, kLampHeight}, post);
      const Pose T_WL{Eigen::Quaterniond::Identity(), place};
      for (const Quad& side : box_sides(T_WL, {0.5, 0.5, 0.25}))
        city_.scene.quads.push_back(wearing(side, lamp));
      if (random.chance(0.6)) hang_traffic_sign(place.head<2>(), random);
    }
  }

  void hang_traffic_sign(const Vector2d& post, RandomStream& random) {
    cv::Mat sign(40, 40, CV_8U, cv::Scalar(random.uniform(60.0, 220.0)));
    draw_poster(sign, {2, 2, 36, 36}, random);
    add_box(post, random.uniform(2.2, 3.2), {0.9, 0.9, 0.9}, sheet_of(city_.scene, sign));
  }

  void park_cars() {
    constexpr std::size_t kLooks = 10;
    constexpr double kPlace = 6.5;   // [m]
    constexpr double kClear = 10.0;  // of other streets [m]
    std::vector<VehicleFigure> looks;
    for (std::size_t k = 0; k < kLooks; ++k)
      looks.emplace_back(city_.scene, Vector3d(4.4, 1.8, 1.5), seed_, 1000 + k);
    RandomStream random(seed_, "parked");
    for (const Street& street : streets_) {
      if (!street.main) continue;
      const double yaw = std::atan2(street.direction.y(), street.direction.x());
      for (const double side : {-1.0, 1.0}) {
        for (double along = kPlace; along < street.length - kPlace; along += kPlace) {
          const Vector2d place = street.at(along, side * kParkedLateral);
          const auto blocks = [&](const Street& other) {
            return &other != &street && other.contains(place, kClear);
          };
          const auto look = static_cast<std::size_t>(random.below(kLooks));
          if (!random.chance(plan_.parked_share) || std::any_of(streets_.begin(), streets_.end(), blocks))
            continue;
          const Pose T_WV{Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())),
                          {place.x(), place.y(), ground_}};
          looks[look].add_to(city_.scene.quads, T_WV, city_.lighting.at(T_WV.p, Vector3d::UnitZ()), false);
        }
      }
    }
  }

  /// A box around everything, so far away that no parallax shows; seen from inside.
  void hang_sky() {
    constexpr double kFar = 6000.0;  // [m]
    cv::Mat haze(8, 1, CV_8U);
    for (int row = 0; row < haze.rows; ++row)
      haze.at<unsigned char>(row, 0) = static_cast<unsigned char>(plan_.night ? 10 + row : 200 + 4 * row);
    const Quad sheet = sheet_of(city_.scene, haze);
    const Vector2d middle = streets_[streets_.size() / 2].start;
    const Vector2d corners[] = {middle + Vector2d(-kFar, -kFar), middle + Vector2d(kFar, -kFar),
                                middle + Vector2d(kFar, kFar), middle + Vector2d(-kFar, kFar)};
    for (std::size_t k = 0; k < 4; ++k)
      city_.scene.quads.push_back(wearing(upright(corners[k], corners[(k + 1) % 4], kFar), sheet));
    // Below the horizon, behind houses that end: as dark as the ground.
    Quad ground;
    ground.origin = {corners[3].x(), corners[3].y(), ground_ - 0.5};
    ground.edge_s = {2.0 * kFar, 0.0, 0.0};
    ground.edge_t = {0.0, -2.0 * kFar, 0.0};
    const Quad earth = sheet_of(city_.scene, cv::Mat(4, 4, CV_8U, cv::Scalar(plan_.night ? 15 : 80)));
    city_.scene.quads.push_back(wearing(ground, earth));
  }

  const std::vector<Street>& streets_;
  const CityPlan& plan_;
  double ground_;
  std::uint64_t seed_;
  City city_;
};

}  // namespace

City build_city(const std::vector<Street>& streets, const CityPlan& plan, double ground, std::uint64_t seed) {
  return Builder(streets, plan, ground, seed).build();
}

}  // namespace cosight::sim
