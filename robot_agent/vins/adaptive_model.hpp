#pragma once

#include <Eigen/Core>
#include <vector>

namespace cosight::vins {

/// How much the window trusts what it sees (the paper's four methods, and one more).
enum class TrustMode {
  kFixed,     ///< `vins`: every sighting alike, as VINS-Mono
  kGeometry,  ///< `ac_g`: by the geometry of the features, V26 without N
  kTracking,  ///< `ac_gn`: by geometry and by how often the feature was tracked, V26
  kRobust,    ///< `ac_me`: the same, and a Huber threshold that grows with N, V26 + V30
  kGuarded,   ///< `ac_me_guarded`: see guarded_weight()
};

const char* to_string(TrustMode mode);

/// What stands in V26 for the weight w = N s / g. The paper calls F_c / 1.5 an information; in VINS-Mono it
/// is the square root of one. The default errs least in all modes, on recorded and simulated drives; see
/// docs/vins.md.
enum class InformationReading {
  kScalesRoot,         ///< root = F_c/1.5 * w: V26 put where VINS-Mono has its square root
  kScalesInformation,  ///< root = F_c/1.5 * sqrt(w): w multiplies the information
  kAsPrinted,          ///< root = sqrt(F_c/1.5 * w): V26 is the information, V27 to the letter
};

enum class ThresholdReading {
  kLinear,  ///< k = M_s N (V30 as printed)
  kRoot,    ///< k = M_s sqrt(N)
};

enum class Kernel { kNone, kCauchy, kHuber };

/// One sighting's part in the cost: residual times `sqrt_information`, then the kernel.
struct Trust {
  double sqrt_information = 0.0;  ///< one over the standard deviation of a bearing [1/rad]
  Kernel kernel = Kernel::kNone;
  double threshold = 1.0;  ///< of the kernel, in standard deviations
};

/// The model of the visual measurements (the paper's section 4).
struct TrustOptions {
  TrustMode mode = TrustMode::kGuarded;
  InformationReading information = InformationReading::kScalesInformation;
  ThresholdReading threshold = ThresholdReading::kLinear;
  Kernel fixed_kernel = Kernel::kCauchy;  ///< of all modes but ac_me, which has its own Huber
  double focal_length = 460.0;            ///< F_c [px]
  double pixel_noise = 1.5;               ///< V27 [px]
  double scale = 0.02;                    ///< s of V26
  double geometry_scale = 0.2;            ///< s of V26 without N; the paper gives none
  double huber_scale = 0.02;              ///< M_s of V30 [standard deviations]
  double misfit_width = 1.5;              ///< guarded: misfit up to which nothing is taken off, in usual ones
  double many_bend_on = 0.35;  ///< guarded: share of features with more than that from which it acts
  double many_bend_off = 0.2;  ///< and under which it rests again
};

/// What is known of a feature when its sightings are weighed.
struct FeatureRecord {
  int times_tracked = 0;         ///< N
  double geometry_factor = 0.0;  ///< g of the frame that saw it; zero: not known
  double relative_misfit = 0.0;  ///< its misfit in usual ones; zero: not known
};

/// g (V22-V25): how badly the directions to the features fix a position, as PDOP does. `directions`: unit
/// vectors from the camera. Nothing sensible, and zero, with fewer than three or all in one plane.
double geometry_factor(const std::vector<Eigen::Vector3d>& directions);

/// The guarded mode's factor of the fixed information, in (0, 1]:
///
///   w = min(1, misfit_width / misfit)^4,   misfit in those of the static features
///   (Window::reference_misfit).
///
/// V26 grows without bound with N and with 1/g. Where all features are poor, that pulls the balance from the
/// IMU to vision (the paper's epoch C). Here a feature is at best trusted like in the fixed mode. g, which is
/// the same for all features of a frame and so can only move that balance, is left out; so is N, which says
/// little once a feature has been seen often enough to be used: a vehicle may be followed for long. That its
/// sightings bend away from every static point, its misfit tells.
///
/// It acts only while many features bend (watch_for_movers()); a misfit that is not known, zero, weighs 1.
/// With few movers the fixed mode's kernel does enough, and the guarded mode is the fixed one to the last
/// bit.
double guarded_weight(const TrustOptions& options, const FeatureRecord& feature);

/// How much a sighting of this feature counts.
Trust trust(const TrustOptions& options, const FeatureRecord& feature);

}  // namespace cosight::vins
