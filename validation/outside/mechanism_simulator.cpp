#include <algorithm>

#include "base/dense.h"
#include "nocsolver/loops/loop_solver.h"
#include "validation/outside/needed_efforts.h"
#include "validation/outside/outside_simulator.h"
#include "validation/outside/pieces.h"

namespace ursula {
namespace {

/// Finds what a mechanism's simulator has for efforts, in states along the motion.
class MechanismInSimulator {
 public:
  MechanismInSimulator(const MechanismScenario& scenario, const MechanismSimulator& simulator)
      : along_(scenario), simulator_(simulator), unmoved_(namesOf(*scenario.mechanism)) {}

  /// With `changed`, other accelerations are wanted, by efforts as large as the motion's: a slow motion alone would not
  /// show the inertia. The answer is then what it needs beyond these.
  std::vector<MotorEfforts> efforts(const std::vector<MechanismQuestion>& questions, bool changed) {
    std::vector<MechanismQuestion> states = questions;
    std::vector<WantedState> wanted;
    std::vector<MotorEfforts> more;
    for (std::size_t k = 0; k < questions.size(); ++k) {
      MechanismQuestion& state = states[k];
      wanted.push_back(right(state.motion));
      more.push_back(changed ? changeOf(wanted.back().efforts, k) : MotorEfforts::Zero(state.motion.q.size()));
      wanted.back().wanted += inverseOf(wanted.back().inertia) * more.back();
      wanted.back().efforts += more.back();
      state.motion.qddot.setZero();
      for (LoopSolver::JointValue& joint : state.joints) joint.acceleration = 0;
    }
    const AccelerationsIn simulator = [&](const std::vector<std::size_t>& which,
                                          const std::vector<Eigen::VectorXd>& efforts) {
      std::vector<MechanismQuestion> asked;
      for (const std::size_t k : which) asked.push_back(states[k]);
      asked_ += static_cast<long>(which.size());
      return simulator_.accelerations(asked, efforts);
    };
    std::vector<MotorEfforts> out = neededEfforts(wanted, simulator, most_questions - asked_, unmoved_);
    for (std::size_t k = 0; k < out.size(); ++k) out[k] -= more[k];
    return out;
  }

  std::string unmoved() const { return unmoved_.words(); }

 private:
  static std::vector<std::string> namesOf(const Mechanism& mechanism) {
    std::vector<std::string> out;
    for (std::size_t k = 0; k < mechanism.motorCount(); ++k) out.push_back(mechanism.motor(k).name);
    return out;
  }

  WantedState right(const MotorMotion& motion) {
    WantedState out;
    out.efforts = along_.motion().inverseDynamics(motion.t, work_);
    largest_ = std::max(largest_, out.efforts.cwiseAbs().maxCoeff());
    out.inertia = along_.solver().inertia(work_);
    out.wanted = motion.qddot;
    out.scale = Eigen::VectorXd::Ones(motion.qddot.size());
    const double terms = along_.solver().effortScale(work_).cwiseAbs().maxCoeff();
    out.rounding = 1e-13 * inverseOf(out.inertia).cwiseAbs().maxCoeff() * std::max(terms, largest_);
    return out;
  }

  /// Signs that differ by motor and state.
  MotorEfforts changeOf(const MotorEfforts& efforts, std::size_t k) const {
    MotorEfforts out = MotorEfforts::Constant(efforts.size(), largest_);
    for (Eigen::Index i = 0; i < out.size(); ++i)
      if (((k >> (static_cast<std::size_t>(i) % 6)) & 1U) != 0) out(i) = -out(i);
    return out;
  }

  MechanismAlong along_;
  const MechanismSimulator& simulator_;
  Unmoved unmoved_;
  LoopWork work_;
  double largest_ = 0;
  long asked_ = 0;
};

}  // namespace

ValidationResult validateSimulator(const MechanismScenario& scenario, const MechanismSimulator& simulator,
                                   const MechanismOptions& options) {
  MechanismInSimulator inside(scenario, simulator);
  MechanismSubject subject;
  subject.about = simulator.about;
  subject.gives_accelerations = true;
  subject.between = 300;
  subject.answers = [&inside](const auto& questions) { return inside.efforts(questions, false); };
  subject.answers_between = [&inside](const auto& questions) { return inside.efforts(questions, true); };
  subject.no_cause = [&inside] { return inside.unmoved(); };
  return validateMechanism(scenario, subject, options);
}

}  // namespace ursula
