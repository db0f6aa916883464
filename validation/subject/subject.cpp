#include "validation/subject/subject.h"

#include <utility>

#include "validation/subject/noc_subject_impl.h"

namespace ursula {

Vector6d loadAtP(const Load* load, const Motion<double>& motion) {
  if (load == nullptr) return Vector6d::Zero();
  const Wrench<double> wrench = load->at(motion.t);
  const Matrix3d to_base = load->frame == Load::Frame::platform ? motion.Q : Matrix3d(Matrix3d::Identity());
  const Vector3d force = to_base * wrench.force;
  Vector6d out;
  out << to_base * wrench.moment + (motion.Q * load->point).cross(force), force;
  return out;
}

Subject recorded(Subject subject) {
  const auto answers = std::make_shared<std::vector<Answered>>();
  subject.torques = [asked = std::move(subject.torques), answers](const Motion<double>& motion) {
    const Vector6d torques = asked(motion);
    answers->push_back({motion.t, torques});
    return torques;
  };
  subject.answers = [answers] { return *answers; };
  return subject;
}

void foresee(const Subject& subject, const Trajectory& trajectory, const std::vector<double>& instants) {
  if (!subject.foresee) return;
  std::vector<Motion<double>> motions;
  motions.reserve(instants.size());
  for (double t : instants) motions.push_back(trajectory.at(t));
  subject.foresee(motions);
}

namespace {

noc_subject::Solver<double> nocOf(const Manipulator& machine) { return std::make_shared<const Noc<double>>(machine); }

}  // namespace

Subject nocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load) {
  return noc_subject::makeSubject<double>("noc", manipulator, load, nocOf);
}

Subject nocSubject(const MachineParameters<double>& machine, const std::shared_ptr<const Load>& load) {
  return noc_subject::makeSubject<double>("noc", std::make_shared<const Noc<double>>(machine), load, nocOf);
}

}  // namespace ursula
