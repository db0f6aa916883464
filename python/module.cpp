#include <pybind11/pybind11.h>
#include <ursula/build.h>
#include <ursula/mechanism.h>
#include <ursula/scenario.h>
#include <ursula/solver.h>

#include <algorithm>
#include <exception>
#include <regex>
#include <string>

#include "python/bindings.h"
#include "python/motion.h"
#include "python/scenario.h"
#include "python/words.h"

namespace {

namespace py = pybind11;

/// Raises Python's PoseError with the numbers of ours.
void raisePoseError(const ursula::PoseError& error) {
  const py::object type = py::module_::import("ursula._ursula").attr("PoseError");
  py::object out = type(error.what());
  out.attr("leg") = error.leg() < 0 ? py::object(py::none()) : py::int_(error.leg() + 1);
  out.attr("instant") = error.instant();
  out.attr("measure") = error.measure();
  out.attr("bound") = error.bound();
  PyErr_SetObject(type.ptr(), out.ptr());
}

/// The loops of a mechanism have no numbers to tell.
void raisePoseError(const ursula::LoopError& error) {
  const py::object type = py::module_::import("ursula._ursula").attr("PoseError");
  py::object out = type(error.what());
  for (const char* name : {"leg", "instant", "measure", "bound"}) out.attr(name) = py::none();
  PyErr_SetObject(type.ptr(), out.ptr());
}

void raiseScenarioError(const std::string& what) {
  PyErr_SetString(py::module_::import("ursula._ursula").attr("ScenarioError").ptr(),
                  ursula::python::inPython(what).c_str());
}

void addErrors(py::module_& module) {
  py::register_exception<ursula::ScenarioError>(module, "ScenarioError", PyExc_ValueError).doc() =
      "A scenario that cannot be read. The message gives file, line, column, the error and what was expected.";
  py::register_exception<ursula::UndeterminedPose>(module, "UndeterminedPose", PyExc_ValueError).doc() =
      "Actuated coordinates that do not determine the platform's pose.";
  py::register_exception<ursula::PoseError>(module, "PoseError", PyExc_ValueError).doc() =
      "A pose that the legs or loops cannot reach, or that is singular. leg: 1 to 6, or None. instant: s. measure: "
      "the\n"
      "number that decides. bound: its limit. All four are None for a mechanism.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    if (!thrown) return;
    try {
      std::rethrow_exception(thrown);
    } catch (const ursula::PoseError& error) {
      raisePoseError(error);
    } catch (const ursula::LoopError& error) {
      raisePoseError(error);
    } catch (const ursula::ScenarioError& error) {
      raiseScenarioError(ursula::atLength(error));
    } catch (const ursula::CsvError& error) {  // of a table that a scenario names
      raiseScenarioError(error.what());
    }
  });
}

template <class Words>
std::string eachReplaced(const std::string& text, const std::regex& what, Words&& words) {
  std::string out;
  auto at = text.begin();
  for (std::sregex_iterator each(text.begin(), text.end(), what), none; each != none; ++each) {
    out.append(at, text.begin() + each->position());
    out += words(*each);
    at = text.begin() + each->position() + each->length();
  }
  return out.append(at, text.end());
}

}  // namespace

std::string ursula::python::inPython(const std::string& message) {
  static const std::regex option("--[a-z]+(-[a-z]+)*");
  return eachReplaced(message, option, [](const std::smatch& found) {
    std::string name = found.str().substr(2);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });
}

std::string ursula::python::byIndex(const std::string& message, const std::string& instants) {
  static const std::regex line("(?:^.*?:(\\d+): error: t_s)|(?:(?:of )?line (\\d+))");
  return eachReplaced(inPython(message), line, [&instants](const std::smatch& found) {
    const std::string number = found[1].matched ? found[1] : found[2];
    return (found.str().rfind("of ", 0) == 0 ? "of " : "") + instants + "[" + std::to_string(std::stoi(number) - 2) +
           "]";
  });
}

PYBIND11_MODULE(_ursula, module) {
  module.doc() = ursula::python::words::module;
  module.attr("__module__") = "ursula";  // of the classes, in errors and signatures
  module.attr("__version__") = URSULA_VERSION;
  addErrors(module);
  ursula::python::stopWorkAtEnd();
  ursula::python::addMotion(module);
  ursula::python::addScenario(module);
  ursula::python::addValidation(module);
  ursula::python::addStudies(module);
}
