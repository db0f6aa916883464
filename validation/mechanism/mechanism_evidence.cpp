#include "validation/mechanism/mechanism_evidence.h"

#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "model/instants.h"
#include "simbody/simbody_mechanism.h"
#include "validation/subject/asked_instants.h"
#include "validation/subject/single_precision.h"

namespace ursula {
namespace {

double twistSize(const Vector6d& twist, double length) {
  return twist.tail<3>().norm() + length * twist.head<3>().norm();
}

/// ‖D T‖ over ‖T‖: what joints hold fixed does not move, for unit rates of each motor.
double acrossOf(const Mechanism& mechanism, const LoopWork& work) {
  double off = 0, size = 0;
  const double length = mechanism.length();
  const auto columnsAt = [&](std::size_t b, const Vector3d& reference) {
    const BodyState& state = work.bodies[b];
    const Vector3d r = state.displacement * reference - state.center;
    Eigen::MatrixXd out = work.T[b];
    for (Eigen::Index k = 0; k < out.cols(); ++k) out.block<3, 1>(3, k) += Vector3d(out.block<3, 1>(0, k)).cross(r);
    return out;
  };
  for (const MechanismJoint& joint : mechanism.joints()) {
    const Matrix3d R = work.bodies[joint.parent].displacement.linear();
    const Eigen::MatrixXd on_child = columnsAt(joint.child, joint.centre_of_child);
    const Vector3d at_child = work.bodies[joint.child].displacement * joint.centre_of_child;
    const Vector3d back = work.bodies[joint.parent].displacement.inverse() * at_child;
    const Eigen::MatrixXd relative = on_child - columnsAt(joint.parent, back);
    const Vector3d a = R * joint.axis[0];
    Eigen::MatrixXd turn = relative.topRows<3>() * length, slide = relative.bottomRows<3>();
    if (joint.kind == JointKind::free) continue;
    if (joint.kind == JointKind::revolute) turn -= a * (a.transpose() * turn);
    if (joint.kind == JointKind::prismatic) slide -= a * (a.transpose() * slide);
    if (joint.kind == JointKind::ball || joint.kind == JointKind::universal) turn.setZero();
    off = larger(off, std::max(turn.norm(), slide.norm()));
  }
  for (const Eigen::MatrixXd& T : work.T)
    size = larger(size, T.bottomRows<3>().norm() + length * T.topRows<3>().norm());
  return size > 0 ? off / size : 0;
}

int rankOfShaping(const LoopWork& work, double length) {
  Eigen::Index rows = 0;
  for (const Eigen::MatrixXd& T : work.T) rows += T.rows();
  Eigen::MatrixXd all(rows, work.N.cols());
  rows = 0;
  for (const Eigen::MatrixXd& T : work.T) {
    all.middleRows(rows, 6) = T;
    all.middleRows(rows, 3) *= length;
    rows += 6;
  }
  // Columns of unit norm: a motor with short links counts as much as one with long ones.
  for (Eigen::Index k = 0; k < all.cols(); ++k)
    if (const double norm = all.col(k).norm(); norm > 0) all.col(k) /= norm;
  return loops::rankByGap(all).rank;
}

void compareBodies(const SimbodyMechanism& engine, const LoopWork& work, double length, const LoopFreedoms& freedoms,
                   MechanismSample& sample) {
  const auto theirs = engine.bodies();
  for (std::size_t b = 0; b < theirs.size(); ++b) {
    const BodyState& ours = work.bodies[b];
    const Vector3d moved = ours.displacement.inverse() * ours.center;
    const double place = (theirs[b].displacement * moved - ours.center).norm() +
                         length * turnBetween(theirs[b].displacement, ours.displacement, freedoms.idleBody(b));
    sample.position = larger(sample.position, place);
    sample.twist = larger(sample.twist, twistSize(theirs[b].twist - ours.twist, length));
    sample.twist_rate = larger(sample.twist_rate, twistSize(theirs[b].twist_rate - ours.twist_rate, length));
    sample.twist_size = larger(sample.twist_size, twistSize(ours.twist, length));
    sample.twist_rate_size = larger(sample.twist_rate_size, twistSize(ours.twist_rate, length));
  }
}

std::vector<double> judgedInstants(const MechanismScenario& scenario, const MechanismSubject& subject) {
  if (!subject.given)
    return equallySpaced(scenario.trajectory->duration(), std::min(scenario.simulation.samples, subject.most_samples));
  return subject.given->t;
}

/// Asks the subject for many instants at once.
std::vector<MotorEfforts> answersOf(const MechanismSubject& subject, bool between, const LoopMotion& motion,
                                    const std::vector<double>& instants, const Deadline& deadline) {
  std::vector<MechanismQuestion> questions;
  LoopWork work;
  for (const double t : instants) {
    deadline.require();
    questions.push_back({motion.trajectory().at(t), {}});
    loops::LoopPose pose = motion.near(t);
    motion.solver().moveTo(questions.back().motion.q, pose);
    motion.solver().kinematics(questions.back().motion, pose, work);
    questions.back().joints = motion.solver().joints(work);
  }
  return between && subject.answers_between ? subject.answers_between(questions) : subject.answers(questions);
}

void setUnits(const Mechanism& mechanism, MechanismEvidence& out) {
  out.efforts_in = effortsInOneUnit(mechanism);
  bool all_slide = true;
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k) all_slide = all_slide && mechanism.motor(k).slides();
  out.unit = all_slide ? "N" : "N m";
}

/// The largest change of the efforts within a time of an instant, as rounded stamps of time leave it open.
MotorEfforts changeWithin(const LoopMotion& motion, double t, double time, const MotorEfforts& at) {
  MotorEfforts out = MotorEfforts::Zero(at.size());
  if (!(time > 0)) return out;
  LoopWork work;
  for (const double other : {t - time, t + time}) {
    const double inside = std::clamp(other, 0.0, motion.trajectory().duration());
    out = out.cwiseMax((motion.inverseDynamics(inside, work) - at).cwiseAbs()).eval();
  }
  return out;
}

/// Returns the sample's part that every judged instant has; `work` is then at that instant.
MechanismSample nocAt(const LoopMotion& motion, double t, LoopWork& work) {
  MechanismSample out;
  out.motion = motion.trajectory().at(t);
  out.noc = motion.inverseDynamics(t, work);
  out.scale = motion.solver().effortScale(work);
  out.condition = 1 / work.reciprocal_condition;
  out.inverse_inertia = inverseOf(motion.solver().inertia(work));
  return out;
}

/// Adds what Simbody, the other engines and direct dynamics say of a sample; `work` is at its instant.
void addEngines(const LoopFreedoms& freedoms, bool direct, LoopWork& work, const MechanismEvidence& evidence,
                MechanismSample& sample) {
  const Mechanism& mechanism = *evidence.scenario->mechanism;
  const LoopSolver& solver = evidence.motion->solver();
  sample.output = work.bodies[mechanism.output()].displacement * mechanism.bodies()[mechanism.output()].frame;
  for (const MechanismEngine& engine : evidence.engines) sample.engines.push_back(engine.efforts(sample.motion));
  SimbodyMechanism& simbody = evidence.placed();
  compareBodies(simbody, work, mechanism.length(), freedoms, sample);
  sample.acceleration = simbody.accelerations(sample.subject);
  sample.across = acrossOf(mechanism, work);
  sample.rank = rankOfShaping(work, mechanism.length());
  if (direct) sample.direct = solver.directDynamics(sample.motion, sample.noc, work.pose, work);
}

/// Asks the subject, or Simbody if the subject is the NOC, between the samples.
std::vector<MechanismSample> between(const MechanismSubject& subject, const Deadline& deadline,
                                     const MechanismEvidence& evidence) {
  std::vector<MechanismSample> out;
  const LoopMotion& motion = *evidence.motion;
  std::vector<double> dense = goldenInstants(motion.trajectory().duration(), subject.between);
  std::sort(dense.begin(), dense.end());
  std::vector<MotorEfforts> answers;
  if (subject.answers) answers = answersOf(subject, true, motion, dense, deadline);
  SimbodyMechanism simbody(*evidence.scenario->mechanism);
  LoopWork work;
  for (std::size_t i = 0; i < dense.size(); ++i) {
    deadline.require();
    MechanismSample sample = nocAt(motion, dense[i], work);
    if (!subject.answers) simbody.place(sample.motion);
    sample.subject = subject.answers ? answers[i] : MotorEfforts(simbody.inverseDynamics());
    out.push_back(std::move(sample));
  }
  return out;
}

/// What the rounding of a simulator's accelerations makes of efforts.
MotorEfforts roundedAccelerations(const MechanismEvidence& evidence, const MechanismSample& sample) {
  const MotorEfforts accelerations = (2 * evidence.level + evidence.acceleration_level) * evidence.response(sample);
  return inverseOf(sample.inverse_inertia).cwiseAbs() * accelerations;
}

/// What is judged at these instants; sets the largest effort of the evidence.
std::vector<MechanismSample> samplesAt(const std::vector<double>& instants, const MechanismSubject& subject,
                                       const Deadline& deadline, const std::function<void(double)>& progress,
                                       MechanismEvidence& evidence) {
  const LoopMotion& motion = *evidence.motion;
  std::vector<MotorEfforts> answers;
  if (subject.answers) answers = answersOf(subject, false, motion, instants, deadline);
  const LoopFreedoms freedoms = motion.solver().freedoms(motion.solver().assembled());
  LoopWork work;
  std::vector<MechanismSample> out;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    deadline.require();
    if (progress) progress(static_cast<double>(i) / static_cast<double>(instants.size()));
    MechanismSample sample = nocAt(motion, instants[i], work);
    sample.subject = subject.given ? subject.given->efforts[i] : subject.answers ? answers[i] : sample.noc;
    sample.given = subject.given ? subject.given->precision[i] : MotorEfforts::Zero(sample.noc.size());
    if (subject.given && !subject.given->time_precision.empty())
      sample.given += changeWithin(motion, instants[i], subject.given->time_precision[i], sample.noc);
    addEngines(freedoms, subject.isNoc(), work, evidence, sample);
    evidence.largest = std::max(evidence.largest, sample.noc.cwiseProduct(evidence.efforts_in).cwiseAbs().maxCoeff());
    out.push_back(std::move(sample));
  }
  return out;
}

