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

}  // namespace

Reactions recoverReactions(const Solver<double>& solver, const Motion<double>& motion, const Vector6d& torques,
                           Workspace<double>& work) {
  const SolverModel<double>& model = solver.model();
  BodyMotions<double> bodies;
  solver.bodyMotions(motion, work, bodies);
  Reactions out;
  for (std::size_t i = 0; i < leg_count; ++i) {
    const LegModel<double>& leg = model.legs[i];
    const LegState<double>& state = work.legs[i];
    const BodyMotion<double>&first = bodies[i], &second = bodies[leg_count + i];
    LegReactions& reaction = out[i];
    // At B the leg gives along x what the motor leaves over, and across it takes what ψ and θ cannot bear.
    const JointTriple<double> Q =
        kernel::legForces(leg, state, work.proximal[i], work.distal[i], model.gravity, Corrected{});
    reaction.f_B = (torques(static_cast<int>(i)) - Q.phi) / state.a_ii * state.x - kernel::forceAtB(leg, state, Q);

    const Vector3d A = leg.a, R = A + leg.l * first.R.col(2), B = motion.p + state.Qb;
    const Vector6d w_second = movingWrench(second, leg.mass_distal, leg.I_distal, model.gravity);
    reaction.f_R = w_second.tail<3>() + reaction.f_B;
    reaction.n_R = w_second.head<3>() - (R - second.c).cross(reaction.f_R) + (B - second.c).cross(reaction.f_B);
    const Vector6d w_first = movingWrench(first, leg.mass_proximal, leg.I_proximal, model.gravity);
    reaction.f_A = w_first.tail<3>() + reaction.f_R;
    reaction.n_A =
        w_first.head<3>() + reaction.n_R - (A - first.c).cross(reaction.f_A) + (R - first.c).cross(reaction.f_R);
  }
  return out;
}

}  // namespace ursula
