#include "validation/subject/subject.h"

#include <Eigen/Geometry>

#include "nocsolver/solver.h"

namespace ursula {
namespace {

/// Subjects are asked from many threads.
template <class Workspace>
Workspace& workspace() {
  thread_local Workspace work;
  return work;
}

/// A solver of the class `Of` with a workspace of the class `Work`.
template <class Of, class Work, class... Reading>
Subject makeSubject(const std::string& name, const Manipulator& manipulator, const std::shared_ptr<const Load>& load,
                    const Reading&... reading) {
  const auto solver = std::make_shared<const Of>(manipulator, reading...);
  Subject subject;
  subject.name = name;
  subject.torques = [solver, load](const Motion<double>& motion) {
    return solver->inverseDynamics(motion, workspace<Work>(), loadAtP(load.get(), motion));
  };
  subject.kinematics = [solver](const Motion<double>& motion) {
    Work& work = workspace<Work>();
    KinematicAnswer answer;
    solver->inverseKinematics(motion, work);
    answer.joints = {solver->angles(work), solver->rates(work), solver->accelerations(work)};
    solver->bodyMotions(motion, work, answer.bodies);
    solver->jacobians(motion, work);
    answer.T = solver->T(work);
    answer.T_rate = solver->TRate(motion, work);
    return answer;
  };
  subject.accelerations = [solver, load](const Motion<double>& motion, const Vector6d& torques) {
    return solver->directDynamics(motion, torques, workspace<Work>(), loadAtP(load.get(), motion));
  };
  subject.rebuilt = [name, reading...](const Manipulator& other) {
    return makeSubject<Of, Work>(name, other, nullptr, reading...);
  };
  return subject;
}

}  // namespace

Vector6d loadAtP(const Load* load, const Motion<double>& motion) {
  if (load == nullptr) return Vector6d::Zero();
  const Wrench<double> wrench = load->at(motion.t);
  const Matrix3d to_base = load->frame == Load::Frame::platform ? motion.Q : Matrix3d(Matrix3d::Identity());
  const Vector3d force = to_base * wrench.force;
  Vector6d out;
  out << to_base * wrench.moment + (motion.Q * load->point).cross(force), force;
  return out;
}

void foresee(const Subject& subject, const Trajectory& trajectory, const std::vector<double>& instants) {
  if (!subject.foresee) return;
  std::vector<Motion<double>> motions;
  motions.reserve(instants.size());
  for (double t : instants) motions.push_back(trajectory.at(t));
  subject.foresee(motions);
}

Subject nocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load) {
  return makeSubject<Solver<double>, Workspace<double>>("noc", manipulator, load);
}

Subject slippedSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load,
                       const WithSlips& slips) {
  return makeSubject<PaperSolver<double, WithSlips>, PaperWorkspace<double>>("noc with slips", manipulator, load,
                                                                             slips);
}

Subject spoiltSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load,
                      const SpoiltChain& reading) {
  return makeSubject<ChainSolver<double, SpoiltChain>, ChainWorkspace<double>>("noc, spoilt", manipulator, load,
                                                                               reading);
}

}  // namespace ursula