void setCover(const MechanismSubject& subject, const std::vector<double>& instants, MechanismEvidence& out) {
  // Windows of another program's motion lie within it.
  if (subject.given && subject.given->derived_from.empty()) {
    out.cover = coverOf(instants, *out.motion, out.efforts_in);
    out.largest = std::max(out.largest, out.cover.largest);
    return;
  }
  for (std::size_t i = 1; i < instants.size(); ++i)
    out.cover.widest_gap = std::max(out.cover.widest_gap, instants[i] - instants[i - 1]);
}

}  // namespace

MotorEfforts effortsInOneUnit(const Mechanism& mechanism) {
  const auto n = static_cast<Eigen::Index>(mechanism.motorCount());
  MotorEfforts out = MotorEfforts::Ones(n);
  for (Eigen::Index k = 0; k < n; ++k)
    if (mechanism.motor(k).slides()) out(k) = mechanism.length();
  return (out.array() == mechanism.length()).all() ? MotorEfforts(MotorEfforts::Ones(n)) : out;
}

MechanismEvidence gatherMechanism(const MechanismScenario& scenario, const LoopMotion& motion,
                                  const MechanismSubject& subject, const std::vector<MakeMechanismEngine>& makers,
                                  const Deadline& deadline, const std::function<void(double share)>& progress) {
  const Mechanism& mechanism = *scenario.mechanism;
  MechanismEvidence out;
  out.scenario = &scenario;
  out.motion = &motion;
  setUnits(mechanism, out);
  // Independent roundings grow as 4 root n: Higham and Mary 2019, as in Conditioning; n counts the steps of two trees.
  out.level = 4 * std::sqrt(12.0 * static_cast<double>(mechanism.bodies().size() + mechanism.joints().size()));
  for (const MakeMechanismEngine& make : makers)
    if (auto engine = make(scenario)) out.engines.push_back(std::move(*engine));
  const std::vector<double> instants = judgedInstants(scenario, subject);
  try {
    out.samples = samplesAt(instants, subject, deadline, progress, out);
    setCover(subject, instants, out);
    if (!subject.given && subject.between > 0) out.between = between(subject, deadline, out);
  } catch (const OutOfTime& over) {
    out.out_of_time = over.what();
  }
  if (subject.no_cause) out.no_cause = subject.no_cause();
  SinglePrecision single;
  for (const MechanismSample& sample : out.samples)
    for (const double effort : sample.subject) single.add(effort);
  out.all_single = single.all() || (subject.given && subject.given->all_single);
  if (out.samples.empty()) {
    out.largest = 0;  // of a part of the motion
    return out;
  }
  measureLevels(out);
  out.gives_accelerations = subject.gives_accelerations;
  if (!subject.gives_accelerations) out.ask = subject.answers;
  if (subject.gives_accelerations)
    for (std::vector<MechanismSample>* samples : {&out.samples, &out.between})
      for (MechanismSample& sample : *samples) sample.given = roundedAccelerations(out, sample);
  if (!out.out_of_time.empty()) return out;
  try {
    out.powers = powersOf(out, deadline);
  } catch (const OutOfTime& over) {
    out.out_of_time = over.what();
  }
  if (subject.isNoc()) out.invariances = askInvariances(scenario, motion);
  return out;
}

}  // namespace ursula
