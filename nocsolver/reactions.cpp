#include "nocsolver/reactions.h"

#include <Eigen/Geometry>

#include "nocsolver/kernels/dynamics.h"

namespace ursula {
namespace {

/// [n; f] that moves a body's mass centre against gravity. (28)
Vector6d movingWrench(const BodyMotion<double>& body, double mass, const Matrix3d& inertia, const Vector3d& gravity) {
  const Matrix3d I = body.R * inertia * body.R.transpose();
  const Vector3d omega = body.twist.head<3>();
  Vector6d w;
  w << I * body.twist_rate.head<3>() + omega.cross(I * omega), mass * (body.twist_rate.tail<3>() - gravity);
  return w;  // (paper, eq. 28)
}

/// The force of a leg on the platform, and the points of its two joints.
struct LegEnds {
  Vector3d f_B, A, R;
};

LegEnds endsOf(const PaperSolver<double>& solver, const Vector6d& torques, const PaperWorkspace<double>& work,
               std::size_t i, const BodyMotion<double>& first) {
  const PaperModel<double>& model = solver.model();
  const LegModel<double>& leg = model.legs[i];
  const LegState<double>& state = work.legs[i];
  // At B the leg gives along x what the motor leaves over, and across it takes what ψ and θ cannot bear.
  const JointTriple<double> Q =
      kernel::legForces(leg, state, work.proximal[i], work.distal[i], model.gravity, Corrected{});
  return {(torques(static_cast<int>(i)) - Q.phi) / state.a_ii * state.x - kernel::forceAtB(leg, state, Q), leg.a,
          leg.a + leg.l * first.R.col(2)};
}

LegEnds endsOf(const ChainSolver<double>& solver, const Vector6d& efforts, const ChainWorkspace<double>& work,
               std::size_t i) {
  const ChainState<double>& state = work.legs[i];
  const Vector3d& a = solver.leg(static_cast<int>(i)).a;
  return {solver.forceOnPlatform(work, static_cast<int>(i), efforts), a + state.O_1, a + state.O_2};
}

}  // namespace

Reactions recoverReactions(const Solver<double>& solver, const Motion<double>& motion, const Vector6d& torques,
                           Workspace<double>& work) {
  const ChainSolver<double>& machine = solver.chain();
  BodyMotions<double> bodies;
  solver.inverseKinematics(motion, work);
  solver.bodyMotions(motion, work, bodies);
  Reactions out;
  for (std::size_t i = 0; i < static_cast<std::size_t>(machine.legCount()); ++i) {
    const ChainModel<double>& leg = machine.leg(static_cast<int>(i));
    const BodyMotion<double>&first = bodies[i], &second = bodies[leg_count + i];
    LegReactions& reaction = out[i];
    const LegEnds ends = solver.paper() != nullptr ? endsOf(*solver.paper(), torques, work.paper, i, first)
                                                   : endsOf(machine, torques, work.chain, i);
    reaction.f_B = ends.f_B;

    const Vector3d &A = ends.A, &R = ends.R, B = motion.p + motion.Q * leg.b;
    const Vector6d w_second = movingWrench(second, leg.mass_2, leg.I_2, machine.gravity());
    reaction.f_R = w_second.tail<3>() + reaction.f_B;
    reaction.n_R = w_second.head<3>() - (R - second.c).cross(reaction.f_R) + (B - second.c).cross(reaction.f_B);
    const Vector6d w_first = movingWrench(first, leg.mass_1, leg.I_1, machine.gravity());
    reaction.f_A = w_first.tail<3>() + reaction.f_R;
    reaction.n_A =
        w_first.head<3>() + reaction.n_R - (A - first.c).cross(reaction.f_A) + (R - first.c).cross(reaction.f_R);
  }
  return out;
}

}  // namespace ursula
