#include "validation/limits/conditioning.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "validation/limits/engine_view.h"
#include "validation/subject/scaled_jacobian.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();

/// Sizes of inertia and gravity wrenches on a body, [moment; force], as sums of magnitudes without cancellation. Norms
/// make them independent of the frame.
struct WrenchSize {
  double moment, force;
};

WrenchSize wrenchSize(const BodyMotion<double>& body, double mass, const Matrix3d& inertia, const Vector3d& gravity) {
  const double I = inertia.norm(), omega = body.twist.head<3>().norm();
  return {I * (body.twist_rate.head<3>().norm() + omega * omega),
          mass * (body.twist_rate.tail<3>().norm() + gravity.norm())};
}

/// Friction magnitude; a force on d counts as a moment at the machine's length.
double frictionMagnitude(const Leg& leg, const JointVariables<double>& rates, int i, double length) {
  return leg.friction.phi * std::abs(rates.phi(i)) + leg.friction.psi * std::abs(rates.psi(i)) +
         leg.friction.theta * std::abs(rates.theta(i)) + leg.coulomb.phi + leg.coulomb.psi + leg.coulomb.theta +
         length * (leg.friction.d * std::abs(rates.d(i)) + leg.coulomb.d);
}

/// ‖|T|ᵀ|w|‖ with friction and load; I = TᵀMT.
struct Projection {
  double torque_scale = 0;
  Matrix6d inertia = Matrix6d::Zero();
};

Projection project(const Manipulator& manipulator, const TwistShaping<double>& T, const BodyMotions<double>& bodies,
                   const JointVariables<double>& rates, double length) {
  Projection out;
  Vector6d torque = Vector6d::Zero();
  double friction = 0, largest_spin = 0;
  for (int b = 0; b < body_count; ++b) {
    const int leg_index = b % leg_count;
    const bool is_platform = b == 2 * leg_count;
    if (!is_platform && leg_index >= manipulator.legCount()) continue;
    const Leg& leg = manipulator.leg(is_platform ? 0 : leg_index);
    const Link& link = b < leg_count ? leg.proximal : leg.distal;
    const double mass = is_platform ? manipulator.platform().mass : link.mass;
    const Matrix3d& inertia = is_platform ? manipulator.platform().inertia : link.inertia;
    const Eigen::Matrix<double, 6, 6> T_b = T.block<6, 6>(6 * b, 0);
    const WrenchSize w = wrenchSize(bodies[b], mass, inertia, manipulator.gravity());
    torque += w.moment * T_b.topRows<3>().colwise().norm() + w.force * T_b.bottomRows<3>().colwise().norm();
    out.inertia += mass * T_b.bottomRows<3>().transpose() * T_b.bottomRows<3>() +
                   T_b.topRows<3>().transpose() * (bodies[b].R * inertia * bodies[b].R.transpose()) * T_b.topRows<3>();
    if (!is_platform) largest_spin = std::max(largest_spin, T_b.topRows<3>().colwise().norm().maxCoeff());
    if (b < leg_count) friction += frictionMagnitude(leg, rates, b, length);
  }
  // The same T projects friction on ψ, θ to the actuators; its rows are about as large as the links' spins.
  out.torque_scale = torque.norm() + friction * std::max(1.0, largest_spin);
  return out;
}

/// The condition number of I divided by the roots of its diagonal, so a coordinate's unit does not matter. Infinite if
/// rounding makes I indefinite.
double conditionOfI(const Matrix6d& I) {
  const Vector6d root = I.diagonal().cwiseSqrt();
  const Matrix6d scaled = root.cwiseInverse().asDiagonal() * I * root.cwiseInverse().asDiagonal();
  const Vector6d eigenvalues = symmetricEigenvalues(scaled);
  return eigenvalues(0) > 0 ? eigenvalues(5) / eigenvalues(0) : std::numeric_limits<double>::infinity();
}

