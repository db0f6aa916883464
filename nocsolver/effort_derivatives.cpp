#include "nocsolver/effort_derivatives.h"

#include <stdexcept>
#include <string>

#include "nocsolver/kernels/chain_frame.h"
#include "nocsolver/kernels/machine_model.h"
#include "nocsolver/kernels/platform_at_p.h"
#include "nocsolver/kernels/slope_functions.h"
#include "nocsolver/slope_table.h"

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

LegNumbers numbersOf(const kernel::PlaneModel<double>& leg, const Leg& written) {
  LegNumbers out;
  out.kind = leg.kind;
  out.rubs = leg.rubs;
  out.rubs_dry = leg.rubs_dry;
  out.principal = leg.principal;
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
  out.length = 1 / machine.per_length;
  copy(machine.rho, out.rho);
  copy(machine.I_M, out.I_M);
  copy(machine.gravity, out.gravity);
  for (std::size_t i = 0; i < static_cast<std::size_t>(out.legs_in_all); ++i)
    out.legs[i] = numbersOf(machine.legs[i], manipulator.leg(static_cast<int>(i)));
  return out;
}

void refuse(const Refusal& refusal, double t) {
  switch (refusal.kind) {
    case PoseFault::out_of_reach:
      return kernel::requireReach<double>(false, refusal.leg, t, refusal.measure, refusal.bound);
    case PoseFault::end_of_stroke:
      return kernel::requireStroke<double>(false, refusal.leg, t, refusal.measure, refusal.bound);
    case PoseFault::point_on_axis:
      return kernel::requireOffAxis<double>(refusal.measure, refusal.bound, refusal.leg, t);
    case PoseFault::stretched_leg:
      return kernel::requireRegular<double>(refusal.measure, refusal.what, refusal.leg, t);
    case PoseFault::singular_jacobian:
      return kernel::requireRegularB<double>(refusal.measure, t);
    case PoseFault::none:
      break;
  }
}

}  // namespace

struct EffortDerivatives::Impl {
  Impl(const Manipulator& manipulator, InstructionSet set)
      : functions(functionsOf(set)),
        machine(numbersOf(manipulator)),
        unit(kernel::unitBodies(machine)),
        parameters(kernel::parameterTable(machine)),
        regressor(kernel::regressorTable(machine)) {}

  Columns columns(const kernel::SlopeTable& table, const MachineNumbers& at, const Motion<double>& motion,
                  const Vector6d& load) const {
    const Block still = Block::Zero();
    kernel::ParameterSlopes slopes;
    refuse(functions.byParameters(machine, at, {&motion.t, load.data(), still.data()}, slopes), motion.t);
    Columns out(6, static_cast<Eigen::Index>(table.names.size()));
    for (std::size_t k = 0; k < table.names.size(); ++k)
      out.col(static_cast<Eigen::Index>(k)) = kernel::slopeOf(table.places[k], slopes, machine.legs_in_all);
    return out;
  }

  kernel::SlopeFunctions functions;
  MachineNumbers machine, unit;  ///< `unit`: bodies of mass 1 and nothing else, to be differentiated for the regressor
  kernel::SlopeTable parameters, regressor;
};

EffortDerivatives::EffortDerivatives(const Manipulator& manipulator, InstructionSet set) {
  if (!isSupported(set)) throw std::invalid_argument(std::string("this processor has no ") + nameOf(set));
  impl_ = std::make_unique<const Impl>(manipulator, set);
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

const std::vector<std::string>& EffortDerivatives::parameterNames() const { return impl_->parameters.names; }

EffortDerivatives::Columns EffortDerivatives::byParameters(const Motion<double>& motion, const Vector6d& load) const {
  return impl_->columns(impl_->parameters, impl_->machine, motion, load);
}

const std::vector<std::string>& EffortDerivatives::regressorNames() const { return impl_->regressor.names; }

Eigen::VectorXd EffortDerivatives::regressorValues() const {
  const std::vector<double> values = kernel::regressorValues(impl_->machine);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

EffortDerivatives::Columns EffortDerivatives::regressor(const Motion<double>& motion) const {
  return impl_->columns(impl_->regressor, impl_->unit, motion, Vector6d::Zero());
}

}  // namespace ursula
