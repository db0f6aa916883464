#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace ursula {

/// One step of Radau IIA with nine stages, of order 17 and stiffly accurate (Hairer and Wanner, Solving Ordinary
/// Differential Equations II, 1996, sect. IV.5 and IV.8). Simplified Newton iterations with a difference Jacobian solve
/// the collocation equations. If friction damps joints at thousands per second, it can follow the motion, while an
/// explicit method must follow the friction.
class RadauStep {
 public:
  /// ẋ at (t, x).
  using Rate = std::function<void(const std::vector<double>& x, std::vector<double>& rate, double t)>;

  /// The tolerance of a coordinate x: absolute + relative |x|.
  struct Tolerance {
    double absolute = 0, relative = 0;
  };

  /// Returns the estimated error over the tolerance, for the worst coordinate, from the last two Legendre coefficients
  /// of the rates; nullopt if the equations were not solved. Advances `x` if the error is at most 1. Throws what `rate`
  /// throws.
  std::optional<double> tryStep(const Rate& rate, std::vector<double>& x, double t, double h,
                                const Tolerance& tolerance);

  /// The largest effect on tryStep's error estimate, over h, of rounding of size 1 in each rate.
  static double noiseInError();

  /// The instants at which a step of h evaluates rates, s.
  static std::vector<double> instants(double t, double h);

 private:
  void differentiate(const Rate& rate, const std::vector<double>& x, double t);
  /// F, the rates at the stages x + Z.
  static void evaluate(const Rate& rate, const std::vector<double>& x, double t, double h, const Eigen::MatrixXd& Z,
                       Eigen::Ref<Eigen::MatrixXd> F);

  Eigen::MatrixXd jacobian_;
  std::vector<double> at_start_;  ///< rates at the start of the step
};

/// The factor for the next or repeated step after an error from tryStep.
double changeOfStep(const std::optional<double>& error);

}  // namespace ursula