/// ‖1/m + [d]ᵀ I⁻¹ [d]‖ of a free link at its far end, where [d] is the cross product with the vector from its mass
/// centre. A thin rod does not contribute a rotation about its line.
double complianceAtEnd(const Link& link) {
  const double d = link.length - link.center_of_mass;
  const Vector3d& off = link.off_line;
  Matrix3d cross;
  cross << 0, -d, -off.y(), d, 0, off.x(), off.y(), -off.x(), 0;  // along z of its frame (40)
  Matrix3d inverse = Matrix3d::Zero();
  if (link.inertia(2, 2) > 0)
    inverse = link.inertia.inverse();
  else
    inverse.topLeftCorner<2, 2>() = link.inertia.topLeftCorner<2, 2>().inverse();
  return (Matrix3d::Identity() / link.mass + cross.transpose() * inverse * cross).norm();
}

/// Σ j‖J‖ for the sizes of the platform's accelerations; J has the rows of q̇ = J [L ω; ṗ].
double rotorScale(const Manipulator& manipulator, const Matrix6d& T_P, double rate_scale) {
  double out = 0;
  const Matrix6d J = T_P.inverse();
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = manipulator.motors()[m];
    out += manipulator.leg(motor.leg).rotor_inertia.on(motor.coordinate) * J.row(m).norm() * rate_scale;
  }
  return out;
}

/// Sets the properties of the platform and its holding forces without the legs.
void setPlatform(const Noc<double>& solver, const Manipulator& manipulator, const Motion<double>& motion,
                 const Vector6d& torques, const NocWorkspace<double>& work, Conditioning& out) {
  const Platform& platform = manipulator.platform();
  const double smallest_moment =
      Eigen::SelfAdjointEigenSolver<Matrix3d>(platform.inertia, Eigen::EigenvaluesOnly).eigenvalues()(0);
  double arm = 0;
  out.largest_mass = platform.mass;
  for (const Leg& leg : manipulator.parameters().legs) {
    arm = std::max(arm, (leg.platform_point - platform.center_of_mass).norm());
    out.largest_mass = std::max({out.largest_mass, leg.proximal.mass, leg.distal.mass});
    out.leg_compliance = std::max(out.leg_compliance, complianceAtEnd(leg.distal));
  }
  out.compliance = 1 / platform.mass + arm * arm / smallest_moment;
  double squares = 0;
  for (const LegReactions& leg : solver.reactions(motion, torques, work)) {
    squares += leg.f_B.squaredNorm();
    out.reaction = std::max(out.reaction, distance(leg, LegReactions{}, out.length));
  }
  out.force_scale = std::sqrt(squares);
  const double inertia = platform.mass * (manipulator.gravity().norm() + motion.p_ddot.norm());
  out.weight_ratio = inertia > 0 ? out.force_scale / inertia : 0;
}

void setLegs(const Noc<double>& solver, const NocWorkspace<double>& work, Conditioning& out) {
  out.smallest_sine = 1;
  for (int i = 0; i < solver.machine().legs_in_all; ++i) {
    const LegMargins<double>& margins = work.legs[i].margins;
    const double sine = margins.sine, lever = margins.leverage;
    out.kappa_legs = std::max(out.kappa_legs, lever * lever / (sine * sine));
    if (sine < out.smallest_sine) {
      out.smallest_sine = sine;
      out.smallest_sine_leg = i;
    }
  }
}

/// ‖T_PᵀM_P‖ with accelerations [L ω̇; p̈].
double effortScale(const Noc<double>& solver, const Motion<double>& motion, const NocWorkspace<double>& work,
                   double length) {
  Matrix6d effort = solver.platformShaping(work).transpose() * solver.massMatrixAtP(motion, work);
  effort.leftCols<3>() /= length;
  return effort.norm();
}

/// The largest coordinate relative to the centre of the base, for any origin of the base.
void setPositions(const Manipulator& manipulator, const Motion<double>& motion, const BodyMotions<double>& bodies,
                  Conditioning& out) {
  Vector3d middle = Vector3d::Zero();
  for (const Leg& leg : manipulator.parameters().legs) middle += leg.base_point / manipulator.legCount();
  out.position_scale = (motion.p - middle).norm() + out.length;
  for (const Leg& leg : manipulator.parameters().legs)
    out.position_scale = std::max(out.position_scale, (leg.base_point - middle).norm());
  for (int b = 0; b < body_count; ++b)
    if (b == 2 * leg_count || b % leg_count < manipulator.legCount())
      out.position_scale = std::max(out.position_scale, (bodies[b].c - middle).norm());
}

}  // namespace

