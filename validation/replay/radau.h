#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace ursula {

/// One step of Radau IIA with nine stages, of order 17 and stiff in no direction (Hairer and Wanner, Solving Ordinary
/// Differential Equations II, 1996, sect. IV.5 and IV.8): collocation, solved by simplified Newton iterations with a
/// Jacobian by differences. Where friction holds joints at rates of thousands a second, its steps are those of the
/// motion, and an explicit method's are those of the friction.
class RadauStep {
 public:
  /// ẋ at (t, x).
  using Rate = std::function<void(const std::vector<double>& x, std::vector<double>& rate, double t)>;

  /// What a coordinate x may be off by: absolute + relative |x|.
  struct Tolerance {
    double absolute = 0, relative = 0;
  };

  /// The error that is taken to be made, over the tolerance, of the worst coordinate, where the equations were solved:
  /// what the last two Legendre coefficients of the rates make of the state; none where they were not. `x` is moved on
  /// where that is at most 1. Throws what `rate` throws.
  std::optional<double> tryStep(const Rate& rate, std::vector<double>& x, double t, double h,
                                const Tolerance& tolerance);

  /// What rounding of size 1 in each rate makes of the error that tryStep takes to be made, over h, at most.
  static double noiseInError();

  /// The instants at which a step of h asks for rates, s.
  static std::vector<double> instants(double t, double h);

 private:
  void differentiate(const Rate& rate, const std::vector<double>& x, double t);
  /// F, the rates at the stages x + Z.
  static void evaluate(const Rate& rate, const std::vector<double>& x, double t, double h, const Eigen::MatrixXd& Z,
                       Eigen::Ref<Eigen::MatrixXd> F);

  Eigen::MatrixXd jacobian_;
  std::vector<double> at_start_;  ///< rates there
};

/// By which a step is multiplied for the next, or to be tried again, after an error as tryStep has it.
double changeOfStep(const std::optional<double>& error);

}  // namespace ursula
