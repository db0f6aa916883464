#include "nocsolver/fast/effort_derivatives.h"

#include <array>

#include "nocsolver/fast/dual.h"
#include "nocsolver/fast/kernels/leg_guard.h"
#include "nocsolver/fast/kernels/plane_dynamics.h"
#include "nocsolver/fast/machine_numbers.h"
#include "nocsolver/finite.h"
#include "nocsolver/legs/leg_model_impl.h"

namespace ursula {
namespace {

/// By the state: δ, p, ω, ṗ, ω̇, p̈.
using ByState = Dual<18>;
/// By as many of the machine's numbers at a time.
constexpr int at_a_time = 16;
using ByNumbers = Dual<at_a_time>;

template <class S>
Vector3<S> constant(const Vector3d& v) {
  return v.cast<S>();
}

template <class S>
Motion<S> constant(const Motion<double>& m) {
  return {S(m.t),
          constant<S>(m.p),
          m.Q.cast<S>(),
          constant<S>(m.omega),
          constant<S>(m.p_dot),
          constant<S>(m.omega_dot),
          constant<S>(m.p_ddot)};
}

/// Inverse dynamics by the kernels.
template <class S>
Vector6<S> efforts(const kernel::MachineModel<S>& machine, const Motion<S>& motion, const Vector6<S>& load) {
  S pivots;
  const auto guardOf = [&motion](int leg) { return kernel::LegGuard<S>{leg, motion.t}; };
  const Vector6<S> found = kernel::inverseDynamics<S>(machine, motion, load, guardOf, pivots);
  legs::requireRegularB(static_cast<double>(pivots), static_cast<double>(motion.t));
  return found;
}

void seed(int first, Vector3<ByState>& v) {
  for (int k = 0; k < 3; ++k) v(k).d(first + k) = 1;
}

template <class S>
WrittenMachine<S> written(const Manipulator& manipulator) {
  WrittenMachine<S> out{MachineParameters<S>(manipulator), {}};
  for (int i = 0; i < out.parameters.legs_in_all; ++i)
    out.axis[static_cast<std::size_t>(i)] = constant<S>(manipulator.leg(i).base_axis);
  return out;
}

/// Bodies of mass 1 at P and at the links' first ends, without inertia: derivatives there, by mass, distance and
/// inertia, are the columns of the regressor.
WrittenMachine<ByNumbers> unitBodies(WrittenMachine<ByNumbers> machine) {
  MachineParameters<ByNumbers>& m = machine.parameters;
  m.mass = 1;
  m.rho.setZero();
  m.I_M.setZero();
  for (LegModel<ByNumbers>& leg : m.legs) {
    leg.mass_1 = leg.mass_2 = 1;
    leg.rho = leg.sigma = 0;
    leg.I_1.setZero();
    leg.I_2.setZero();
  }
  return machine;
}

/// What numbers efforts are linear in are at their own values.
void addTensorAbout(double mass, const Vector3d& r, const Matrix3d& I, std::vector<double>& out) {
  const Matrix3d about = I + mass * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
  for (const double value : {about(0, 0), about(1, 1), about(2, 2), about(0, 1), about(0, 2), about(1, 2)})
    out.push_back(value);
}

void addLink(const Link& link, std::vector<double>& out) {
  out.push_back(link.mass);
  out.push_back(link.mass * link.center_of_mass);
  addTensorAbout(link.mass, link.center_of_mass * Vector3d::UnitZ(), link.inertia, out);
}

std::vector<double> regressorValuesOf(const Manipulator& machine) {
  const Platform& platform = machine.platform();
  std::vector<double> out = {platform.mass};
  for (int k = 0; k < 3; ++k) out.push_back(platform.mass * platform.center_of_mass(k));
  addTensorAbout(platform.mass, platform.center_of_mass, platform.inertia, out);
  for (const Leg& leg : machine.parameters().legs) {
    if (leg.kind == LegKind::PUS)
      out.push_back(leg.proximal.mass);
    else
      addLink(leg.proximal, out);
    addLink(leg.distal, out);
    for (const Coordinate coordinate : rowOf(leg.kind).coordinates) {
      out.push_back(leg.friction.on(coordinate));
      out.push_back(leg.coulomb.on(coordinate));
    }
  }
  return out;
}

}  // namespace

struct EffortDerivatives::Impl {
  explicit Impl(const Manipulator& manipulator)
      : by_state(kernel::machineModel(MachineParameters<ByState>(manipulator))),
        machine(written<ByNumbers>(manipulator)),
        unit(unitBodies(machine)),
        parameters(namesOf(machine, Numbers::parameters)),
        regressor(namesOf(machine, Numbers::regressor)),
        values(regressorValuesOf(manipulator)) {}

  static std::vector<std::string> namesOf(WrittenMachine<ByNumbers> machine, Numbers which) {
    std::vector<std::string> names;
    eachNumber(machine, which,
               [&names](const std::string& name, const std::vector<ByNumbers*>&) { names.push_back(name); });
    return names;
  }

