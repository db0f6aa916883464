// Efforts and accelerations. With G N = 0 and the motors' rates as identity rows of N, Nᵀ removes the multipliers from
// Simbody's residual forces f: τ = Nᵀ f. Accelerations come from Simbody's realize(Acceleration), or from
//   [M + A, Gᵀ; G, 0] [u̇; λ] = [forces; −bias]
// with Simbody's M and G, the rotors' inertias A, and as many rows of G as are independent.

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "simbody/simbody_mechanism_internal.h"

namespace ursula {

Eigen::VectorXd SimbodyMechanism::Impl::loads(const Eigen::VectorXd* efforts) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(state.getNU());
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const CoordinateInSimbody& c = coordinates[k];
    const MechanismJoint& joint = jointOf(c);
    const auto motor = static_cast<Eigen::Index>(k);
    double force = efforts != nullptr && motor < motorCount() ? (*efforts)(motor) : 0;
    const Eigen::VectorXd J = row(c, false).J;
    const double rate = J.dot(mapped(state.getU()));
    force -= joint.damping * rate;
    if (joint.friction != 0) force -= joint.friction * std::tanh(rate / joint.smoothing());
    if (joint.stiffness != 0) force -= joint.stiffness * (value(c) - joint.spring_reference);
    out += force * J;
  }
  return out;
}

// [recipe]
Eigen::VectorXd SimbodyMechanism::Impl::residual(const SimTK::Vector& accelerations,
                                                 const Eigen::VectorXd& applied) const {
  SimTK::Vector on_joints(state.getNU()), found;
  for (int i = 0; i < on_joints.size(); ++i) on_joints[i] = applied(i);
  matter.calcResidualForceIgnoringConstraints(state, on_joints, gravity.getBodyForces(state), accelerations, found);
  Eigen::VectorXd out = mapped(found);
  for (const CoordinateInSimbody& c : coordinates) {
    const double inertia = jointOf(c).rotor_inertia;
    if (inertia == 0) continue;
    const CoordinateRow at = row(c, true);
    out += inertia * (at.J.dot(mapped(accelerations)) + at.bias) * at.J;
  }
  return out;
}
// [/recipe]

SimbodyMechanism::OpenTree SimbodyMechanism::openTree() const {
  Impl& m = *impl_;
  m.realize(SimTK::Stage::Velocity);
  if (!m.rates) m.setRatesByMotors(LeastSquares(m.allRows()));
  OpenTree out{*m.rates, Eigen::MatrixXd(m.motorCount(), m.state.getNU()), mapped(m.u_dot)};
  for (Eigen::Index k = 0; k < m.motorCount(); ++k) out.S.row(k) = m.row(m.coordinates[k], false).J;
  return out;
}

Eigen::VectorXd SimbodyMechanism::residual(const Eigen::VectorXd& u_dot) const {
  impl_->realize(SimTK::Stage::Velocity);
  SimTK::Vector accelerations(static_cast<int>(u_dot.size()));
  for (int i = 0; i < accelerations.size(); ++i) accelerations[i] = u_dot(i);
  return impl_->residual(accelerations, impl_->loads(nullptr));
}

SimTK::Vector SimbodyMechanism::Impl::eliminated(const Eigen::VectorXd& efforts) const {
  realize(SimTK::Stage::Velocity);
  const int nu = state.getNU();
  SimTK::Matrix of_bodies;
  matter.calcM(state, of_bodies);
  Eigen::MatrixXd M(nu, nu);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nu; ++j) M(i, j) = of_bodies(i, j);
  for (const CoordinateInSimbody& c : coordinates)
    if (const double inertia = jointOf(c).rotor_inertia; inertia != 0) {
      const Eigen::VectorXd J = row(c, false).J;
      M += inertia * J * J.transpose();
    }
  M = column_scale.asDiagonal() * M * column_scale.asDiagonal();
  const Eigen::MatrixXd G = closureRows();
  const Eigen::VectorXd bias = closureBias();
  const Eigen::VectorXi independent = LeastSquares(G.transpose()).independentColumns();
  const Eigen::Index m = independent.size();
  const double scale = M.cwiseAbs().maxCoeff();  // multipliers as large as accelerations
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(nu + m, nu + m);
  Eigen::VectorXd right(nu + m);
  all.topLeftCorner(nu, nu) = M;
  right.head(nu) = -column_scale.cwiseProduct(residual(SimTK::Vector(nu, 0.0), loads(&efforts)));
  for (Eigen::Index i = 0; i < m; ++i) {
    all.row(nu + i).head(nu) = scale * G.row(independent(i));
    all.col(nu + i).head(nu) = all.row(nu + i).head(nu).transpose();
    right(nu + i) = -scale * bias(independent(i));
  }
  const Eigen::VectorXd found = all.partialPivLu().solve(right);
  SimTK::Vector out(nu);
  for (int i = 0; i < nu; ++i) out[i] = found(i) * column_scale(i);
  return out;
}

