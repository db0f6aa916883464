#include "validation/samples/simbody_answers.h"

#include "nocsolver/errors.h"
#include "validation/subject/same_bits.h"

namespace ursula {
namespace {

Motion<double> moved(SimbodyLoop& loop, const Motion<double>& motion, const Vector6d& torques) {
  loop.place(motion);
  loop.accelerate(torques);
  return loop.platform();
}

BodyMotions<double> placed(SimbodyLoop& loop, const Motion<double>& motion, const JointMotion& joints) {
  loop.place(motion, joints);
  return loop.bodies();
}

}  // namespace

Motion<double> SimbodyAnswer::platformUnder(const Vector6d& subjects, SimbodyLoop& loop,
                                            const Motion<double>& motion) const {
  return right && sameBits(right->torques, subjects) ? right->moved : moved(loop, motion, subjects);
}

Reactions SimbodyAnswer::reactionsUnder(const Vector6d& subjects, SimbodyLoop& loop,
                                        const Motion<double>& motion) const {
  if (right && sameBits(right->torques, subjects)) return right->reactions;
  moved(loop, motion, subjects);
  return loop.reactions();
}

BodyMotions<double> SimbodyAnswer::bodiesIn(const JointMotion& subjects, SimbodyLoop& loop,
                                            const Motion<double>& motion) const {
  return right && sameBits(right->joints, subjects) ? right->bodies : placed(loop, motion, subjects);
}

SimbodyAnswer simbodyAnswer(SimbodyLoop& loop, const Subject& right, const Motion<double>& motion) {
  SimbodyAnswer out;
  out.joints = loop.place(motion);
  out.torques = loop.inverseDynamics();
  try {
    SimbodyAnswer::OfRight of_right;
    of_right.torques = right.torques(motion);
    loop.accelerate(of_right.torques);
    of_right.moved = loop.platform();
    of_right.reactions = loop.reactions();
    of_right.joints = right.kinematics(motion).joints;
    of_right.bodies = placed(loop, motion, of_right.joints);
    out.right = of_right;
  } catch (const PoseError&) {
    // Whoever is on trial is asked himself.
  }
  return out;
}

std::vector<SimbodyAnswer> simbodyAnswers(const Scenario& scenario, const std::vector<double>& instants) {
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  std::vector<SimbodyAnswer> out;
  out.reserve(instants.size());
  for (double t : instants) out.push_back(simbodyAnswer(loop, right, scenario.trajectory->at(t)));
  return out;
}

}  // namespace ursula
