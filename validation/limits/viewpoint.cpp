#include "validation/limits/viewpoint.h"

#include "model/loops/simbody/simbody_loop.h"
#include "nocsolver/reactions.h"
#include "nocsolver/solver.h"
#include "validation/verdict/worst_share.h"

namespace ursula {

struct Viewpoint::Roads {
  Roads(const Manipulator& machine, std::shared_ptr<const Load> load_)
      : solver(machine),
        load(std::move(load_)),
        six_balls(machine, SimbodyLoop::Topology::six_balls, load),
        further(makeFurtherRoads(machine, load)) {}

  Solver<double> solver;
  Workspace<double> work;
  std::shared_ptr<const Load> load;
  SimbodyLoop six_balls;
  OfFurtherRoads<std::unique_ptr<Road>> further;
};

namespace {

JointMotion joints(const Solver<double>& solver, const Workspace<double>& work) {
  return {solver.angles(work), solver.rates(work), solver.accelerations(work)};
}

Vector6d rates(const Motion<double>& motion) {
  Vector6d out;
  out << motion.omega_dot, motion.p_ddot;
  return out;
}

/// [ω; v] or [ω̇; v̇] from there to here; `time` is 1 for a twist, 2 for its rate.
Vector6d twistBack(const Presentation& p, const Vector6d& twist, int time) {
  const double unit = time == 1 ? p.units.time : p.units.time * p.units.time;
  Vector6d out;
  out << p.turn.transpose() * twist.head<3>() / unit, p.turn.transpose() * twist.tail<3>() * p.units.length / unit;
  return out;
}

}  // namespace

Viewpoint::Viewpoint(const Scenario& scenario, const Presentation& presentation)
    : presentation_(presentation),
      roads_(std::make_unique<Roads>(presentation.of(*scenario.manipulator), presentation.of(scenario.load))) {}
Viewpoint::~Viewpoint() = default;
Viewpoint::Viewpoint(Viewpoint&&) noexcept = default;

View Viewpoint::at(const Motion<double>& motion, const Vector6d& torques) {
  const Presentation& p = presentation_;
  Roads& r = *roads_;
  const Motion<double> there = p.of(motion);
  const Vector6d load = loadAtP(r.load.get(), there);
  View out;

  const Vector6d tau = r.solver.inverseDynamics(there, r.work, load);
  out.torques_solver = p.torquesBack(tau);
  r.solver.inverseKinematics(there, r.work);
  r.solver.jacobians(there, r.work);
  const JointMotion solver_joints = joints(r.solver, r.work);
  BodyMotions<double> bodies;
  r.solver.bodyMotions(there, r.work, bodies);
  const Matrix6d T = r.solver.T(r.work), T_rate = r.solver.TRate(there, r.work);
  out.joints_solver = p.back(solver_joints);
  out.bodies_solver = p.back(bodies);
  out.T = shapingBack(p, T);
  out.T_rate = shapingBack(p, T_rate) / p.units.time;
  out.reactions_solver = p.back(recoverReactions(r.solver, there, tau, r.work));
  out.direct_solver = twistBack(p, r.solver.directDynamics(there, p.of(torques), r.work, load), 2);

  r.six_balls.place(there, solver_joints);
  out.bodies_simbody = p.back(r.six_balls.bodies());
  const JointMotion simbody = r.six_balls.place(there);
  const auto driven = [&r](const JointVariables<double>& q) { return q.driven(r.solver.chain().motors()); };
  out.joints_simbody = p.back(simbody);
  out.jacobian = twistBack(p, T * driven(simbody.q_dot), 1);
  out.jacobian_rate = twistBack(p, T * driven(simbody.q_ddot) + T_rate * driven(simbody.q_dot), 2);
  out.torques_simbody = p.torquesBack(r.six_balls.inverseDynamics());
  r.six_balls.accelerate(tau);
  out.acceleration = twistBack(p, rates(r.six_balls.platform()), 2);
  out.gap_acceleration = r.six_balls.gapAcceleration() * p.units.acceleration();
  out.reactions_simbody = p.back(r.six_balls.reactions());
  r.six_balls.accelerate(p.of(torques));
  out.direct_simbody = twistBack(p, rates(r.six_balls.platform()), 2);

  for (std::size_t k = 0; k < further_road_count; ++k)
    if (r.further[k]) out.torques_further[k] = p.torquesBack(r.further[k]->inverseDynamics(there));
  return out;
}

double distance(const LegReactions& a, const LegReactions& b, double length) {
  double difference = 0;
  for (Vector3d LegReactions::*force : {&LegReactions::f_A, &LegReactions::f_R, &LegReactions::f_B})
    difference = larger(difference, (a.*force - b.*force).norm());
  for (Vector3d LegReactions::*moment : {&LegReactions::n_A, &LegReactions::n_R})
    difference = larger(difference, (a.*moment - b.*moment).norm() / length);
  return difference;
}

}  // namespace ursula