SimTK::Vector SimbodyMechanism::Impl::byRealizing(const Eigen::VectorXd& efforts) {
  realize(SimTK::Stage::Velocity);
  const Eigen::VectorXd forces_now = loads(&efforts);
  SimTK::Vector on_joints(state.getNU());
  for (int i = 0; i < on_joints.size(); ++i) on_joints[i] = forces_now(i);
  discrete.setAllMobilityForces(state, on_joints);
  realize(SimTK::Stage::Acceleration);
  return state.getUDot();
}

// The open tree accelerates by u̇₀ = M⁻¹ f. The multipliers λ close the loops: (G M⁻¹ Gᵀ) λ = −(G u̇₀ + bias).
SimTK::Vector SimbodyMechanism::Impl::byMultipliers(const Eigen::VectorXd& efforts) const {
  realize(SimTK::Stage::Velocity);
  const int nu = state.getNU();
  SimTK::Vector force(nu), found;
  const auto byInertia = [&](const Eigen::VectorXd& f) -> Eigen::VectorXd {
    for (int i = 0; i < nu; ++i) force[i] = f(i);
    matter.multiplyByMInv(state, force, found);
    return mapped(found);
  };
  const Eigen::MatrixXd scaled = closureRows();
  const Eigen::VectorXi independent = LeastSquares(scaled.transpose()).independentColumns();
  const Eigen::VectorXd bias = closureBias();
  Eigen::VectorXd u_dot_now = byInertia(-residual(SimTK::Vector(nu, 0.0), loads(&efforts)));
  const Eigen::Index m = independent.size();
  Eigen::MatrixXd G(m, nu), per_multiplier(nu, m);
  Eigen::VectorXd along(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    G.row(i) = scaled.row(independent(i)).cwiseQuotient(column_scale.transpose());
    per_multiplier.col(i) = byInertia(G.row(i));
    along(i) = bias(independent(i));
  }
  const Eigen::LLT<Eigen::MatrixXd> factors(G * per_multiplier);
  for (int pass = 0; pass < 2; ++pass)  // the second takes the first one's rounding away
    u_dot_now -= per_multiplier * factors.solve(G * u_dot_now + along);
  SimTK::Vector out(nu);
  for (int i = 0; i < nu; ++i) out[i] = u_dot_now(i);
  return out;
}

/// Simbody's own accelerations fail for tips without inertia, and lack the rotors.
bool SimbodyMechanism::Impl::simbodyAgrees() try {
  for (const CoordinateInSimbody& c : coordinates)
    if (jointOf(c).rotor_inertia != 0) return false;
  const Eigen::VectorXd any = Eigen::VectorXd::Ones(motorCount());
  const SimTK::Vector truth = eliminated(any), own = byRealizing(any);
  return (own - truth).norm() <= 1e-8 * truth.norm();
} catch (const SimTK::Exception::Base&) {
  return false;
}

Eigen::VectorXd SimbodyMechanism::Impl::motorAccelerations() const {
  Eigen::VectorXd out(motorCount());
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    const CoordinateRow at = row(coordinates[k], true);
    out(k) = at.J.dot(mapped(u_dot)) + at.bias;
  }
  return out;
}

Eigen::VectorXd SimbodyMechanism::inverseDynamics() const {
  Impl& m = *impl_;
  m.realize(SimTK::Stage::Velocity);
  if (!m.rates) m.setRatesByMotors(LeastSquares(m.allRows()));
  return m.rates->transpose() * m.residual(m.u_dot, m.loads(nullptr));
}

Eigen::VectorXd SimbodyMechanism::accelerations(const Eigen::VectorXd& efforts) {
  impl_->u_dot = impl_->simbodys_own ? impl_->byRealizing(efforts) : impl_->eliminated(efforts);
  return impl_->motorAccelerations();
}

Eigen::VectorXd SimbodyMechanism::accelerationsByElimination(const Eigen::VectorXd& efforts) {
  impl_->u_dot = impl_->eliminated(efforts);
  return impl_->motorAccelerations();
}

bool SimbodyMechanism::usesSimbodysOwn() const { return impl_->simbodys_own; }

SimbodyMechanism::Energy SimbodyMechanism::energy() const {
  const Impl& m = *impl_;
  m.realize(SimTK::Stage::Velocity);
  Energy out{m.system.calcKineticEnergy(m.state), m.gravity.getPotentialEnergy(m.state)};
  for (const CoordinateInSimbody& c : m.coordinates) {
    const MechanismJoint& joint = m.jointOf(c);
    if (joint.rotor_inertia != 0) out.kinetic += joint.rotor_inertia * std::pow(m.rate(c), 2) / 2;
    if (joint.stiffness != 0) out.potential += joint.stiffness * std::pow(m.value(c) - joint.spring_reference, 2) / 2;
  }
  return out;
}

double SimbodyMechanism::losses() const {
  impl_->realize(SimTK::Stage::Velocity);
  double out = 0;
  for (const CoordinateInSimbody& c : impl_->coordinates) {
    const MechanismJoint& joint = impl_->jointOf(c);
    const double rate = impl_->rate(c);
    out += joint.damping * rate * rate;
    if (joint.friction != 0) out += joint.friction * std::tanh(rate / joint.smoothing()) * rate;
  }
  return out;
}

}  // namespace ursula
