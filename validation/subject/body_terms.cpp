#include "validation/subject/body_terms.h"

#include <Eigen/LU>
#include <cmath>

namespace ursula {
namespace {

Matrix3d crossed(const Vector3d& r) {
  Matrix3d out;
  out << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return out;
}

using UnitTwists = Eigen::Matrix<double, 6, 3>;

/// The leg's three unit twists for a link at c; only the `joints` before the link have non-zero columns.
UnitTwists unitTwists(const LegKindRow& row, const LegPoints& points, const Vector3d& c, int joints) {
  UnitTwists out = UnitTwists::Zero();
  for (int j = 0; j < joints; ++j) {
    const Vector3d& axis = points.axes[j];
    const Vector3d& at = j < row.joints_of_proximal ? points.A : points.S;
    if (slides(row.coordinates[j]))
      out.col(j) << Vector3d::Zero(), axis;
    else
      out.col(j) << axis, axis.cross(Vector3d(c - at));
  }
  return out;
}

double frictionOf(const Leg& leg, Coordinate coordinate, double rate) {
  return leg.friction.on(coordinate) * rate +
         leg.coulomb.on(coordinate) * std::tanh(rate / leg.coulomb.speedOf(coordinate));
}

/// M times twists, (29).
UnitTwists massTimes(const BodyTerms& body, const UnitTwists& twists) {
  UnitTwists out;
  out << body.inertia * twists.topRows<3>(), body.mass * twists.bottomRows<3>();
  return out;
}

}  // namespace

Vector6d BodyTerms::inertiaWrench(const Vector6d& rate) const {
  Vector6d out;
  out << inertia * rate.head<3>() + omega().cross(inertia * omega()), mass * rate.tail<3>();
  return out;
}

Vector6d BodyTerms::gravityWrench() const { return forceWrench(mass * gravity); }

Vector6d BodyTerms::efforts() const { return T.transpose() * (inertiaWrench(twist_rate) - gravityWrench()); }

Vector6d momentWrench(const Vector3d& n) {
  Vector6d out;
  out << n, Vector3d::Zero();
  return out;
}

Vector6d forceWrench(const Vector3d& f) {
  Vector6d out;
  out << Vector3d::Zero(), f;
  return out;
}

Vector6d OpenLeg::atP(const Vector3d& of_coordinates) const {
  return P.transpose() * J.transpose().lu().solve(of_coordinates);
}

Vector6d MachineTerms::forceAtP() const {
  Vector6d out = platform_wrench;
  for (const OpenLeg& leg : legs) out += leg.atP(leg.efforts);
  return out;
}

Vector6d MachineTerms::ofAccelerations(const std::function<Vector3d(const OpenLeg&)>& off) const {
  Vector6d at_P = Vector6d::Zero();
  for (const OpenLeg& leg : legs) at_P += leg.atP(leg.mass * leg.J.lu().solve(off(leg)));
  return T_P.transpose() * at_P;
}

MachineTerms machineTerms(const Manipulator& machine, const std::shared_ptr<const Load>& load,
                          const Motion<double>& motion) {
  const Noc<double> noc(machine);
  NocWorkspace<double> work;
  noc.inverseKinematics(motion, work);
  noc.jacobians(motion, work);
  noc.bodyMotions(motion, work, work.bodies);
  noc.twistShaping(motion, work);
  const std::vector<LegPoints> points = legPoints(machine, work);
  const auto body_terms = [&](double mass, const Matrix3d& inertia, std::size_t body) {
    const BodyMotion<double>& at = work.bodies[body];
    BodyTerms out;
    out.mass = mass;
    out.inertia = at.R * inertia * at.R.transpose();
    out.R = at.R;
    out.c = at.c;
    out.twist = at.twist;
    out.twist_rate = at.twist_rate;
    out.T = work.T.middleRows<6>(6 * static_cast<int>(body));
    out.gravity = machine.gravity();
    return out;
  };

  MachineTerms out;
  out.motors = machine.motors();
  out.T_P = noc.platformShaping(work);
  out.rate_at_P << motion.omega_dot, motion.p_ddot;
  out.rho = motion.Q * machine.platform().center_of_mass;
  out.platform = body_terms(machine.platform().mass, machine.platform().inertia, 2 * leg_count);
  out.platform.from = out.rho;
  out.platform_wrench = out.platform.inertiaWrench(out.platform.twist_rate) - out.platform.gravityWrench();
  out.platform_wrench.head<3>() += out.rho.cross(Vector3d(out.platform_wrench.tail<3>()));
  out.platform_wrench -= loadAtP(load.get(), motion);
  const JointVariables<double> rate = noc.rates(work), acceleration = noc.accelerations(work);
  for (std::size_t i = 0; i < points.size(); ++i) {
    OpenLeg open;
    const Leg& leg = open.numbers = machine.leg(static_cast<int>(i));
    const LegKindRow& row = rowOf(leg.kind);
    const LegPoints& at = points[i];
    BodyTerms& first = open.proximal = body_terms(leg.proximal.mass, leg.proximal.inertia, i);
    BodyTerms& second = open.distal = body_terms(leg.distal.mass, leg.distal.inertia, leg_count + i);
    if (!slides(row.coordinates[0])) first.line = first.R.col(2), first.from = first.c - at.A;
    second.line = second.R.col(2);
    second.from = second.c - (slides(row.coordinates[2]) ? at.A : at.S);
    if (slides(row.coordinates[2])) second.sliding = rate.d(static_cast<int>(i)) * at.axes[2];

    const auto wrench = [](const BodyTerms& body) {
      return Vector6d(body.inertiaWrench(body.twist_rate) - body.gravityWrench());
    };
    const UnitTwists of_first = unitTwists(row, at, first.c, row.joints_of_proximal);
    const UnitTwists of_second = unitTwists(row, at, second.c, 3);
    open.efforts = of_first.transpose() * wrench(first) + of_second.transpose() * wrench(second);
    Vector3d q_ddot;
    for (int j = 0; j < 3; ++j) {
      const Coordinate coordinate = row.coordinates[j];
      open.efforts(j) += frictionOf(leg, coordinate, rate.of(coordinate)(static_cast<int>(i)));
      q_ddot(j) = acceleration.of(coordinate)(static_cast<int>(i));
      open.mass(j, j) = leg.rotor_inertia.on(coordinate);
      open.efforts(j) += open.mass(j, j) * q_ddot(j);
    }
    first.bias = first.twist_rate - of_first * q_ddot;
    second.bias = second.twist_rate - of_second * q_ddot;
    open.mass +=
        of_first.transpose() * massTimes(first, of_first) + of_second.transpose() * massTimes(second, of_second);
    const Vector3d b = motion.Q * leg.platform_point;
    open.arm = b;
    open.platform_bias = motion.omega.cross(motion.omega.cross(b));
    open.J = unitTwists(row, at, at.B, 3).bottomRows<3>();
    open.P << -crossed(b), Matrix3d::Identity();
    open.coriolis = 2 * second.omega().cross(second.sliding);
    open.bias = motion.p_ddot + motion.omega_dot.cross(b) + open.platform_bias - open.J * q_ddot;
    out.legs.push_back(open);
  }
  return out;
}

}  // namespace ursula
