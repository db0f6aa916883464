#include "validation/outside/external_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/deadline.h"
#include "base/text.h"
#include "validation/outside/line_process.h"

namespace ursula {
namespace {

/// Time for a process to end by itself after its input is closed, s.
constexpr double grace = 1;
/// About so many instants does a validation ask for.
constexpr double usual_questions = 20000;

/// A process that speaks the protocol.
class Process {
 public:
  Process(const ExternalSolverOptions& options, const LineProcess::Environment& environment)
      : options_(options), process_(options.command, environment) {}

  Eigen::VectorXd torques(const std::string& question, int motors) {
    if (const std::string unasked = process_.unasked(); !unasked.empty())
      refuse("wrote something that it was not asked for, expected one line for each question", question, unasked);
    const LineProcess::Answer answer = process_.ask(question, options_.timeout);
    if (answer.end != LineProcess::End::line) refuse(why(answer.end), question, answer.text);
    try {
      return solverAnswer(answer.text, motors);
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
    throw SolverProcessError(fmt::format("the solver '{}' {}\n  question: {}\n  answer:   {}", options_.command, what,
                                         question, answer.empty() ? "none" : shown(answer, most_shown)));
  }

  ExternalSolverOptions options_;
  LineProcess process_;
};

LineProcess::Environment environmentOf(const std::filesystem::path& scenario) {
  return {{"URSULA_SCENARIO", std::filesystem::absolute(scenario).string()}};
}

}  // namespace

ValidationResult validateExternalSolver(const Scenario& scenario, const ExternalSolverOptions& options,
                                        const ValidationOptions& validation) {
  const auto process = std::make_shared<Process>(options, environmentOf(scenario.file));
  const Deadline deadline(validation.time_limit);
  OutsideSolver solver;
  solver.name = options.command;
  solver.called_by = CalledBy::solver;
  const auto asked = std::make_shared<int>(0);
  solver.torques = [process, deadline, asked, tell = validation.progress](const std::vector<Motion<double>>& motions) {
    std::vector<Vector6d> out;
    out.reserve(motions.size());
    for (const Motion<double>& motion : motions) {
      deadline.require();  // an answer may take long
      out.push_back(process->torques(solverQuestion(motion), motor_count));
      if (tell) tell(std::min(++*asked / usual_questions, 0.99), "asking the solver");
    }
    return out;
  };
  ValidationOptions silent = validation;
  silent.progress = nullptr;  // the answers take nearly all of the time
  ValidationResult result = validateOutside(scenario, solver, silent);
  process->finish();
  return result;
}

namespace {

/// The motors' q, rates and accelerations, then the same of all other joints.
std::string questionOf(const MechanismQuestion& question) {
  std::string out = fmt::format("{:.17g}", question.motion.t);
  const auto add = [&out](double value) { out += fmt::format(",{:.17g}", value); };
  for (const Eigen::VectorXd* each : {&question.motion.q, &question.motion.qdot, &question.motion.qddot})
    for (Eigen::Index k = 0; k < each->size(); ++k) add((*each)(k));
  for (const auto& joint : question.joints) add(joint.value);
  for (const auto& joint : question.joints) add(joint.rate);
  for (const auto& joint : question.joints) add(joint.acceleration);
  return out;
}

/// Names the numbers of a question.
std::string columnsOf(const MechanismScenario& scenario) {
  const MechanismAlong along(scenario);
  LoopWork work;
  static_cast<void>(along.motion().inverseDynamics(0, work));
  std::string out = "t_s";
  for (const char* quantity : {"q", "qdot", "qddot"})
    for (std::size_t k = 0; k < scenario.mechanism->motorCount(); ++k)
      out += "," + motorColumn(*scenario.mechanism, k, quantity);
  const std::vector<LoopSolver::JointValue> joints = along.solver().joints(work);
  for (const char* prefix : {"", "d_", "dd_"})
    for (const LoopSolver::JointValue& joint : joints) out += "," + (prefix + joint.name);
  return out;
}

}  // namespace

ValidationResult validateExternalSolver(const MechanismScenario& scenario, const ExternalSolverOptions& options,
                                        const MechanismOptions& validation) {
  LineProcess::Environment environment = environmentOf(scenario.file);
  environment.emplace_back("URSULA_COLUMNS", columnsOf(scenario));
  environment.emplace_back("URSULA_MODEL", std::filesystem::absolute(scenario.model).string());
  const auto process = std::make_shared<Process>(options, environment);
  const Deadline deadline(validation.time_limit);
  MechanismSubject subject;
  subject.about = {options.command, Formulation::external, CalledBy::solver};
  subject.answers = [&](const std::vector<MechanismQuestion>& questions) {
    std::vector<MotorEfforts> out;
    for (const MechanismQuestion& question : questions) {
      deadline.require();  // an answer may take long
      out.push_back(process->torques(questionOf(question), static_cast<int>(scenario.mechanism->motorCount())));
    }
    return out;
  };
  ValidationResult result = validateMechanism(scenario, subject, validation);
  process->finish();
  return result;
}

}  // namespace ursula
