#include <pybind11/stl.h>
#include <ursula/validate.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "python/bindings.h"
#include "python/judging.h"
#include "python/made.h"
#include "python/motion.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

std::string atInstant(double t) { return " at t = " + shown(t) + " s"; }

MechanismOptions optionsOf(const ValidationOptions& options) {
  MechanismOptions out;
  out.time_limit = options.time_limit;
  out.asked_to_end = options.asked_to_end;
  out.thorough = options.thorough;
  out.quick = options.quick;
  out.progress = options.progress;
  return out;
}

MechanismMotion motionOf(const std::vector<MechanismQuestion>& questions) {
  std::vector<std::string> names;
  for (const LoopSolver::JointValue& each : questions.front().joints) names.push_back(each.name);
  MechanismMotion out = MechanismMotion::of(static_cast<Eigen::Index>(questions.size()),
                                            questions.front().motion.q.size(), std::move(names));
  for (std::size_t k = 0; k < questions.size(); ++k)
    out.set(static_cast<Eigen::Index>(k), questions[k].motion, questions[k].joints);
  return out;
}

/// Asks a user's function. It is held by reference, because copies are made without the lock.
auto answersOf(const py::object& solver, py::ssize_t motors) {
  return [&solver, motors](const std::vector<MechanismQuestion>& questions) {
    std::vector<MotorEfforts> out;
    if (questions.empty()) return out;
    const Locked locked;
    const py::object given = py::cast(motionOf(questions));
    PyObject* answer = called(solver.ptr(), given.ptr());
    if (answer == nullptr) throw py::error_already_set();
    const py::array_t<double> rows = answerOf(py::reinterpret_steal<py::object>(answer), questions.size(), motors,
                                              [&questions](std::size_t k) { return questions[k].motion.t; });
    for (std::size_t k = 0; k < questions.size(); ++k)
      out.emplace_back(Eigen::Map<const Eigen::VectorXd>(rows.data() + motors * k, motors));
    return out;
  };
}

/// Lets a slow function be asked in pieces, which are then the progress.
void askInPieces(MechanismOptions& options, MechanismSubject& subject) {
  Pieces::Told told;
  if (options.progress)
    told = [tell = std::exchange(options.progress, nullptr), thorough = options.thorough](long asked) {
      tell(shareOfQuestions(asked, thorough), "asking the solver");
    };
  const auto pieces = std::make_shared<Pieces>(Deadline(options.time_limit), told);
  subject.answers = [pieces, answers = subject.answers](const std::vector<MechanismQuestion>& questions) {
    return pieces->answers(questions, answers);
  };
}

/// Asks a user's direct dynamics.
MechanismSimulator simulatorOf(const Asked& asked, py::ssize_t motors) {
  refuseUnlessFunction(asked.accelerations, "a MechanismMotion and efforts", "accelerations");
  MechanismSimulator out;
  out.about = {asked.name, Formulation::external, CalledBy::program};
  out.accelerations = [&asked, motors](const std::vector<MechanismQuestion>& states,
                                       const std::vector<MotorEfforts>& efforts) {
    const Locked locked;
    const std::size_t width = motors;
    py::array_t<double> given({static_cast<py::ssize_t>(states.size()), motors});
    for (std::size_t k = 0; k < efforts.size(); ++k)
      Eigen::Map<Eigen::VectorXd>(given.mutable_data() + width * k, motors) = efforts[k];
    const py::array_t<double> rows = answerOf(
        asked.accelerations(py::cast(motionOf(states)), given), states.size(), motors,
        [&states](std::size_t k) { return states[k].motion.t; }, "simulator", "acceleration");
    std::vector<Eigen::VectorXd> found;
    for (std::size_t k = 0; k < states.size(); ++k)
      found.emplace_back(Eigen::Map<const Eigen::VectorXd>(rows.data() + width * k, motors));
    return found;
  };
  return out;
}

}  // namespace

