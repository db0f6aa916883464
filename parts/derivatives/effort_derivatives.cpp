#include "parts/derivatives/effort_derivatives.h"

#include <algorithm>
#include <array>
#include <unsupported/Eigen/AutoDiff>

#include "model/machine_numbers.h"
#include "nocsolver/errors.h"
#include "nocsolver/legs/leg_model_impl.h"
#include "parts/fast/kernels/leg_kernels.h"
#include "parts/fast/kernels/plane_dynamics.h"

namespace ursula {
namespace {

/// Width of a pass: the 18 components of the state δ, p, ω, ṗ, ω̇, p̈, or 18 parameters, so that kernels are compiled
/// once.
constexpr int dual_width = 18;
/// A number with its derivatives.
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, dual_width, 1>>;

Motion<Dual> constant(const Motion<double>& m) {
  return {Dual(m.t),
          m.p.cast<Dual>(),
          m.Q.cast<Dual>(),
          m.omega.cast<Dual>(),
          m.p_dot.cast<Dual>(),
          m.omega_dot.cast<Dual>(),
          m.p_ddot.cast<Dual>()};
}

/// Refuses a pose by the values alone, whatever the derivatives are.
struct GuardOfValues {
  kernel::LegGuard<double> guard;

  void reach(const Dual& inside, const Dual& square, const Dual& bound) const {
    guard.reach(inside.value(), square.value(), bound.value());
  }
  void stroke(const Dual& d, const Dual& least, const Dual& most) const {
    guard.stroke(d.value(), least.value(), most.value());
  }
  void offAxis(const Dual& r, const Dual& size) const { guard.offAxis(r.value(), size.value()); }
  void regular(const Dual& sine, const char* what) const { guard.regular(sine.value(), what); }
};

/// Inverse dynamics by the kernels.
Vector6<Dual> efforts(const kernel::MachineModel<Dual>& machine, const Motion<Dual>& motion,
                      const Vector6<Dual>& load) {
  Dual pivots;
  const auto guardOf = [&motion](int leg) { return GuardOfValues{{leg, motion.t.value()}}; };
  const Vector6<Dual> found = kernel::inverseDynamics<Dual>(machine, motion, load, guardOf, pivots);
  legs::requireRegularB(pivots.value(), motion.t.value());
  return found;
}

void seed(int first, Vector3<Dual>& v) {
  for (int k = 0; k < 3; ++k) v(k).derivatives()(first + k) = 1;
}

/// A machine with its axes as given, without normalisation.
struct UnnormalisedMachine {
  MachineParameters<Dual> parameters;
  PerLeg<Vector3<Dual>> axis;