double Conditioning::shape(Rounded quantity) const {
  const double torque = kappa_B * kappa_legs * torque_scale;
  const double platform = response * torque + compliance * force_scale;
  switch (quantity) {
    case Rounded::angles:
      return eps * kappa_legs * position_scale / length;
    case Rounded::rates:
      return eps * kappa_legs * kappa_B * twist_scale / length;
    case Rounded::accelerations:
      return eps * kappa_legs * kappa_legs * kappa_B * rate_scale / length;
    case Rounded::positions:
      return eps * kappa_legs * position_scale;
    case Rounded::twists:
      return eps * kappa_legs * kappa_B * twist_scale;
    case Rounded::twist_rates:
      return eps * kappa_legs * kappa_legs * kappa_B * rate_scale;
    case Rounded::jacobian:
      return eps * kappa_legs * kappa_B * kappa_B * twist_scale;
    case Rounded::jacobian_rate:
      return eps * kappa_legs * kappa_legs * kappa_B * kappa_B * rate_scale;
    case Rounded::shaping:
      return eps * kappa_B * kappa_legs * shaping_scale;
    case Rounded::shaping_rate:
      return eps * kappa_B * kappa_B * kappa_legs * kappa_legs * shaping_scale * twist_scale / length;
    case Rounded::torque:
    case Rounded::solver:
      return eps * torque;
    case Rounded::acceleration:
      return eps * platform;
    case Rounded::direct:
    case Rounded::solver_direct:  // I of (36) contains the condition of B twice
      return eps * kappa_B * platform;
    case Rounded::effort:
      return eps * (torque + effort_scale * compliance * force_scale);
    case Rounded::gaps:
      return eps * (compliance + leg_compliance) * force_scale;
    case Rounded::reactions:
      return eps * (torque / length * kappa_B + largest_mass * platform);
    case Rounded::further_engine:  // and all following quantities
      break;
  }
  return eps * torque;
}

double Conditioning::size(Rounded quantity) const {
  switch (quantity) {
    case Rounded::angles:
      return 1;
    case Rounded::rates:
      return twist_scale / length;
    case Rounded::accelerations:
      return rate_scale / length;
    case Rounded::positions:
      return position_scale;
    case Rounded::twists:
    case Rounded::jacobian:
      return twist_scale;
    case Rounded::twist_rates:
    case Rounded::jacobian_rate:
    case Rounded::gaps:  // differences of the bodies' accelerations
      return rate_scale;
    case Rounded::shaping:
      return shaping_scale;
    case Rounded::shaping_rate:
      return shaping_scale * (1 + twist_scale / length);
    case Rounded::acceleration:
      return response * effort;
    case Rounded::direct:
    case Rounded::solver_direct:
      return platform_rate;
    case Rounded::reactions:
      return reaction;
    case Rounded::torque:
    case Rounded::solver:
    case Rounded::effort:
    case Rounded::further_engine:  // and all following quantities
      break;
  }
  return effort;
}

double Conditioning::rounding(Rounded quantity) const {
  if (solvesWithI(quantity) && !hasDigitsOfI()) return std::numeric_limits<double>::infinity();
  const auto q = static_cast<std::size_t>(quantity);
  return std::isfinite(levels[q]) ? std::max(floors[q], shape(quantity) * levels[q])
                                  : std::numeric_limits<double>::infinity();
}

double Conditioning::complementRounding() const { return rounding_depth * eps * kappa_B * kappa_legs; }

ConditioningProbe::ConditioningProbe(const Manipulator& manipulator, std::shared_ptr<const Load> load)
    : manipulator_(manipulator), load_(std::move(load)), solver_(manipulator) {}

