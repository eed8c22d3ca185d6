#include "sim/world/city_ground.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/core.hpp>

#include "sim/random.hpp"
#include "sim/world/materials.hpp"
#include "sim/world/sheet.hpp"

namespace cosight::sim {
namespace {

using Eigen::Vector2d;

constexpr double kTile = 20.0;   // [m]
constexpr double kTexel = 0.04;  // [m]
constexpr double kKerb = 7.3;    // from the middle of a main street [m]
constexpr double kLane = 3.4;    // [m]
constexpr double kLine = 0.14;   // width of a painted line [m]

/// One tile of the ground, seen from above.
class Tile {
 public:
  Tile(const Vector2d& corner, const cv::Mat& asphalt)
      : corner_(corner), asphalt_(asphalt), picture_(asphalt.clone()) {}

  cv::Mat& picture() { return picture_; }

  /// The tile's texels in a rectangle of a street's own coordinates.
  cv::Rect region(const Street& street, double along_0, double along_1, double left_0, double left_1) const {
    const Vector2d a = street.at(along_0, left_0) - corner_;
    const Vector2d b = street.at(along_1, left_1) - corner_;
    const auto texels = [](double metres) {
      return static_cast<int>(std::lround(std::clamp(metres, 0.0, kTile) / kTexel));
    };
    return {cv::Point(texels(std::min(a.x(), b.x())), texels(kTile - std::max(a.y(), b.y()))),
            cv::Point(texels(std::max(a.x(), b.x())), texels(kTile - std::min(a.y(), b.y())))};
  }
  void brighten(const cv::Rect& region, double gray) {
    if (region.area() > 0) picture_(region) += gray;
  }
  void bare(const cv::Rect& region) {
    if (region.area() > 0) asphalt_(region).copyTo(picture_(region));
  }

 private:
  Vector2d corner_;
  const cv::Mat& asphalt_;
  cv::Mat picture_;
};

void lay_pavement(Tile& tile, const Street& street) {
  for (const double side : {-1.0, 1.0}) {
    tile.brighten(tile.region(street, 0.0, street.length, side * kKerb, side * street.half_width), 55.0);
    tile.brighten(tile.region(street, 0.0, street.length, side * kKerb, side * (kKerb + 0.2)), 40.0);
  }
}

void paint_marks(Tile& tile, const Street& street) {
  constexpr double kDash = 3.0, kPeriod = 9.0;  // [m]
  for (const double left : {-0.5 * kLane, 0.5 * kLane}) {
    for (double along = 0.0; along < street.length; along += kPeriod)
      tile.brighten(tile.region(street, along, along + kDash, left, left + kLine), 110.0);
  }
  for (const double left : {-1.5 * kLane, 1.5 * kLane})
    tile.brighten(tile.region(street, 0.0, street.length, left, left + kLine), 90.0);
  // Crossings for walkers, before both of its corners.
  constexpr double kBeforeEnd = 75.0, kStripe = 0.6;  // [m]
  for (const double along : {kBeforeEnd, street.length - kBeforeEnd}) {
    for (double left = -1.5 * kLane + 0.4; left < 1.5 * kLane; left += 2.0 * kStripe)
      tile.brighten(tile.region(street, along, along + 3.0, left, left + kStripe), 95.0);
  }
}

Quad square(const Vector2d& corner, double z) {
  Quad quad;
  quad.origin = {corner.x(), corner.y() + kTile, z};
  quad.edge_s = {kTile, 0.0, 0.0};
  quad.edge_t = {0.0, -kTile, 0.0};
  return quad;
}

bool meets(const Street& street, const Vector2d& corner) {
  return (street.low().array() < corner.array() + kTile).all() &&
         (street.high().array() > corner.array()).all();
}

cv::Mat lay_tile(const Vector2d& corner, const std::vector<Street>& near, const cv::Mat& asphalt) {
  Tile tile(corner, asphalt);
  for (const Street& street : near)
    if (street.main) lay_pavement(tile, street);
  for (const Street& street : near) {  // the carriageway of one goes through the pavement of another
    const double half = street.main ? kKerb : street.half_width;
    tile.bare(tile.region(street, 0.0, street.length, -half, half));
  }
  for (const Street& street : near)
    if (street.main) paint_marks(tile, street);
  return tile.picture();
}

cv::Mat paint_asphalt(RandomStream random) {
  cv::Mat asphalt = paint_material(Material::kConcrete, kTile, kTile, kTexel, random);
  asphalt *= 0.62;
  for (int k = 0; k < 5; ++k) {  // where it was mended
    const cv::Rect patch = cv::Rect(random.below(asphalt.cols), random.below(asphalt.rows),
                                    30 + random.below(90), 20 + random.below(60)) &
                           cv::Rect({}, asphalt.size());
    asphalt(patch) -= random.uniform(8.0, 25.0);
  }
  return asphalt;
}

}  // namespace

void lay_ground(Scene& scene, const std::vector<Street>& streets, double z, const Lighting& lighting,
                std::uint64_t seed) {
  constexpr std::size_t kSorts = 6;
  std::vector<cv::Mat> asphalt;
  for (std::size_t k = 0; k < kSorts; ++k)
    asphalt.push_back(paint_asphalt(RandomStream(seed, "asphalt", k)));
  Vector2d low = streets.front().low();
  Vector2d high = streets.front().high();
  for (const Street& street : streets) {
    low = low.cwiseMin(street.low());
    high = high.cwiseMax(street.high());
  }
  std::size_t count = 0;
  for (double y = low.y(); y < high.y(); y += kTile) {
    for (double x = low.x(); x < high.x(); x += kTile) {
      const Vector2d corner(x, y);
      std::vector<Street> near;
      std::copy_if(streets.begin(), streets.end(), std::back_inserter(near),
                   [&](const Street& street) { return meets(street, corner); });
      if (near.empty()) continue;
      cv::Mat picture = lay_tile(corner, near, asphalt[++count % kSorts]);
      const Quad quad = square(corner, z);
      lighting.bake(quad, picture);
      scene.quads.push_back(wearing(quad, sheet_of(scene, picture)));
    }
  }
}

}  // namespace cosight::sim