  explicit UnnormalisedMachine(const Manipulator& manipulator) : parameters(manipulator) {
    for (int i = 0; i < manipulator.legCount(); ++i) axis[i] = manipulator.leg(i).base_axis.cast<Dual>();
  }
};

/// Seeds derivative `column` with this number.
void seed(UnnormalisedMachine& machine, const MachineNumber& number, int column) {
  MachineParameters<Dual>& m = machine.parameters;
  const auto i = static_cast<std::size_t>(std::max(number.leg, 0)), k = static_cast<std::size_t>(number.entry);
  LegModel<Dual>& leg = m.legs[i];
  const bool proximal = number.body == NumberBody::proximal;
  const auto one = [column](Dual& place) { place.derivatives()(column) = 1; };
  const auto entry = [&](Matrix3<Dual>& I) {
    const auto& [row, across] = tensor_entries[k];
    one(I(row, across));
    one(I(across, row));
  };
  const auto speeds = [&](bool sliding) {
    for (std::size_t j = 0; j < 3; ++j)
      if (slides(rowOf(leg.kind).coordinates[j]) == sliding) one(leg.speed[j]);
  };
  switch (number.quantity) {
    case Quantity::gravity:
      return one(m.gravity(number.entry));
    case Quantity::platform_mass:
      return one(m.mass);
    case Quantity::platform_center:
      return one(m.rho(number.entry));
    case Quantity::platform_inertia:
      return entry(m.I_M);
    case Quantity::base_point:
      return one(leg.a(number.entry));
    case Quantity::platform_point:
      return one(leg.b(number.entry));
    case Quantity::base_axis:
      return one(machine.axis[i](number.entry));
    case Quantity::length:
      return one(proximal ? leg.l : leg.s);
    case Quantity::mass:
      return one(proximal ? leg.mass_1 : leg.mass_2);
    case Quantity::center:
      return one(proximal ? leg.rho : leg.sigma);
    case Quantity::inertia:
      return entry(proximal ? leg.I_1 : leg.I_2);
    case Quantity::friction:
      return one(leg.viscous[k]);
    case Quantity::coulomb:
      return one(leg.coulomb[k]);
    case Quantity::smoothing_speed:
      return speeds(false);
    case Quantity::sliding_speed:
      return speeds(true);
    case Quantity::rotor_inertia:
      return one(leg.rotor[k]);
    case Quantity::center_across:
      return one((proximal ? leg.off_1 : leg.off_2)(number.entry));
  }
}

/// Unit point masses at P and at the links' first ends: derivatives there are the regressor's columns.
UnnormalisedMachine unitBodies(UnnormalisedMachine machine) {
  MachineParameters<Dual>& m = machine.parameters;
  m.mass = 1;
  m.rho.setZero();
  m.I_M.setZero();
  for (LegModel<Dual>& leg : m.legs) {
    leg.mass_1 = leg.mass_2 = 1;
    leg.rho = leg.sigma = 0;
    leg.off_1.setZero();
    leg.off_2.setZero();
    leg.I_1.setZero();
    leg.I_2.setZero();
  }
  return machine;
}

Matrix3d about(double mass, const Vector3d& r, const Matrix3d& I) { return I + pointInertia(mass, r); }

/// Replaces mass centres by first moments, and inertias by those about P and the links' first ends. Efforts are linear
/// in these.
ManipulatorParameters withMoments(ManipulatorParameters machine) {
  Platform& platform = machine.platform;
  platform.inertia = about(platform.mass, platform.center_of_mass, platform.inertia);
  platform.center_of_mass *= platform.mass;
  for (Leg& leg : machine.legs)
    for (Link* link : {&leg.proximal, &leg.distal}) {
      const Vector3d center = link->off_line + link->center_of_mass * Vector3d::UnitZ();
      link->inertia = about(link->mass, center, link->inertia);
      link->center_of_mass *= link->mass;
      link->off_line *= link->mass;
    }
  return machine;
}

/// The name of the replacing parameter: "manipulator.leg.2.distal.first_moment".
std::string momentName(const MachineNumber& number) {
  std::string out = number.path;
  if (number.quantity == Quantity::rotor_inertia) return out;
  const auto rename = [&out](const std::string& from, const char* to) {
    if (const auto at = out.find(from); at != std::string::npos) out.replace(at, from.size(), to);
  };
  rename("center_of_mass", "first_moment");
  rename("inertia", number.leg < 0 ? "inertia_at_P" : "inertia_at_end");
  return out;
}

}  // namespace

struct EffortDerivatives::Impl {
  explicit Impl(const Manipulator& manipulator)
      : by_state(kernel::machineModel(MachineParameters<Dual>(manipulator))),
        machine(manipulator),
        unit(unitBodies(machine)),
        numbers(machineNumbers(manipulator.parameters())),
        raw(manipulator.parameters()) {
    const ManipulatorParameters moments = withMoments(manipulator.parameters());
    for (const MachineNumber& number : numbers) {
      parameters.push_back(number.path);
      if (!number.isLinear()) continue;
      linear.push_back(number);
      regressor.push_back(momentName(number));
      values.push_back(number.get(moments));
    }
  }

  /// Computes a column for each number of `at`; one pass handles `dual_width`.
  static Columns columns(const UnnormalisedMachine& at, const std::vector<MachineNumber>& numbers,
                         const Motion<double>& motion, const Vector6d& load) {
    const int count = static_cast<int>(numbers.size());
    Columns out(6, count);
    const Motion<Dual> m = constant(motion);
    const Vector6<Dual> on_platform = load.cast<Dual>();
    for (int first = 0; first < count; first += dual_width) {
      const int here = std::min(dual_width, count - first);
      UnnormalisedMachine seeded = at;
      for (int k = 0; k < here; ++k) seed(seeded, numbers[first + k], k);
      const Vector6<Dual> found = efforts(modelOf(seeded), m, on_platform);
      for (int k = 0; k < here; ++k)
        for (int row = 0; row < 6; ++row) out(row, first + k) = found(row).derivatives()(k);
    }
    requireFinite(out.data(), out.size(), "derivative", motion.t);
    return out;
  }

