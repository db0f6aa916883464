#pragma once

#include <memory>
#include <optional>

#include "model/scenario.h"
#include "validation/subject/subject.h"

namespace ursula {

/// The variational equations of direct dynamics along the commanded motion, the torques held as functions of time:
/// ẋ = J(t) x with x = [δp; L δϑ; δṗ; L δω] of the platform in m and m/s, L a length of the machine. A deviation of the
/// orientation turns it: Q → exp(δϑ) Q, so δϑ̇ = δω + ω × δϑ.
class Linearisation {
 public:
  using Matrix12 = Eigen::Matrix<double, 12, 12>;

  /// The fast kernels' direct dynamics are differenced centrally.
  explicit Linearisation(const Scenario& scenario);

  /// L, m.
  double length() const { return length_; }
  /// J(t), found once while a pose is held. Throws PoseError where the motion is singular. Not for several threads.
  Matrix12 at(double t) const;

 private:
  /// [p̈; L ω̇] under the torques with the state deviated.
  Vector6d acceleration(Motion<double> motion, const Eigen::Matrix<double, 12, 1>& deviation,
                        const Vector6d& torques) const;

  /// The state, what it is to do there and the load: all that J depends on.
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
  Subject fast_;
  double length_, step_;
};

}  // namespace ursula
