#include "validation/samples/simbody_answers.h"

#include "nocsolver/errors.h"
#include "validation/subject/same_bits.h"

namespace ursula {
namespace {

Vector6d twistRate(SimbodyLoop& loop) {
  const Motion<double> moved = loop.platform();
  Vector6d out;
  out << moved.omega_dot, moved.p_ddot;
  return out;
}

}  // namespace

Vector6d SimbodyAnswer::twistRateUnder(const Vector6d& subjects, SimbodyLoop& loop,
                                       const Motion<double>& motion) const {
  if (right && sameBits(right->torques, subjects)) return right->twist_rate;
  loop.place(motion);
  loop.accelerate(subjects);
  return twistRate(loop);
}

SimbodyAnswer simbodyAnswer(SimbodyLoop& loop, const Subject& right, const Motion<double>& motion) {
  SimbodyAnswer out;
  loop.place(motion);
  out.torques = loop.inverseDynamics();
  try {
    const Vector6d torques = right.torques(motion);
    loop.accelerate(torques);
    out.right = SimbodyAnswer::OfRight{torques, twistRate(loop)};
  } catch (const PoseError&) {
    // The subject is asked later and reports the error.
  }
  return out;
}

std::vector<SimbodyAnswer> simbodyAnswers(const Scenario& scenario, const std::vector<double>& instants,
                                          const Deadline& deadline, const EngineFault& fault) {
  SimbodyLoop loop(fault.applied(*scenario.manipulator), SimbodyLoop::Topology::ball_per_leg, scenario.load);
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  std::vector<SimbodyAnswer> out;
  out.reserve(instants.size());
  for (double t : instants) {
    deadline.require();
    out.push_back(simbodyAnswer(loop, right, scenario.trajectory->at(t)));
    out.back().torques = fault.applied(out.back().torques);
  }
  return out;
}

}  // namespace ursula
