#include "sim/world/figures.hpp"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/world/decorations.hpp"
#include "sim/world/materials.hpp"
#include "sim/world/sheet.hpp"
#include "sim/world/solids.hpp"

namespace cosight::sim {
namespace {

constexpr double kTexel = 0.004;  // [m]

cv::Mat face_picture() {
  // Around the head; the face is in the middle of the first quarter's border, at x = 0 of the ring.
  cv::Mat picture(60, 140, CV_8U, cv::Scalar(165));
  cv::rectangle(picture, {0, 0, 140, 16}, 60, cv::FILLED);
  cv::rectangle(picture, {35, 0, 70, 42}, 60, cv::FILLED);
  for (const int x : {8, 131})
    cv::circle(picture, {x, 26}, 3, 40, cv::FILLED);
  for (const int x : {0, 134})
    cv::rectangle(picture, {x, 44, 6, 3}, 110, cv::FILLED);
  return picture;
}

Pose tilted(const Pose& T_WP, const Eigen::Vector3d& hip, double angle) {
  return T_WP * Pose{Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY())), hip};
}

/// An upright or hanging limb: its upper end at `joint`, swung by `angle` about the y axis.
void add_limb(std::vector<Quad>& quads, const Pose& T_WP, const Eigen::Vector3d& joint, double angle,
              double radius, double length, const Quad& sheet) {
  const Pose T_WX = tilted(T_WP, joint, angle) * Pose{Eigen::Quaterniond::Identity(), {0, 0, -length}};
  for (const Quad& side : ring_sides(T_WX, radius, length, 8, sheet))
    quads.push_back(side);
}

void add_box(std::vector<Quad>& quads, const Pose& T_WX, const Eigen::Vector3d& size, const Quad& sheet) {
  constexpr std::array<float, 6> kLight{0.95F, 0.85F, 0.9F, 0.9F, 1.1F, 0.5F};
  const std::vector<Quad> sides = box_sides(T_WX, size);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    quads.push_back(wearing(sides[k], sheet, kLight[k]));
  }
}

}  // namespace

PersonFigure::PersonFigure(Scene& scene, std::uint64_t seed, std::uint64_t person)
    : trousers_(sheet_of(
          scene, paint_material(Material::kFabric, 0.5, 0.9, kTexel, RandomStream(seed, "trousers", person)),
          0.6F)),
      shirt_(sheet_of(
          scene, paint_material(Material::kFabric, 0.5, 0.6, kTexel, RandomStream(seed, "shirt", person)),
          1.0F)),
      skin_(sheet_of(scene, face_picture(), 1.0F)) {}

void PersonFigure::add_to(std::vector<Quad>& quads, const Posture& posture) const {
  constexpr double kHip = 0.88, kShoulder = 1.42;  // [m]
  const double swing = 0.42 * posture.stride * std::sin(posture.gait);
  const Pose& T_WP = posture.T_WP;
  add_limb(quads, T_WP, {0, 0.1, kHip}, -swing, 0.08, kHip - 0.02, trousers_);
  add_limb(quads, T_WP, {0, -0.1, kHip}, swing, 0.08, kHip - 0.02, trousers_);
  add_limb(quads, T_WP, {0, 0.25, kShoulder}, 0.8 * swing, 0.05, 0.6, shirt_);
  add_limb(quads, T_WP, {0, -0.25, kShoulder}, -0.8 * swing, 0.05, 0.6, shirt_);
  add_box(quads, T_WP * Pose{Eigen::Quaterniond::Identity(), {0, 0, kHip - 0.05}}, {0.22, 0.4, 0.62}, shirt_);
  const Pose T_WX = posture.T_WH * Pose{Eigen::Quaterniond::Identity(), {0.0, 0.0, -0.14}};
  for (const Quad& side : ring_sides(T_WX, 0.09, 0.25, 12, skin_))
    quads.push_back(side);
}

RobotFigure::RobotFigure(Scene& scene, std::uint64_t seed)
    : cover_([&] {
        RandomStream random(seed, "robot");
        cv::Mat picture = paint_material(Material::kConcrete, 0.5, 0.4, kTexel, random);
        draw_poster(picture, {picture.cols / 4, picture.rows / 4, picture.cols / 2, picture.rows / 2},
                    random);
        return sheet_of(scene, picture, 0.7F);
      }()) {}

void RobotFigure::add_to(std::vector<Quad>& quads, const Pose& T_WB) const {
  const auto at = [&](const Eigen::Vector3d& place) {
    return T_WB * Pose{Eigen::Quaterniond::Identity(), place};
  };
  add_box(quads, at({-0.05, 0, 0.08}), {0.5, 0.45, 0.24}, cover_);
  add_box(quads, at({-0.1, 0, 0.32}), {0.06, 0.06, 0.5}, cover_);
}

}  // namespace cosight::sim
