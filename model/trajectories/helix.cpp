#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "base/real50.h"
#include "model/exact_trajectory.h"
#include "model/scenario_keys.h"
#include "model/trajectories/trajectory_kinds.h"
#include "model/trajectory.h"

namespace ursula {

/// The helix's parameter, its rise from the start and its first two rates at one instant.
template <class S>
struct HelixParameter {
  S beta, rise, rate, acceleration;  ///< rise: β − β₀
};

/// Removes whole turns, which would cost the last digits. An angle within one turn is unchanged.
template <class S>
S withoutTurns(double angle) {
  const Real50 turn = 2 * acos(Real50(-1));
  if (!(std::abs(angle) > turn)) return S(angle);
  return S(Real50(angle - turn * round(Real50(angle / turn))));
}

/// Returns the coefficients aₖ t_fᵏ of the quintic in s = t / t_f; with this scaling no power of t_f can overflow or
/// underflow. They follow from the values, rates and accelerations at both ends (paper, eq. 51).
template <class S>
std::array<S, 6> quinticCoefficients(const HelixParameters& helix) {
  const S duration(helix.duration);
  const S rise = S(helix.end_angle) - S(helix.start_angle);
  const S rate_0 = S(helix.start_rate) * duration;
  const S rate_f = S(helix.end_rate) * duration;
  const S acceleration_0 = S(helix.start_acceleration) * duration * duration;
  const S acceleration_f = S(helix.end_acceleration) * duration * duration;
  return {withoutTurns<S>(helix.start_angle),
          rate_0,
          acceleration_0 / 2,
          (20 * rise - (8 * rate_f + 12 * rate_0) - (3 * acceleration_0 - acceleration_f)) / 2,
          (-30 * rise + (14 * rate_f + 16 * rate_0) + (3 * acceleration_0 - 2 * acceleration_f)) / 2,
          (12 * rise - (6 * rate_f + 6 * rate_0) - (acceleration_0 - acceleration_f)) / 2};
}

template <class S>
class HelixKernel {
 public:
  /// Positions are relative to `origin`, m, in B.
  HelixKernel(const HelixParameters& helix, const Vector3d& origin)
      : duration_(helix.duration),
        a_(helix.radius),
        b_(helix.pitch),
        phase_(withoutTurns<S>(helix.phase)),
        start_(startOf(helix, origin)),
        coefficients_(quinticCoefficients<S>(helix)) {}

  /// With c = cos(β + ω), s = sin(β + ω), and ' the derivative by β:
  ///   p = [a c, a s, b (β + ω̄)]          (paper, eq. 49)
  ///   ṗ = m β̇,  p̈ = m β̈ + n β̇²           (paper, eq. 52)
  ///   e_t = m / √(a² + b²),  e_n = n / a  (paper, eq. 54)
  ///   Q = [−e_b, e_n, e_t]                (paper, eq. 55)
  /// and the Appendix's ω = β̇ e_z, ω̇ = β̈ e_z: the triad turns about e_z with β.
  Motion<S> at(const S& t) const {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const HelixParameter<S> helix = parameter(t);
    const S c = cos(helix.beta + phase_);
    const S s = sin(helix.beta + phase_);
    const Vector3<S> m(-a_ * s, a_ * c, b_);
    const Vector3<S> n(-a_ * c, -a_ * s, S(0));
    const Vector3<S> e_t = m / sqrt(a_ * a_ + b_ * b_);
    const Vector3<S> e_n(-c, -s, S(0));

    Motion<S> motion;
    motion.t = t;
    // The chord from the start is computed directly, because a difference of two radii would cancel if the axis is far
    // away.
    const S half = helix.rise / 2, middle = coefficients_[0] + phase_ + half, chord = 2 * sin(half);
    motion.p = start_ + Vector3<S>(-a_ * chord * sin(middle), a_ * chord * cos(middle), b_ * helix.rise);
    motion.p_dot = m * helix.rate;
    motion.p_ddot = m * helix.acceleration + n * (helix.rate * helix.rate);
    motion.Q.col(0) = -e_t.cross(e_n);
    motion.Q.col(1) = e_n;
    motion.Q.col(2) = e_t;
    motion.omega.z() = helix.rate;
    motion.omega_dot.z() = helix.acceleration;
    return motion;
  }

 private:
  /// Returns p at β₀ relative to the origin, rounded once, because the two cancel far from the base's origin.
  static Vector3<S> startOf(const HelixParameters& helix, const Vector3d& origin) {
    const Real50 angle = Real50(helix.start_angle) + helix.phase;
    const Real50 height = Real50(helix.pitch) * (Real50(helix.start_angle) + Real50(helix.height_phase));
    return {S(Real50(helix.radius * cos(angle) - origin.x())), S(Real50(helix.radius * sin(angle) - origin.y())),
            S(Real50(height - origin.z()))};
  }

  /// Computes β by Horner's rule (paper, eq. 50), and β̇, β̈ (paper, eq. 53).
  HelixParameter<S> parameter(const S& t) const {
    const S s = t / duration_;
    S rise(0), rate(0), acceleration(0);
    for (int k = 5; k >= 1; --k) {
      const S& coefficient = coefficients_[k];
      rise = (rise + coefficient) * s;
      rate = rate * s + k * coefficient;
      if (k >= 2) acceleration = acceleration * s + k * (k - 1) * coefficient;
    }
    return {coefficients_[0] + rise, rise, rate / duration_, acceleration / (duration_ * duration_)};
  }

