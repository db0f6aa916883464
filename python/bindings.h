#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "python/lock.h"
#include "python/scenario.h"

namespace ursula::python {

/// Returns the message with options of the command line as arguments: "any_tolerance" for "--any-tolerance".
std::string inPython(const std::string& message);

/// Returns the message about a table of arrays by index: "t[1] = 2" for "torques:3: error: t_s = 2", whose header
/// counts as a line.
std::string byIndex(const std::string& message, const std::string& instants);

/// The number as Python prints it.
inline std::string shown(double number) { return pybind11::repr(pybind11::float_(number)); }

/// The name of the value's type.
inline std::string typeOf(const pybind11::handle& value) {
  return pybind11::str(pybind11::type::of(value).attr("__name__"));
}

/// The verdict's name, as a property.
template <class T>
const char* verdictOf(const T& self) {
  return ursula::name(self.verdict);
}

/// Warns (UserWarning) of each line, at the caller of the wrapper in _errors.py. Throws the warning's exception.
void warnOf(const std::vector<std::string>& lines);

/// The rows of a motion of `count` instants that an index or a slice picks.
std::vector<std::size_t> pickedRows(std::size_t count, pybind11::ssize_t row);
std::vector<std::size_t> pickedRows(std::size_t count, const pybind11::slice& which);

/// pickle's two functions for a scenario, which is its text and file.
template <class T, class Parse>
auto pickledText(const Parse& parse) {
  return pybind11::pickle(
      [](const T& self) {
        return pybind11::make_tuple(self.scenario.text, std::filesystem::absolute(self.scenario.file).string());
      },
      [parse](const pybind11::tuple& state) {
        const auto text = state[0].cast<std::string>(), file = state[1].cast<std::string>();
        const Unlocked unlocked;
        return std::make_shared<T>(parse(text, file));
      });
}

inline pybind11::object fromJson(const std::string& text) {
  return pybind11::module_::import("json").attr("loads")(text);
}

void addComparison(pybind11::module_& module);

using ScenarioClass = pybind11::class_<ScenarioWithSolver, std::shared_ptr<ScenarioWithSolver>>;

void addDerivatives(ScenarioClass& scenario);

/// Adds scenarios from dicts and text, and the reverse.
void addDocuments(pybind11::module_& module, ScenarioClass& scenario);

/// Adds identify() and excite().
void addIdentification(pybind11::module_& module);

/// Adds the functions beside validation: simulate, check, map, compare.
void addStudies(pybind11::module_& module);

void addValidation(pybind11::module_& module);

}  // namespace ursula::python
