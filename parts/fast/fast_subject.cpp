#include "parts/fast/fast_subject.h"

#include "parts/fast/fast_dynamics.h"

namespace ursula {

Subject fastSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load) {
  const auto solver = std::make_shared<const FastDynamics<double>>(manipulator);
  Subject subject;
  subject.name = "fast kernels";
  subject.formulation = Formulation::fast;
  subject.torques = [solver, load](const Motion<double>& motion) {
    return solver->inverseDynamics(motion, loadAtP(load.get(), motion));
  };
  subject.accelerations = [solver, load](const Motion<double>& motion, const Vector6d& torques) {
    return solver->directDynamics(motion, torques, loadAtP(load.get(), motion));
  };
  subject.rebuilt = [](const Manipulator& other) { return fastSubject(other, nullptr); };
  return subject;
}

}  // namespace ursula
