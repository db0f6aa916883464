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
  Process(const Scenario& scenario, const ExternalSolverOptions& options)
      : options_(options),
        process_(options.command, {{"URSULA_SCENARIO", std::filesystem::absolute(scenario.file).string()}}) {}

  Vector6d torques(const Motion<double>& motion) {
    const std::string question = solverQuestion(motion);
    if (const std::string unasked = process_.unasked(); !unasked.empty())
      refuse("wrote something that it was not asked for, expected one line for each question", question, unasked);
    const LineProcess::Answer answer = process_.ask(question, options_.timeout);
    if (answer.end != LineProcess::End::line) refuse(why(answer.end), question, answer.text);
    try {
      return solverAnswer(answer.text);
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

}  // namespace

ValidationResult validateExternalSolver(const Scenario& scenario, const ExternalSolverOptions& options,
                                        const ValidationOptions& validation) {
  const auto process = std::make_shared<Process>(scenario, options);
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
      out.push_back(process->torques(motion));
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

}  // namespace ursula