py::array_t<double> answerOf(const py::object& answer, std::size_t instants, py::ssize_t width,
                             const std::function<double(std::size_t)>& instant, const char* whose, const char* what) {
  const py::array any = numbersIn(answer, "the " + std::string(whose) + "'s answer" + atInstant(instant(0)) +
                                              " is of type " + typeOf(answer) + ", expected an array of real numbers");
  if (any.ndim() != 2 || static_cast<std::size_t>(any.shape(0)) != instants || any.shape(1) != width)
    throw py::value_error("the " + std::string(whose) + "'s answer to " + std::to_string(instants) +
                          " instants has shape " + std::string(py::str(any.attr("shape"))) + ", expected (" +
                          std::to_string(instants) + ", " + std::to_string(width) + ")");
  py::array_t<double, py::array::c_style | py::array::forcecast> given(any);  // comes last, because it may copy
  for (std::size_t k = 0; k < instants; ++k)
    for (py::ssize_t i = 0; i < width; ++i)
      if (const double each = given.data()[width * k + i]; !std::isfinite(each))
        throw py::value_error("the " + std::string(whose) + "'s " + what + " " + std::to_string(i + 1) +
                              atInstant(instant(k)) + " is " + shown(each) + ", expected a finite number");
  return given;
}

void refuseUnlessFunction(const py::object& solver, const char* argument, const char* name) {
  if (PyCallable_Check(solver.ptr()) != 0) return;
  const bool is_text = py::isinstance<py::str>(solver);
  throw py::type_error("validate: " + std::string(name) + " is " +
                       (is_text ? std::string(py::repr(solver)) + " " : std::string()) + "of type " + typeOf(solver) +
                       ", expected a function of " + argument +
                       (is_text ? "; a command is for `ursula validate` in a terminal" : ""));
}

EffortRows effortRows(const py::object& torques, const py::object& t, py::ssize_t width) {
  if (torques.is_none() || t.is_none())
    throw py::type_error(torques.is_none() ? "t is given without torques, expected both"
                                           : "torques are given without t, expected both: their instants, s");
  EffortRows out{columnOf(t, "t"), rowsOf(torques, width, "torques")};
  out.count = out.t.shape(0);
  if (out.rows.shape(0) != out.t.shape(0))
    throw py::value_error("torques: " + std::to_string(out.rows.shape(0)) + " rows, expected one for each of the " +
                          std::to_string(out.count) + " instants t");
  if (out.count == 0) throw py::value_error("torques: no rows, expected at least one");
  return out;
}

GivenEfforts motorEffortsAt(const MechanismWithSolver& given, const py::object& torques, const py::object& t,
                            const std::string& name) {
  const auto [instants, rows, count] = effortRows(torques, t, given.motors());
  const std::vector<double> at(instants.data(), instants.data() + count);
  std::vector<MotorEfforts> efforts;
  for (std::size_t k = 0; k < count; ++k)
    efforts.emplace_back(Eigen::Map<const Eigen::VectorXd>(rows.data() + given.motors() * k, given.motors()));
  try {
    return givenEfforts(name, at, efforts, *given.scenario.mechanism, given.scenario.trajectory->duration());
  } catch (const CsvError& error) {
    throw py::value_error(byIndex(error.what(), "t"));
  }
}

ValidationResult validated(const MechanismWithSolver& given, const Asked& asked) {
  MechanismScenario scenario = given.scenario;
  setTolerance(asked.tolerance, scenario.tolerance);
  MechanismSubject subject;
  if (!asked.torques.is_none() || !asked.t.is_none()) {
    subject.given = std::make_shared<const GivenEfforts>(motorEffortsAt(given, asked.torques, asked.t, asked.name));
    subject.about = {asked.name, Formulation::external, CalledBy::torques};
  } else if (!asked.solver.is_none()) {
    refuseUnlessFunction(asked.solver, "a MechanismMotion");
    subject.answers = answersOf(asked.solver, given.motors());
    subject.about = {asked.name, Formulation::external, CalledBy::program};
  }
  if (!asked.accelerations.is_none()) {
    const MechanismSimulator simulator = simulatorOf(asked, given.motors());
    return interruptible(asked, [&](const ValidationOptions& options) {
      return validateSimulator(scenario, simulator, optionsOf(options));
    });
  }
  return interruptible(asked, [&](const ValidationOptions& options) {
    MechanismOptions of = optionsOf(options);
    if (subject.answers) askInPieces(of, subject);
    return validateMechanism(scenario, subject, of);
  });
}

}  // namespace ursula::python
