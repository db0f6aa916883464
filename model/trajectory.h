#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "model/motion.h"

namespace ursula {

class ExactTrajectory;

/// A commanded motion of the platform: pose, twist and twist rate at t in [0, duration]. It is twice continuously
/// differentiable; ω and ω̇ are exact derivatives of the orientation. Your own trajectory defines `kind`, `duration`
/// and `at(double)`.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  virtual std::string kind() const = 0;
  virtual double duration() const = 0;  ///< t_f, s
  virtual Motion<double> at(double t) const = 0;
  /// Returns the motion in 50 digits, as the checks need it; S must be Real50, else it does not link. Throws
  /// std::logic_error if exact() is null.
  template <class S, class = std::enable_if_t<!std::is_arithmetic_v<S>>>
  Motion<S> at(const S& t) const;
  /// Returns null if the motion is known in doubles only; differences of doubles then check its derivatives.
  virtual const ExactTrajectory* exact() const { return nullptr; }
  /// Returns the same motion with P's position relative to `origin` (m, in B). The origin is subtracted before
  /// rounding, so a machine far from the base's origin loses no digits. Returns null if the trajectory cannot do this;
  /// the caller then uses at(t).p − origin.
  virtual std::unique_ptr<Trajectory> relativeTo(const Vector3d& /*origin*/) const { return nullptr; }
  /// Returns the instants in s, increasing, at which a higher derivative jumps. An integrator keeps its order only
  /// between them.
  virtual const std::vector<double>& knots() const {
    static const std::vector<double> none;
    return none;
  }
};

/// The helix of the Appendix, (49)–(55).
struct HelixParameters {
  double duration = 3.0;                                ///< t_f, s
  double radius = 0;                                    ///< a, m, > 0
  double pitch = 0;                                     ///< b, m/rad, not 0
  double start_angle = 0;                               ///< β₀
  double end_angle = 0;                                 ///< β_f
  double phase = 0;                                     ///< ω
  double height_phase = 0;                              ///< ω̄
  double start_rate = 0, end_rate = 0;                  ///< β̇₀, β̇_f, rad/s
  double start_acceleration = 0, end_acceleration = 0;  ///< β̈₀, β̈_f, rad/s²
};

/// Throws InvalidParameter (places `trajectory.…`).
std::unique_ptr<Trajectory> makeHelix(const HelixParameters& parameters);

}  // namespace ursula
