#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>

#include "shared/geometry/pose.hpp"

namespace cosight::wearer {

/// How a laser is carried. B: the robot's body on the floor, x forward, y left, z up. L: rays in its x-y
/// plane; upside down is allowed, a slope of more than some degrees is not.
struct LaserMount {
  Pose T_BL{Eigen::Quaterniond::Identity(), {0.2, 0.0, 0.3}};
  double sigma = 0.015;  ///< of a range [m]
};

/// Two lasers as the simulated robot carries them: the front one looks ahead, the rear one back.
inline std::map<std::string, LaserMount> default_lasers() {
  return {{"laser_front", LaserMount{}},
          {"laser_rear", {{Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0), {-0.3, 0.0, 0.3}}, 0.015}}};
}

/// What of a scan is looked at, and what of it is furniture.
struct SceneOptions {
  double max_range = 12.0;        ///< what is further away is not looked at [m]
  double max_person_range = 6.0;  ///< a leg further away brings back too few rays [m]
  /// Rays that end inside this box of B meet the robot itself [m].
  Eigen::AlignedBox2d own_body{Eigen::Vector2d(-0.3, -0.25), Eigen::Vector2d(0.2, 0.25)};
  double cluster_gap = 0.12;    ///< points nearer to each other are of one thing [m]
  double furniture_gap = 0.08;  ///< what is nearer to furniture may be a part of it [m]
  double wall_length = 0.7;     ///< points on a straight line of this length are a wall [m]
  double cell = 0.1;            ///< of the map of what stands still [m]
  double static_after = 0.8;    ///< a place occupied for so long belongs to the furniture [s]
  double person_radius = 0.45;  ///< around a tracked person nothing becomes furniture [m]
};

/// What a person looks like to a laser.
struct PersonModel {
  double leg_radius = 0.08;     ///< at the laser's height, with trousers [m]
  double max_leg_width = 0.26;  ///< a wider cluster is two legs [m]
  double max_stride = 0.65;     ///< between the axes of the two legs [m]
  double leg_spread = 0.16;     ///< of a leg about the body's axis, 1 sigma each way [m]
  double pair_sigma = 0.025;    ///< of the middle of two legs about the body's axis, each way [m]
  double torso_radius = 0.14;   ///< from the surface to the axis [m]
  double max_width = 0.8;       ///< of a torso, arms included [m]
  double hip_height = 0.85;     ///< a laser above this sees the torso; lower it for a long skirt [m]
  double hidden_scans = 8.0;    ///< in a row that a hidden leg misleads alike: those of a third of a second
};

/// How people move, and when a track of one begins and ends.
struct TrackOptions {
  double acceleration = 0.8;    ///< density of the white acceleration [m/s^2/sqrt(Hz)]
  double unknown_motion = 1.5;  ///< the same while the robot's own motion is unknown
  double start_speed = 0.8;     ///< of a new track, 1 sigma each way [m/s]
  double gate = 13.8;           ///< squared Mahalanobis distance of a sighting: 99.9 % of two dof
  double clutter = 0.2;         ///< things like a leg that are none [1/m^2]
  double drop_after = 1.0;      ///< a stranger unseen for so long is forgotten [s]
  double lost_sigma = 0.5;      ///< wearer's worst axis: beyond it no pose is given [m]
  double forget_sigma = 1.5;    ///< beyond it the wearer is looked for anew [m]
};

/// Who of the people is the wearer.
struct StartOptions {
  /// Where the wearer stands at first, in B [m]. Nothing: the nearest person-like thing ahead.
  std::optional<Eigen::Vector2d> p_B;
  double radius = 1.0;        ///< around p_B [m]
  double max_range = 3.5;     ///< of the nearest, when p_B is not given [m]
  double max_bearing = 1.3;   ///< likewise, to either side [rad]
  double seen_for = 0.3;      ///< before it is believed [s]
  double search_speed = 1.0;  ///< a wearer who was lost may have got away this fast [m/s]
};

/// Where the free camera F is on the body, and the SLAM camera S on the robot. H: the head, between the ears,
/// x where the face points, z up.
struct HeadOptions {
  double height = 1.65;                   ///< of H above the floor [m]
  double height_sigma = 0.015;            ///< with the bob of the walk [m]
  double sway_sigma = 0.012;              ///< of H about the body's axis, each way [m]
  Eigen::Vector3d p_HF{0.11, 0.0, 0.06};  ///< the camera on the head [m]
  Pose T_BS{Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {0.1, 0.0, 0.85}};  ///< optical frame
  double tilt_sigma = 0.002;     ///< roll and pitch of the robot [rad]
  double max_ahrs_age = 0.1;     ///< of an orientation that is used for p_HF [s]
  double max_heading_age = 2.0;  ///< of the robot's heading in W; odometry carries it on [s]
};

/// An empty one suits the simulated robot.
struct WearerOptions {
  std::map<std::string, LaserMount> lasers = default_lasers();
  SceneOptions scene;
  PersonModel person;
  TrackOptions track;
  StartOptions start;
  HeadOptions head;
};

}  // namespace cosight::wearer
