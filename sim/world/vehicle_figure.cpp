#include "sim/world/vehicle_figure.hpp"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/random.hpp"
#include "sim/world/decorations.hpp"
#include "sim/world/materials.hpp"
#include "sim/world/sheet.hpp"
#include "sim/world/solids.hpp"

namespace cosight::sim {
namespace {

constexpr double kTexel = 0.012;  // [m]
constexpr double kClearance = 0.15;

/// A panel of metal; lengths in metres from its left and its lower edge.
class Panel {
 public:
  Panel(double width, double height, double gray, RandomStream& random)
      : picture_(static_cast<int>(std::lround(height / kTexel)),
                 static_cast<int>(std::lround(width / kTexel)), CV_8U, cv::Scalar(gray)),
        random_(random) {
    cv::Mat dirt = multi_scale_noise(picture_.size(), 0.3 / kTexel, random) * 7.0;
    cv::add(picture_, dirt, picture_, cv::noArray(), CV_8U);
  }

  cv::Rect rect(double x, double bottom, double width, double height) const {
    const auto texels = [](double metres) { return static_cast<int>(std::lround(metres / kTexel)); };
    return cv::Rect(texels(x), picture_.rows - texels(bottom + height), texels(width), texels(height)) &
           cv::Rect({}, picture_.size());
  }
  Panel& fill(const cv::Rect& place, double gray) {
    if (place.area() > 0) picture_(place).setTo(gray);
    return *this;
  }
  Panel& outline(const cv::Rect& place, double gray) {
    if (place.area() > 0) cv::rectangle(picture_, place, gray, 1);
    return *this;
  }
  Panel& wheel(double x) {
    const cv::Rect hub = rect(x, 0.18, 0.0, 0.0);
    const auto radius = [](double metres) { return static_cast<int>(metres / kTexel); };
    cv::circle(picture_, hub.tl(), radius(0.33), 18, cv::FILLED);
    cv::circle(picture_, hub.tl(), radius(0.19), random_.uniform(90.0, 190.0), cv::FILLED);
    cv::circle(picture_, hub.tl(), radius(0.06), 40, cv::FILLED);
    return *this;
  }
  Panel& poster(const cv::Rect& place) {
    draw_poster(picture_, place, random_);
    return *this;
  }

  const cv::Mat& picture() const { return picture_; }

