#include "parts/fast/legs_at_once.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "parts/fast/kernels/functions_of.h"
#include "parts/fast/kernels/machine_fields.h"
#include "parts/fast/kernels/solve6.h"

namespace ursula::kernel {
namespace {

bool areAlike(const MachineModel<double>& machine) {
  if (machine.legs_in_all != leg_count) return false;
  for (std::size_t i = 0; i < leg_count; ++i) {
    const PlaneModel<double>&leg = machine.legs[i], &first = machine.legs[0];
    if (leg.kind != first.kind) return false;
    for (std::size_t j = 0; j < 3; ++j)
      if (leg.motor[j] != (first.motor[j] == 0 ? static_cast<int>(i) : -1)) return false;
  }
  return true;
}

/// Returns the first leg's shape with each property that any leg has; it serves for all legs.
MachineShape commonShape(const MachineModel<double>& machine) {
  MachineShape out = shapeOf(machine);
  for (std::size_t i = 1; i < leg_count; ++i) {
    out.has_friction[0] = out.has_friction[0] || out.has_friction[i];
    out.has_coulomb[0] = out.has_coulomb[0] || out.has_coulomb[i];
    out.principal[0] = out.principal[0] && out.principal[i];
    out.has_rotor[0] = out.has_rotor[0] || out.has_rotor[i];
    out.off_line[0] = out.off_line[0] || out.off_line[i];
  }
  for (std::size_t i = 1; i < leg_count; ++i) {
    out.has_friction[i] = out.has_friction[0];
    out.has_coulomb[i] = out.has_coulomb[0];
    out.principal[i] = out.principal[0];
    out.has_rotor[i] = out.has_rotor[0];
    out.off_line[i] = out.off_line[0];
    out.motors[i] = out.motors[0];
  }
  return out;
}

}  // namespace

LegsAtOnce::LegsAtOnce(const MachineModel<double>& machine, InstructionSet set)
    : functions_(functionsOf(set)), per_length_(machine.per_length) {
  if (!isSupported(set)) throw std::invalid_argument(std::string("this processor has no ") + nameOf(set));
  if (!functions_ || !areAlike(machine)) return;
  std::vector<double> numbers;
  forEachNumber(machine, [&numbers](double number) { numbers.push_back(number); });
  legs_ = std::shared_ptr<const void>(functions_->make_legs(numbers.data(), commonShape(machine)),
                                      [destroy = functions_->destroy_legs](void* legs) { destroy(legs); });
}

std::optional<Vector6d> LegsAtOnce::inverseDynamics(const Motion<double>& motion, const Vector6d& load,
                                                    double& pivots) const {
  LegSums sums;
  if (!legs_ || !functions_->inverse_legs(legs_.get(), &motion.t, sums)) return std::nullopt;
  System6<double> system;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) system.a[row][column] = sums.rows[row][column];
    system.a[row][6] = (row < 3 ? per_length_ : 1.0) * (sums.wrench[row] - load(row));
  }
  pivots = solve(system);
  Vector6d efforts;
  for (int m = 0; m < motor_count; ++m) efforts(m) = sums.Q[m] + sums.A[m] * system.a[m][6];  // (37)
  return efforts;
}

std::optional<Vector6d> LegsAtOnce::directDynamics(const Motion<double>& motion, const Vector6d& efforts,
                                                   const Vector6d& load) const {
  LegSums sums;
  if (!legs_ || !functions_->direct_legs(legs_.get(), &motion.t, efforts.data(), sums)) return std::nullopt;
  Matrix6d M_P;
  Vector6d wrench;
  for (int c = 0; c < 6; ++c) {
    wrench(c) = sums.wrench[c] + load(c);
    for (int r = c; r < 6; ++r) M_P(r, c) = sums.rows[r][c];
  }
  return solvePositive<double>(M_P, wrench);  // (36)
}

}  // namespace ursula::kernel
