#include "validation/subject/motion_check.h"

#include <cmath>
#include <vector>

#include "model/instants.h"
#include "nocsolver/solver.h"

namespace ursula {
namespace {

/// The samples and as many between each two as make `least_intervals`.
std::vector<double> instantsToCheck(const Scenario& scenario) {
  constexpr int least_intervals = 2000;
  const int intervals = scenario.simulation.samples - 1;
  const int parts = (least_intervals + intervals - 1) / intervals;
  return equallySpaced(scenario.trajectory->duration(), intervals * parts + 1);
}

}  // namespace

/// det B is continuous wherever the legs reach, so that it vanishes between unlike signs.
void checkMotion(const Scenario& scenario) {
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  double before = 0;
  for (double t : instantsToCheck(scenario)) {
    const Motion<double> motion = scenario.trajectory->at(t);
    solver.inverseKinematics(motion, work);
    solver.jacobians(motion, work);
    const double determinant = work.B_transposed.determinant();
    if (before * determinant < 0)
      throw SingularJacobian("B has crossed a singular pose: its determinant changed sign", -1, t, determinant, 0, "");
    before = std::copysign(1.0, determinant);
  }
}

}  // namespace ursula
