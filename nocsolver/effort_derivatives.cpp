#include "nocsolver/effort_derivatives.h"

#include <stdexcept>
#include <string>

#include "nocsolver/kernels/chain_frame.h"
#include "nocsolver/kernels/machine_model.h"
#include "nocsolver/kernels/platform_at_p.h"
#include "nocsolver/kernels/slope_functions.h"

namespace ursula {
namespace {

using kernel::LegNumbers;
using kernel::MachineNumbers;
using kernel::Refusal;
using Block = EffortsByState::Block;

kernel::SlopeFunctions functionsOf(InstructionSet set) {
#ifdef URSULA_X86
  switch (set) {
    case InstructionSet::sse2:
      return kernel::slopesBySse2();
    case InstructionSet::avx2:
      return kernel::slopesByAvx2();
    case InstructionSet::avx512:
      return kernel::slopesByAvx512();
    case InstructionSet::portable:
      break;
  }
#endif
  return kernel::slopesOneByOne();
}

template <class Matrix>
void copy(const Matrix& from, double* to) {
  for (Eigen::Index k = 0; k < from.size(); ++k) to[k] = from.data()[k];
}

LegNumbers numbersOf(const ChainModel<double>& leg, const Leg& written) {
  LegNumbers out;
  out.kind = leg.kind;
  out.motor = leg.motor;
  copy(written.base_axis, out.axis);
  copy(leg.x_hat, out.x_hat);
  copy(leg.u, out.u);
  copy(leg.z_hat, out.z_hat);
  copy(leg.a, out.a);
  copy(leg.b, out.b);
  out.l = leg.l;
  out.s = leg.s;
  out.knee = leg.knee;
  out.rho = leg.rho;
  out.sigma = leg.sigma;
  out.mass_1 = leg.mass_1;
  out.mass_2 = leg.mass_2;
  copy(leg.I_1, out.I_1);
  copy(leg.I_2, out.I_2);
  for (std::size_t j = 0; j < 3; ++j) {
    out.viscous[j] = leg.viscous[j];
    out.smooth[j] = leg.coulomb[j];
    out.speed[j] = leg.speed[j];
  }
  return out;
}

MachineNumbers numbersOf(const Manipulator& manipulator) {
  const auto machine = kernel::machineModel<double>(manipulator);
  MachineNumbers out;
  out.legs_in_all = machine.legs_in_all;
  out.mass = machine.mass;
  out.length = machine.length;
  copy(machine.rho, out.rho);
  copy(machine.I_M, out.I_M);
  copy(machine.gravity, out.gravity);
  for (std::size_t i = 0; i < static_cast<std::size_t>(out.legs_in_all); ++i) {
    out.legs[i] = numbersOf(machine.legs[i], manipulator.leg(static_cast<int>(i)));
    out.legs[i].rubs = machine.rubs[i];
    out.legs[i].coulomb = machine.coulomb[i];
  }
  return out;
}

void refuse(const Refusal& refusal, double t) {
  switch (refusal.kind) {
    case Refusal::out_of_reach:
      return kernel::requireReach<double>(false, refusal.leg, t, refusal.measure, refusal.bound);
    case Refusal::end_of_stroke:
      return kernel::requireStroke<double>(false, refusal.leg, t, refusal.measure, refusal.bound);
    case Refusal::point_on_axis:
      return kernel::requireOffAxis<double>(refusal.measure, refusal.bound, refusal.leg, t);
    case Refusal::stretched_leg:
      return kernel::requireRegular<double>(refusal.measure, refusal.what, refusal.leg, t);
    case Refusal::singular_jacobian:
      return kernel::requireRegularB<double>(refusal.measure, t);
    case Refusal::none:
      break;
  }
}

}  // namespace

struct EffortDerivatives::Impl {
  kernel::SlopeFunctions functions;
  MachineNumbers machine;
};

EffortDerivatives::EffortDerivatives(const Manipulator& manipulator, InstructionSet set) {
  if (!isSupported(set)) throw std::invalid_argument(std::string("this processor has no ") + nameOf(set));
  impl_ = std::make_unique<const Impl>(Impl{functionsOf(set), numbersOf(manipulator)});
}
EffortDerivatives::~EffortDerivatives() = default;
EffortDerivatives::EffortDerivatives(EffortDerivatives&&) noexcept = default;
EffortDerivatives& EffortDerivatives::operator=(EffortDerivatives&&) noexcept = default;

EffortsByState EffortDerivatives::byState(const Motion<double>& motion, const Vector6d& load,
                                          const Block& load_by_turn) const {
  EffortsByState out;
  refuse(impl_->functions.byState(impl_->machine, {&motion.t, load.data(), load_by_turn.data()}, out.efforts.data(),
                                  out.derivatives.data()),
         motion.t);
  return out;
}

}  // namespace ursula
