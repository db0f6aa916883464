#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace ursula {

/// The motors' coordinates, rates and accelerations at one instant, in the units of the joints.
struct MotorMotion {
  double t = 0;  ///< s
  Eigen::VectorXd q, qdot, qddot;
};

/// A commanded motion of the motors at t in [0, duration]; twice continuously differentiable. Immutable.
class MotorTrajectory {
 public:
  virtual ~MotorTrajectory() = default;
  virtual std::string kind() const = 0;
  virtual double duration() const = 0;  ///< s
  virtual MotorMotion at(double t) const = 0;
  /// Returns the instants at which a higher derivative jumps, s.
  virtual const std::vector<double>& knots() const {
    static const std::vector<double> none;
    return none;
  }
};

/// One motor's series: offset + Σ_j sin_j sin(2πj t/T) + cos_j cos(2πj t/T), j from 1.
struct FourierSeries {
  double offset = 0;
  std::vector<double> sin, cos;
};

/// Throws InvalidParameter (places `trajectory.…`).
std::unique_ptr<MotorTrajectory> makeFourier(double duration, double period, std::vector<FourierSeries> motors);
std::unique_ptr<MotorTrajectory> makeMotorHold(double duration, const Eigen::VectorXd& q);
/// The quintic spline through samples, one row each; `rates` and `accelerations` may be empty, and are then found from
/// the rows, at least six. Times begin at 0 and increase.
std::unique_ptr<MotorTrajectory> makeMotorSamples(const std::vector<double>& times, const Eigen::MatrixXd& positions,
                                                  const Eigen::MatrixXd& rates = {},
                                                  const Eigen::MatrixXd& accelerations = {});

}  // namespace ursula