 private:
  cv::Mat picture_;
  RandomStream& random_;
};

/// Front or rear of a car's body: bumper, plate, lamps.
Panel car_end(double width, double height, double gray, RandomStream& random) {
  Panel panel(width, height, gray, random);
  panel.fill(panel.rect(0.0, 0.0, width, 0.25), 35.0);
  panel.fill(panel.rect(0.05, 0.4, 0.3, 0.18), random.uniform(120.0, 240.0));
  panel.fill(panel.rect(width - 0.35, 0.4, 0.3, 0.18), random.uniform(120.0, 240.0));
  panel.poster(panel.rect(0.5 * width - 0.28, 0.3, 0.56, 0.16));
  panel.fill(panel.rect(0.5 * width - 0.1, 0.6, 0.2, 0.08), random.uniform(160.0, 240.0));
  return panel;
}

Panel car_side(double length, double height, double gray, RandomStream& random) {
  Panel panel(length, height, gray, random);
  panel.fill(panel.rect(0.0, 0.0, length, 0.12), 30.0);
  for (const double x : {0.28, 0.5}) {
    panel.outline(panel.rect(x * length, 0.15, 0.22 * length, height - 0.15), 0.5 * gray);
    panel.fill(panel.rect((x + 0.17) * length, height - 0.2, 0.16, 0.05), 0.4 * gray);
  }
  return panel.wheel(0.19 * length).wheel(0.81 * length);
}

/// A pane in its frame, with what it reflects.
Panel cabin_pane(double width, double height, double gray, RandomStream& random) {
  Panel panel(width, height, gray, random);
  panel.fill(panel.rect(0.08, 0.06, width - 0.16, height - 0.14), random.uniform(25.0, 60.0));
  panel.fill(panel.rect(random.uniform(0.15, 0.6 * width), 0.1, 0.25, 0.3), random.uniform(60.0, 120.0));
  return panel;
}

}  // namespace

VehicleFigure::VehicleFigure(Scene& scene, const Eigen::Vector3d& size, std::uint64_t seed,
                             std::uint64_t number)
    : head_lamp_(sheet_of(scene, cv::Mat(4, 4, CV_8U, cv::Scalar(250)))),
      tail_lamp_(sheet_of(scene, cv::Mat(4, 4, CV_8U, cv::Scalar(170)))) {
  constexpr double kLorryHeight = 2.5;  // [m]
  size.z() > kLorryHeight ? build_lorry(scene, size, seed, number) : build_car(scene, size, seed, number);
}

void VehicleFigure::build_car(Scene& scene, const Eigen::Vector3d& size, std::uint64_t seed,
                              std::uint64_t number) {
  RandomStream random(seed, "car", number);
  const double gray = random.uniform(35.0, 215.0);
  const double waist = 0.55 * size.z();
  const auto sheet = [&](const Panel& panel) { return sheet_of(scene, panel.picture()); };
  parts_.push_back({{0.0, 0.0, kClearance},
                    {size.x(), size.y(), waist},
                    sheet(car_end(size.y(), waist, gray, random)),
                    sheet(car_end(size.y(), waist, gray, random)),
                    sheet(car_side(size.x(), waist, gray, random)),
                    sheet(Panel(size.x(), size.y(), gray, random))});
  const Eigen::Vector3d cabin(0.55 * size.x(), 0.9 * size.y(), size.z() - waist - kClearance);
  parts_.push_back({{-0.06 * size.x(), 0.0, kClearance + waist},
                    cabin,
                    sheet(cabin_pane(cabin.y(), cabin.z(), gray, random)),
                    sheet(cabin_pane(cabin.y(), cabin.z(), gray, random)),
                    sheet(cabin_pane(cabin.x(), cabin.z(), gray, random)),
                    sheet(Panel(cabin.x(), cabin.y(), gray, random))});
}

void VehicleFigure::build_lorry(Scene& scene, const Eigen::Vector3d& size, std::uint64_t seed,
                                std::uint64_t number) {
  RandomStream random(seed, "lorry", number);
  const double gray = random.uniform(60.0, 220.0);
  const double height = size.z() - kClearance;
  Panel rear(size.y(), height, gray, random);
  rear.fill(rear.rect(0.0, 0.0, size.y(), 0.45), 30.0).poster(rear.rect(0.15, 1.5, size.y() - 0.3, 1.1));
  rear.outline(rear.rect(0.05, 0.6, 0.5 * size.y() - 0.05, height - 0.8), 0.4 * gray);
  rear.outline(rear.rect(0.5 * size.y(), 0.6, 0.5 * size.y() - 0.05, height - 0.8), 0.4 * gray);
  rear.poster(rear.rect(0.5 * size.y() - 0.3, 0.5, 0.6, 0.2));
  for (double x = 0.0; x < size.y(); x += 0.4)
    rear.fill(rear.rect(x, 0.3, 0.2, 0.12), 220.0);
  Panel front(size.y(), height, gray, random);
  front.fill(front.rect(0.1, 1.4, size.y() - 0.2, 1.0), 40.0).poster(front.rect(0.5, 0.5, 1.4, 0.4));
  Panel side(size.x(), height, gray, random);
  side.fill(side.rect(0.0, 0.0, size.x(), 0.4), 25.0).poster(side.rect(0.6, 0.8, size.x() - 1.2, 1.7));
  side.wheel(1.2).wheel(size.x() - 2.2).wheel(size.x() - 1.2);
  const auto sheet = [&](const Panel& panel) { return sheet_of(scene, panel.picture()); };
  parts_.push_back({{0.0, 0.0, kClearance},
                    {size.x(), size.y(), height},
                    sheet(front),
                    sheet(rear),
                    sheet(side),
                    sheet(Panel(1.0, 1.0, gray, random))});
}

void VehicleFigure::add_to(std::vector<Quad>& quads, const Pose& T_WV, double light, bool lamps_on) const {
  const auto at = [&](const Eigen::Vector3d& place) {
    return T_WV * Pose{Eigen::Quaterniond::Identity(), place};
  };
  for (const Part& part : parts_) {
    const std::vector<Quad> sides = box_sides(at(part.foot_V), part.size);
    const std::array sheets{&part.front, &part.rear, &part.side, &part.side, &part.top};
    constexpr std::array<float, 5> kFacing{0.9F, 0.9F, 1.0F, 0.85F, 1.15F};
    for (std::size_t k = 0; k < sheets.size(); ++k)
      quads.push_back(wearing(sides[k], *sheets[k], static_cast<float>(light) * kFacing[k]));
  }
  if (!lamps_on) return;
  const Part& body = parts_.front();
  const Eigen::Vector3d lamp(0.02, 0.28, 0.14);
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (0.5 * body.size.y() - 0.2);
    const double x = 0.5 * body.size.x();
    const double z = body.foot_V.z() + 0.45;
    quads.push_back(wearing(box_sides(at({x, y, z}), lamp)[0], head_lamp_));
    quads.push_back(wearing(box_sides(at({-x, y, z}), lamp)[1], tail_lamp_));
  }
}

}  // namespace cosight::sim