  /// A column for each number of `at`, as many at a time as a dual number has slopes.
  Columns columns(const WrittenMachine<ByNumbers>& at, Numbers which, std::size_t count, const Motion<double>& motion,
                  const Vector6d& load) const {
    Columns out(6, static_cast<Eigen::Index>(count));
    const Motion<ByNumbers> m = constant<ByNumbers>(motion);
    const Vector6<ByNumbers> on_platform = load.cast<ByNumbers>();
    for (int first = 0; first < static_cast<int>(count); first += at_a_time) {
      WrittenMachine<ByNumbers> seeded = at;
      int next = 0;
      eachNumber(seeded, which, [&](const std::string&, const std::vector<ByNumbers*>& places) {
        const int slope = next++ - first;
        for (ByNumbers* place : places)
          if (slope >= 0 && slope < at_a_time) place->d(slope) = 1;
      });
      const Vector6<ByNumbers> found = efforts(modelOf(seeded), m, on_platform);
      for (int k = 0; k < at_a_time && first + k < static_cast<int>(count); ++k)
        for (int row = 0; row < 6; ++row) out(row, first + k) = found(row).d(k);
    }
    requireFinite(out.data(), static_cast<std::size_t>(out.size()), "derivative", motion.t);
    return out;
  }

  /// With friction wherever there could be some, and the frames of the axes as they are varied.
  static kernel::MachineModel<ByNumbers> modelOf(WrittenMachine<ByNumbers>& seeded) {
    MachineParameters<ByNumbers>& m = seeded.parameters;
    for (std::size_t i = 0; i < static_cast<std::size_t>(m.legs_in_all); ++i)
      setFixedFrame<ByNumbers>(seeded.axis[i], m.legs[i].x_hat, m.legs[i].u, m.legs[i].z_hat);
    kernel::MachineModel<ByNumbers> model = kernel::machineModel(m);
    for (std::size_t i = 0; i < static_cast<std::size_t>(m.legs_in_all); ++i) {
      model.legs[i].rubs = model.legs[i].rubs_dry = true;
      model.legs[i].principal = false;
    }
    return model;
  }

  kernel::MachineModel<ByState> by_state;
  WrittenMachine<ByNumbers> machine, unit;
  std::vector<std::string> parameters, regressor;
  std::vector<double> values;
};

EffortDerivatives::EffortDerivatives(const Manipulator& manipulator)
    : impl_(std::make_shared<const Impl>(manipulator)) {}

EffortsByState EffortDerivatives::byState(const Motion<double>& motion, const Vector6d& load,
                                          const EffortsByState::Block& load_by_turn) const {
  Motion<ByState> m = constant<ByState>(motion);
  for (int k = 0; k < 3; ++k) {  // Q becomes exp([δ]×) Q
    const Vector3d q = motion.Q.col(k);
    for (int j = 0; j < 3; ++j) {
      const Vector3d slope = Vector3d::Unit(j).cross(q);
      for (int row = 0; row < 3; ++row) m.Q(row, k).d(j) = slope(row);
    }
  }
  seed(3, m.p);
  seed(6, m.omega);
  seed(9, m.p_dot);
  seed(12, m.omega_dot);
  seed(15, m.p_ddot);
  Vector6<ByState> on_platform = load.cast<ByState>();
  for (int row = 0; row < 6; ++row)
    for (int j = 0; j < 3; ++j) on_platform(row).d(j) = load_by_turn(row, j);
  const Vector6<ByState> found = efforts(impl_->by_state, m, on_platform);
  EffortsByState out;
  for (int row = 0; row < 6; ++row) {
    out.efforts(row) = found(row).v;
    out.derivatives.row(row) = found(row).d.matrix().transpose();
  }
  finite(out.efforts, "effort", motion.t);
  requireFinite(out.derivatives.data(), static_cast<std::size_t>(out.derivatives.size()), "derivative", motion.t);
  return out;
}

const std::vector<std::string>& EffortDerivatives::parameterNames() const { return impl_->parameters; }

EffortDerivatives::Columns EffortDerivatives::byParameters(const Motion<double>& motion, const Vector6d& load) const {
  return impl_->columns(impl_->machine, Numbers::parameters, impl_->parameters.size(), motion, load);
}

const std::vector<std::string>& EffortDerivatives::regressorNames() const { return impl_->regressor; }

Eigen::VectorXd EffortDerivatives::regressorValues() const {
  return Eigen::Map<const Eigen::VectorXd>(impl_->values.data(), static_cast<Eigen::Index>(impl_->values.size()));
}

EffortDerivatives::Columns EffortDerivatives::regressor(const Motion<double>& motion) const {
  return impl_->columns(impl_->unit, Numbers::regressor, impl_->regressor.size(), motion, Vector6d::Zero());
}

}  // namespace ursula
