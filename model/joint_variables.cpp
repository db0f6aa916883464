#include "model/joint_variables.h"

#include <cmath>

namespace ursula {

double jointDistance(const JointVariables<double>& a, const JointVariables<double>& b, int i, double length) {
  const double turned = Vector3d(a.phi(i) - b.phi(i), a.psi(i) - b.psi(i), a.theta(i) - b.theta(i)).norm();
  const double slid = (a.d(i) - b.d(i)) / length;
  return slid == 0 ? turned : std::hypot(turned, slid);
}

double jointDistance(const JointVariables<double>& a, const JointVariables<double>& b, double length) {
  double largest = 0;
  for (int i = 0; i < leg_count; ++i) {
    const double distance = jointDistance(a, b, i, length);
    if (!(distance <= largest)) largest = distance;
    if (std::isnan(largest)) break;
  }
  return largest;
}

}  // namespace ursula
