#pragma once

#include <memory>
#include <optional>

#include "model/scenario.h"
#include "validation/subject/subject.h"

namespace ursula {

/// The variational equations of direct dynamics along the commanded motion, with torques as given functions of time: ẋ
/// = J(t) x with x = [δp; L δϑ; δṗ; L δω] of the platform in m and m/s, where L is a length of the machine. A deviation
/// rotates the orientation: Q → exp(δϑ) Q, so δϑ̇ = δω + ω × δϑ.
class Linearisation {
 public:
  using Matrix12 = Eigen::Matrix<double, 12, 12>;

  /// Uses central differences of the NOC's direct dynamics.
  explicit Linearisation(const Scenario& scenario);

  /// L, m.
  double length() const { return length_; }
  /// J(t), computed once while a pose is held. Throws PoseError if the motion is singular. Not thread-safe.
  Matrix12 at(double t) const;

 private:
  /// [p̈; L ω̇] under the torques in the deviated state.
  Vector6d acceleration(Motion<double> motion, const Eigen::Matrix<double, 12, 1>& deviation,
                        const Vector6d& torques) const;

  /// State, acceleration and load: everything that J depends on.
  struct Place {
    Motion<double> motion;
    Vector6d load;
    Matrix12 J;
  };

  Matrix12 differenced(const Motion<double>& motion) const;

  const Trajectory& trajectory_;
  std::shared_ptr<const Load> load_;
  mutable std::optional<Place> last_;
  Subject right_;
  double length_, step_;
};

}  // namespace ursula
