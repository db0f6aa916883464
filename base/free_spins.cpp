#include "base/free_spins.h"

namespace ursula {

std::vector<Eigen::Vector3d> takeSpins(const Eigen::MatrixXd& jacobian, Eigen::MatrixXd& Z) {
  std::vector<Eigen::Vector3d> out;
  Eigen::MatrixXd twists = jacobian * Z;
  const double negligible = 1e-7 * Z.norm();
  if (twists.bottomRows<3>().norm() > negligible) return out;
  while (out.size() < 3 && twists.topRows<3>().norm() > negligible) {
    Eigen::Index largest = 0;
    twists.topRows<3>().colwise().norm().maxCoeff(&largest);
    out.emplace_back(twists.col(largest).head<3>().normalized());
    const Eigen::VectorXd spin = (twists.topRows<3>().transpose() * out.back()).normalized();
    const Eigen::VectorXd taken = Z * spin;
    Z -= taken * spin.transpose();
    twists = jacobian * Z;
  }
  return out;
}

}  // namespace ursula