Conditioning ConditioningProbe::at(const Motion<double>& motion) {
  const Vector6d load = loadAtP(load_.get(), motion);
  const Vector6d torques = solver_.inverseDynamics(motion, work_, load);
  const BodyMotions<double>& bodies = work_.bodies;

  Conditioning out;
  out.length = solver_.machine().length;
  setLegs(solver_, work_, out);
  const Matrix6d B = scaledB(work_.B, out.length);
  out.kappa_B = conditionNumber(B);
  const Projection projection = project(manipulator_, work_.T, bodies, solver_.rates(work_), out.length);
  Matrix6d I = projection.inertia;
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = manipulator_.motors()[m];
    I(m, m) += manipulator_.leg(motor.leg).rotor_inertia.on(motor.coordinate);
  }
  out.kappa_I = conditionOfI(I);
  Matrix6d T_P = solver_.platformShaping(work_);
  T_P.topRows<3>() *= out.length;
  setPlatform(solver_, manipulator_, motion, torques, work_, out);
  out.torque_scale =
      projection.torque_scale + T_P.norm() * (load.head<3>().norm() / out.length + load.tail<3>().norm());
  out.response = (T_P * I.llt().solve(Matrix6d::Identity())).norm();
  out.shaping_scale = T_P.norm();
  out.effort_scale = effortScale(solver_, motion, work_, out.length);
  setPositions(manipulator_, motion, bodies, out);
  for (const BodyMotion<double>& body : bodies) {
    out.twist_scale = std::max(out.twist_scale, twistSize(body.twist, out.length));
    out.rate_scale = std::max(out.rate_scale, twistSize(body.twist_rate, out.length));
  }
  out.rate_scale += out.twist_scale * out.twist_scale / out.length;
  out.effort = torques.cwiseAbs().maxCoeff();
  out.platform_rate = motion.p_ddot.norm() + out.length * motion.omega_dot.norm();
  if (hasRotors(manipulator_)) out.torque_scale += rotorScale(manipulator_, T_P, out.rate_scale);
  return out;
}

namespace {

/// Names the formulation that is too noisy for a level; empty if none is. One quantity's noise enters others, too.
std::string causeOfNoise(const Conditioning& at) {
  for (std::size_t q = 0; q < rounded_count; ++q)
    if (at.noisy[q] != Noisy::nobody)
      return fmt::format(
          "{} is noisy: its answers to inputs changed by one rounding differ by more than {:g} times "
          "their conditioning, which no rounding explains",
          at.noisy[q] == Noisy::solver ? "this program's NOC" : nameOfEngine(static_cast<Rounded>(q)), most_spread);
  return "";
}

}  // namespace

const char* nameOfEngine(Rounded quantity) {
  const auto first = static_cast<std::size_t>(Rounded::further_engine), q = static_cast<std::size_t>(quantity);
  return q < first ? "Simbody, free platform" : furtherEngines()[q - first].name;
}

std::string causeOfRounding(const Conditioning& at, Rounded quantity) {
  if (std::string noise = causeOfNoise(at); !noise.empty()) return noise;
  if (solvesWithI(quantity) && !at.hasDigitsOfI())
    return fmt::format("rounding leaves the inertia I of (34) no digit, kappa(I) = {:.2g}", at.kappa_I);
  const double platform = at.compliance * at.largest_mass, link = at.leg_compliance * at.largest_mass;
  const double largest = std::max({at.weight_ratio, at.kappa_B, at.kappa_legs, platform, link});
  if (largest == at.weight_ratio)
    return fmt::format("the forces that close the loops are {:.2g} times the platform's weight and inertia force",
                       at.weight_ratio);
  if (largest == platform)
    return fmt::format(
        "at its joints the platform gives way {:.2g} times as easily as the heaviest body's mass: its mass or moments "
        "of inertia are small beside the links",
        platform);
  if (largest == link)
    return fmt::format(
        "at its joint a distal link gives way {:.2g} times as easily as the heaviest body's mass: its mass or moments "
        "of inertia are small",
        link);
  if (largest == at.kappa_B) return fmt::format("a singular pose is near, kappa(B) = {:.2g}", at.kappa_B);
  return fmt::format("leg {} is nearly stretched or folded, |sin theta| = {:.2g}, kappa(legs) = {:.2g}",
                     at.smallest_sine_leg + 1, at.smallest_sine, at.kappa_legs);
}

}  // namespace ursula