  S duration_, a_, b_, phase_;
  Vector3<S> start_;  ///< p at β₀
  std::array<S, 6> coefficients_;
};

namespace {

void require(bool holds, const char* key, double value, const char* bound) {
  if (!holds) throw InvalidParameter(std::string("trajectory.") + key, fmt::format("{}", value), bound);
}

void validate(const HelixParameters& helix) {
  const std::pair<const char*, double> all[] = {{"duration", helix.duration},
                                                {"radius", helix.radius},
                                                {"pitch", helix.pitch},
                                                {"start_angle", helix.start_angle},
                                                {"end_angle", helix.end_angle},
                                                {"phase", helix.phase},
                                                {"height_phase", helix.height_phase},
                                                {"start_rate", helix.start_rate},
                                                {"end_rate", helix.end_rate},
                                                {"start_acceleration", helix.start_acceleration},
                                                {"end_acceleration", helix.end_acceleration}};
  for (const auto& [key, value] : all) require(std::isfinite(value), key, value, "a finite number");
  require(helix.duration > 0, "duration", helix.duration, "> 0");
  require(helix.radius > 0, "radius", helix.radius, "> 0");
  require(helix.pitch != 0, "pitch", helix.pitch, "not 0");
}

/// Requires a finite motion, because finite parameters can still overflow, for instance t_f = 1e-200 s in β̈.
void validateRange(const HelixParameters& helix, const HelixKernel<double>& kernel) {
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Motion<double> motion = kernel.at(share * helix.duration);
    const bool finite = motion.p.allFinite() && motion.Q.allFinite() && motion.p_dot.allFinite() &&
                        motion.p_ddot.allFinite() && motion.omega_dot.allFinite();
    require(finite, "duration", helix.duration, "a motion whose acceleration is finite");
  }
}

HiddenTerms hiddenIn(const HelixParameters& helix) {
  HiddenTerms hidden;
  hidden.angle = std::abs(withoutTurns<double>(helix.start_angle)) + std::abs(withoutTurns<double>(helix.phase));
  hidden.length = helix.radius * (1 + hidden.angle) +
                  std::abs(helix.pitch) * (std::abs(helix.start_angle) + std::abs(helix.height_phase));
  return hidden;
}

std::unique_ptr<Trajectory> helixFrom(const HelixParameters& parameters, const Vector3d& origin) {
  return std::make_unique<KernelTrajectory<HelixKernel>>(
      "helix", parameters.duration, HelixKernel<double>(parameters, origin), HelixKernel<Real50>(parameters, origin),
      [parameters, origin](const Vector3d& further) { return helixFrom(parameters, origin + further); },
      std::vector<double>{}, hiddenIn(parameters));
}

ScenarioKey angle(const char* name, const char* fallback, const char* meaning) {
  return {name, KeyType::number, "rad", fallback, meaning};
}

ScenarioKey inDegrees(const char* name, const char* meaning) {
  return {name, KeyType::number, "°", no_default, meaning};
}

}  // namespace

std::unique_ptr<Trajectory> makeHelix(const HelixParameters& parameters) {
  validate(parameters);
  validateRange(parameters, HelixKernel<double>(parameters, Vector3d::Zero()));
  return helixFrom(parameters, Vector3d::Zero());
}

std::vector<ScenarioTable> helixKeys() {
  return {{"trajectory.helix",
           "[trajectory], kind = \"helix\"",
           "P on a helix about the z axis of B, the platform along with its triad. The helix' angle is a quintic in "
           "time between the values, rates and accelerations given at both ends.",
           {kindKey(),
            {"duration", KeyType::number, "s", required_key, "t_f", above_zero},
            {"radius", KeyType::number, "m", required_key, "a", above_zero},
            {"pitch", KeyType::number, "m/rad", required_key, "b: the rise for an angle of 1 rad", not_zero},
            angle("start_angle", required_key, "β₀"),
            inDegrees("start_angle_deg", "instead of `start_angle`"),
            angle("end_angle", required_key, "β_f"),
            inDegrees("end_angle_deg", "instead of `end_angle`"),
            angle("phase", "0.0", "ω"),
            inDegrees("phase_deg", "instead of `phase`"),
            angle("height_phase", "0.0", "ω̄: adds its own times b to the height"),
            inDegrees("height_phase_deg", "instead of `height_phase`"),
            {"start_rate", KeyType::number, "rad/s", "0.0", "at t = 0"},
            {"end_rate", KeyType::number, "rad/s", "0.0", "at t_f"},
            {"start_acceleration", KeyType::number, "rad/s²", "0.0", "at t = 0"},
            {"end_acceleration", KeyType::number, "rad/s²", "0.0", "at t_f"}}}};
}

std::shared_ptr<const Trajectory> readHelix(const TomlSection& table) {
  table.allowOnly(scenarioTable("trajectory.helix"));
  HelixParameters helix;
  table.require("duration", helix.duration);
  table.require("radius", helix.radius);
  table.require("pitch", helix.pitch);
  table.requireAngle("start_angle", helix.start_angle);
  table.requireAngle("end_angle", helix.end_angle);
  table.readAngle("phase", helix.phase);
  table.readAngle("height_phase", helix.height_phase);
  table.read("start_rate", helix.start_rate);
  table.read("end_rate", helix.end_rate);
  table.read("start_acceleration", helix.start_acceleration);
  table.read("end_acceleration", helix.end_acceleration);
  return makeHelix(helix);
}

}  // namespace ursula
