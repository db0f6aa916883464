#include "validation/outside/external_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "base/deadline.h"
#include "base/text.h"
#include "validation/outside/line_process.h"
#include "validation/outside/pieces.h"

namespace ursula {
namespace {

/// Time for a process to end by itself after its input is closed, s.
constexpr double grace = 1;

/// A process that speaks the protocol. It tells of a solver's questions; a simulator's are told elsewhere.
class Process {
 public:
  template <class Options>
  Process(const ExternalSolverOptions& options, const LineProcess::Environment& environment, const Options& validation,
          bool simulates)
      : options_(options),
        process_(options.command, environment),
        deadline_(validation.time_limit),
        thorough_(validation.thorough),
        role_(simulates ? "simulator" : "solver"),
        what_(simulates ? "acceleration" : "effort") {
    if (!simulates) tell_ = validation.progress;
  }

  Eigen::VectorXd answer(const std::string& question, int count) {
    deadline_.require();  // an answer may take long
    if (const std::string unasked = process_.unasked(); !unasked.empty())
      refuse("wrote something that it was not asked for, expected one line for each question", question, unasked);
    const LineProcess::Answer answer = process_.ask(question, options_.timeout);
    if (answer.end != LineProcess::End::line) refuse(why(answer.end), question, answer.text);
    try {
      const Eigen::VectorXd out = solverAnswer(answer.text, count, what_);
      if (tell_) tell_(shareOfQuestions(++asked_, thorough_), "asking the solver");
      return out;
    } catch (const SolverProcessError& error) {
      refuse("gave an invalid answer: " + std::string(error.what()), question, answer.text);
    }
  }

  void finish() { process_.finish(grace); }

 private:
  std::string why(LineProcess::End end) {
    if (end == LineProcess::End::closed) return process_.ending() + " before it had answered";
    if (end == LineProcess::End::late) return fmt::format("gave no answer within {:g} s", options_.timeout);
    return "answered without an end of line";
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& question, const std::string& answer) const {
    throw SolverProcessError(fmt::format("the {} '{}' {}\n  question: {}\n  answer:   {}", role_, options_.command,
                                         what, question, answer.empty() ? "none" : shown(answer, most_shown)));
  }

