#include "validation/outside/external_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <vector>

#include "model/quaternions.h"
#include "validation/outside/line_process.h"

namespace ursula {
namespace {

/// For a process to end by itself once its input is closed, s.
constexpr double grace = 1;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == text.npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// For people: one line, not endless.
std::string shown(const std::string& text) {
  constexpr std::size_t most = 600;
  std::string out = text.substr(0, most);
  for (char& each : out)
    if (static_cast<unsigned char>(each) < ' ' || each == '\x7f') each = '?';
  return text.size() > most ? out + " …" : out;
}

double numberOf(std::string_view cell, int index) {
  std::string_view digits = trimmed(cell);
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
    throw SolverProcessError(
        fmt::format("its effort {} is '{}', expected a finite number", index, shown(std::string(trimmed(cell)))));
  return value;
}

/// A process that answers by the protocol.
class Process {
 public:
  Process(const Scenario& scenario, const ExternalSolverOptions& options)
      : options_(options),
        process_(options.command, {{"URSULA_SCENARIO", std::filesystem::absolute(scenario.file).string()}}) {}

  Vector6d torques(const Motion<double>& motion) {
    const std::string question = solverQuestion(motion);
    if (const std::string unasked = process_.unasked(); !unasked.empty())
      refuse("wrote more than one line for each that it was asked", question, unasked);
    const LineProcess::Answer answer = process_.ask(question, options_.timeout);
    if (answer.end != LineProcess::End::line) refuse(why(answer.end), question, answer.text);
    try {
      return solverAnswer(answer.text);
    } catch (const SolverProcessError& error) {
      refuse("answered what is no answer: " + std::string(error.what()), question, answer.text);
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
    throw SolverProcessError(fmt::format("the solver '{}' {}\n  asked: {}\n  got:   {}", options_.command, what,
                                         question, answer.empty() ? "nothing" : shown(answer)));
  }

  ExternalSolverOptions options_;
  LineProcess process_;
};

}  // namespace

std::string solverQuestion(const Motion<double>& motion) {
  fmt::memory_buffer line;
  const auto add = [&line](const auto& values) {
    for (Eigen::Index k = 0; k < values.size(); ++k) fmt::format_to(std::back_inserter(line), ",{:.17g}", values(k));
  };
  fmt::format_to(std::back_inserter(line), "{:.17g}", motion.t);
  add(motion.p);
  add(quaternions({motion}).front());
  add(motion.p_dot);
  add(motion.omega);
  add(motion.p_ddot);
  add(motion.omega_dot);
  return fmt::to_string(line);
}

Vector6d solverAnswer(const std::string& line) {
  std::vector<std::string_view> cells;
  const std::string_view text = line;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    cells.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  if (cells.size() != motor_count)
    throw SolverProcessError(
        fmt::format("{} value{}, expected six with commas between", cells.size(), cells.size() == 1 ? "" : "s"));
  Vector6d out;
  for (int i = 0; i < motor_count; ++i) out(i) = numberOf(cells[static_cast<std::size_t>(i)], i + 1);
  return out;
}

ValidationResult validateExternalSolver(const Scenario& scenario, const ExternalSolverOptions& options,
                                        const ValidationOptions& validation) {
  const auto process = std::make_shared<Process>(scenario, options);
  OutsideSolver solver;
  solver.name = options.command;
  solver.torques = [process](const std::vector<Motion<double>>& motions) {
    std::vector<Vector6d> out;
    out.reserve(motions.size());
    for (const Motion<double>& motion : motions) out.push_back(process->torques(motion));
    return out;
  };
  ValidationResult result = validateOutside(scenario, solver, validation);
  process->finish();
  return result;
}

}  // namespace ursula