  /// The kernels' model with derivatives. Frames follow the axes, and zero friction and products of inertia are kept,
  /// because they have derivatives.
  static kernel::MachineModel<Dual> modelOf(UnnormalisedMachine& seeded) {
    MachineParameters<Dual>& m = seeded.parameters;
    for (int i = 0; i < m.legs_in_all; ++i)
      setFixedFrame<Dual>(seeded.axis[i], m.legs[i].x_hat, m.legs[i].u, m.legs[i].z_hat);
    kernel::MachineModel<Dual> model = kernel::machineModel(m);
    for (int i = 0; i < m.legs_in_all; ++i) {
      model.legs[i].has_friction = model.legs[i].has_coulomb = true;
      model.legs[i].principal = false;
    }
    return model;
  }

  kernel::MachineModel<Dual> by_state;
  UnnormalisedMachine machine, unit;
  std::vector<MachineNumber> numbers, linear;
  ManipulatorParameters raw;
  std::vector<std::string> parameters, regressor;
  std::vector<double> values;
};

EffortDerivatives::EffortDerivatives(const Manipulator& manipulator)
    : impl_(std::make_shared<const Impl>(manipulator)) {}

EffortsByState EffortDerivatives::byState(const Motion<double>& motion, const Vector6d& load,
                                          const EffortsByState::Block& load_by_turn) const {
  Motion<Dual> m = constant(motion);
  for (int k = 0; k < 3; ++k) {  // Q becomes exp([δ]×) Q
    const Vector3d q = motion.Q.col(k);
    for (int j = 0; j < 3; ++j) {
      const Vector3d slope = Vector3d::Unit(j).cross(q);
      for (int row = 0; row < 3; ++row) m.Q(row, k).derivatives()(j) = slope(row);
    }
  }
  seed(3, m.p);
  seed(6, m.omega);
  seed(9, m.p_dot);
  seed(12, m.omega_dot);
  seed(15, m.p_ddot);
  Vector6<Dual> on_platform = load.cast<Dual>();
  for (int row = 0; row < 6; ++row)
    for (int j = 0; j < 3; ++j) on_platform(row).derivatives()(j) = load_by_turn(row, j);
  const Vector6<Dual> found = efforts(impl_->by_state, m, on_platform);
  EffortsByState out;
  for (int row = 0; row < 6; ++row) {
    out.efforts(row) = found(row).value();
    out.derivatives.row(row) = found(row).derivatives().transpose();
  }
  finite(out.efforts, "effort", motion.t);
  requireFinite(out.derivatives.data(), out.derivatives.size(), "derivative", motion.t);
  return out;
}

const std::vector<std::string>& EffortDerivatives::parameterNames() const { return impl_->parameters; }

EffortDerivatives::Columns EffortDerivatives::byParameters(const Motion<double>& motion, const Vector6d& load) const {
  return Impl::columns(impl_->machine, impl_->numbers, motion, load);
}

const std::vector<std::string>& EffortDerivatives::regressorNames() const { return impl_->regressor; }

Eigen::VectorXd EffortDerivatives::regressorValues() const {
  return Eigen::Map<const Eigen::VectorXd>(impl_->values.data(), static_cast<Eigen::Index>(impl_->values.size()));
}

/// π is at most quadratic in each number, so a central difference is exact to rounding at any step.
Eigen::MatrixXd EffortDerivatives::regressorByParameters() const {
  Eigen::MatrixXd out(impl_->linear.size(), impl_->numbers.size());
  const auto momentsWith = [this](const MachineNumber& number, double value) {
    ManipulatorParameters changed = impl_->raw;
    number.set(changed, value);
    return withMoments(std::move(changed));
  };
  for (std::size_t j = 0; j < impl_->numbers.size(); ++j) {
    const MachineNumber& number = impl_->numbers[j];
    const double value = number.get(impl_->raw), step = std::max(std::abs(value), 1e-3);
    const ManipulatorParameters above = momentsWith(number, value + step), below = momentsWith(number, value - step);
    for (std::size_t i = 0; i < impl_->linear.size(); ++i)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          (impl_->linear[i].get(above) - impl_->linear[i].get(below)) / (2 * step);
  }
  return out;
}

EffortDerivatives::Columns EffortDerivatives::regressor(const Motion<double>& motion) const {
  return Impl::columns(impl_->unit, impl_->linear, motion, Vector6d::Zero());
}

}  // namespace ursula