  ExternalSolverOptions options_;
  LineProcess process_;
  Deadline deadline_;
  std::function<void(double, const char*)> tell_;
  bool thorough_;
  long asked_ = 0;
  const char *role_, *what_;
};

LineProcess::Environment environmentOf(const std::filesystem::path& scenario) {
  return {{"URSULA_SCENARIO", std::filesystem::absolute(scenario).string()}};
}

/// The motors' q, rates and accelerations, then the same of all other joints; without accelerations if there are
/// efforts, which then end it.
std::string questionOf(const MechanismQuestion& question, const MotorEfforts* efforts = nullptr) {
  std::string out = fmt::format("{:.17g}", question.motion.t);
  const auto add = [&out](double value) { out += fmt::format(",{:.17g}", value); };
  const auto addAll = [&add](const Eigen::VectorXd& values) { std::for_each(values.begin(), values.end(), add); };
  addAll(question.motion.q);
  addAll(question.motion.qdot);
  if (efforts == nullptr) addAll(question.motion.qddot);
  for (const auto& joint : question.joints) add(joint.value);
  for (const auto& joint : question.joints) add(joint.rate);
  for (const auto& joint : question.joints)
    if (efforts == nullptr) add(joint.acceleration);
  if (efforts != nullptr) addAll(*efforts);
  return out;
}

/// Names the numbers of a question.
std::string columnsOf(const MechanismScenario& scenario, bool with_efforts) {
  const MechanismAlong along(scenario);
  LoopWork work;
  static_cast<void>(along.motion().inverseDynamics(0, work));
  std::string out = "t_s";
  const auto addMotors = [&](const char* quantity) {
    for (std::size_t k = 0; k < scenario.mechanism->motorCount(); ++k)
      out += "," + motorColumn(*scenario.mechanism, k, quantity);
  };
  addMotors("q");
  addMotors("qdot");
  if (!with_efforts) addMotors("qddot");
  const std::vector<LoopSolver::JointValue> joints = along.solver().joints(work);
  for (const char* prefix : {"", "d_", "dd_"})
    for (const LoopSolver::JointValue& joint : joints)
      if (!with_efforts || std::string(prefix) != "dd_") out += "," + (prefix + joint.name);
  if (with_efforts) addMotors("tau");
  return out;
}

LineProcess::Environment environmentOf(const MechanismScenario& scenario, bool with_efforts) {
  LineProcess::Environment out = environmentOf(scenario.file);
  out.emplace_back("URSULA_COLUMNS", columnsOf(scenario, with_efforts));
  out.emplace_back("URSULA_MODEL", std::filesystem::absolute(scenario.model).string());
  return out;
}

}  // namespace

ValidationResult validateExternalSolver(const Scenario& scenario, const ExternalSolverOptions& options,
                                        const ValidationOptions& validation) {
  const auto process = std::make_shared<Process>(options, environmentOf(scenario.file), validation, false);
  OutsideSolver solver;
  solver.name = options.command;
  solver.called_by = CalledBy::solver;
  solver.torques = [process](const std::vector<Motion<double>>& motions) {
    std::vector<Vector6d> out;
    out.reserve(motions.size());
    for (const Motion<double>& motion : motions) out.push_back(process->answer(solverQuestion(motion), motor_count));
    return out;
  };
  ValidationOptions silent = validation;
  silent.progress = nullptr;
  ValidationResult result = validateOutside(scenario, solver, silent);
  process->finish();
  return result;
}

ValidationResult validateExternalSolver(const MechanismScenario& scenario, const ExternalSolverOptions& options,
                                        const MechanismOptions& validation) {
  Process process(options, environmentOf(scenario, false), validation, false);
  MechanismSubject subject;
  subject.about = {options.command, Formulation::external, CalledBy::solver};
  subject.answers = [&](const std::vector<MechanismQuestion>& questions) {
    std::vector<MotorEfforts> out;
    for (const MechanismQuestion& question : questions)
      out.push_back(process.answer(questionOf(question), static_cast<int>(scenario.mechanism->motorCount())));
    return out;
  };
  MechanismOptions silent = validation;
  silent.progress = nullptr;
  ValidationResult result = validateMechanism(scenario, subject, silent);
  process.finish();
  return result;
}

ValidationResult validateExternalSimulator(const Scenario& scenario, const ExternalSolverOptions& options,
                                           const ValidationOptions& validation) {
  Process process(options, environmentOf(scenario.file), validation, true);
  OutsideSimulator simulator;
  simulator.name = options.command;
  simulator.called_by = CalledBy::simulator;
  simulator.accelerations = [&](const std::vector<Motion<double>>& states, const std::vector<Vector6d>& efforts) {
    std::vector<Vector6d> out;
    for (std::size_t k = 0; k < states.size(); ++k) {
      const Vector6d linear_first = process.answer(simulatorQuestion(states[k], efforts[k]), 6);
      out.emplace_back();
      out.back() << linear_first.tail<3>(), linear_first.head<3>();
    }
    return out;
  };
  ValidationResult result = validateSimulator(scenario, simulator, validation);
  process.finish();
  return result;
}

ValidationResult validateExternalSimulator(const MechanismScenario& scenario, const ExternalSolverOptions& options,
                                           const MechanismOptions& validation) {
  Process process(options, environmentOf(scenario, true), validation, true);
  MechanismSimulator simulator;
  simulator.about = {options.command, Formulation::external, CalledBy::simulator};
  simulator.accelerations = [&](const std::vector<MechanismQuestion>& states,
                                const std::vector<MotorEfforts>& efforts) {
    std::vector<Eigen::VectorXd> out;
    for (std::size_t k = 0; k < states.size(); ++k)
      out.push_back(process.answer(questionOf(states[k], &efforts[k]), static_cast<int>(efforts[k].size())));
    return out;
  };
  ValidationResult result = validateSimulator(scenario, simulator, validation);
  process.finish();
  return result;
}

}  // namespace ursula
