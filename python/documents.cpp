#include "python/bindings.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <ursula/scenario.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "python/mechanism.h"
#include "python/scenario.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

constexpr const char *from_dict = "<dict>", *from_text = "<text>";

[[noreturn]] void refuse(const std::string& place, const std::string& what) {
  throw ScenarioError(std::string(from_dict) + ": error: " + (place.empty() ? "" : place + ": ") + what);
}

/// Applies Python's recursion limit, because a dict may contain itself.
struct Depth {
  Depth() {
    if (Py_EnterRecursiveCall(" in a scenario's dict") != 0) throw py::error_already_set();
  }
  ~Depth() { Py_LeaveRecursiveCall(); }
  Depth(const Depth&) = delete;
  Depth& operator=(const Depth&) = delete;
};

/// Converts a dict's value for json: NumPy arrays and numbers to Python's, paths to text. Throws ScenarioError with the
/// key for other types.
py::object plain(const py::handle& value, const std::string& place) {
  const Depth depth;
  if (py::isinstance<py::str>(value) || py::isinstance<py::bool_>(value) || py::isinstance<py::int_>(value))
    return py::reinterpret_borrow<py::object>(value);
  if (py::isinstance<py::float_>(value)) {
    if (!std::isfinite(value.cast<double>())) refuse(place, std::string(py::str(value)) + ", expected a finite number");
    return py::float_(value.cast<double>());
  }
  if (py::isinstance<py::dict>(value)) {
    py::dict out;
    for (const auto& [key, each] : py::reinterpret_borrow<py::dict>(value)) {
      if (!py::isinstance<py::str>(key)) refuse(place, "the key " + std::string(py::repr(key)) + ", expected a string");
      out[key] = plain(each, place.empty() ? std::string(py::str(key)) : place + "." + std::string(py::str(key)));
    }
    return out;
  }
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    py::list out;
    for (const py::handle each : value) out.append(plain(each, place + "[" + std::to_string(out.size() + 1) + "]"));
    return out;
  }
  if (py::hasattr(value, "dtype")) return plain(value.attr("tolist")(), place);
  if (py::hasattr(value, "__fspath__")) return value.attr("__fspath__")();
  refuse(place, typeOf(value) + ", expected a number, text, a list or a dict");
}

using Either = std::variant<std::shared_ptr<ScenarioWithSolver>, std::shared_ptr<MechanismWithSolver>>;

/// Makes a Python object of what `make` returns; it is called without Python's lock.
template <class Make>
py::object ofEither(const Make& make) {
  const Either made = [&make] {
    const Unlocked unlocked;
    return make();
  }();
  return std::visit([](const auto& scenario) { return py::object(py::cast(scenario)); }, made);
}

py::object readAny(const std::filesystem::path& file) {
  return ofEither([&file]() -> Either {
    if (isMechanismFile(file)) return mechanismOf(file);
    return warnedOf(std::make_shared<ScenarioWithSolver>(readScenario(file)));
  });
}

py::object scenarioOf(const py::object& given, const std::optional<std::filesystem::path>& folder) {
  const bool is_text = py::isinstance<py::str>(given);
  if (!is_text && !py::isinstance<py::dict>(given))
    throw py::type_error("scenario: expected a dict or text in TOML, found " + typeOf(given) +
                         "; read_scenario reads files");
  const std::string text = py::str(is_text ? given : py::module_::import("json").attr("dumps")(plain(given, "")));
  const std::filesystem::path file = folder.value_or("") / (is_text ? from_text : from_dict);
  return ofEither([&]() -> Either {
    const std::string document = is_text ? text : tomlOfJson(text, file);
    if (isMechanism(document)) return mechanismOf(document, file);
    return warnedOf(std::make_shared<ScenarioWithSolver>(parseScenario(document, file)));
  });
}

std::shared_ptr<ScenarioWithSolver> importModel(const std::filesystem::path& file, const std::string& base,
                                                const std::string& platform, const std::vector<std::string>& actuated,
                                                const std::vector<std::string>& close, double tolerance, double lump,
                                                const std::vector<std::string>& leave_out, const std::string& key) {
  std::shared_ptr<ScenarioWithSolver> out;
  try {
    const Unlocked unlocked;
    exchange::Imported imported =
        exchange::importModel(file, {base, platform, key, actuated, close, leave_out, tolerance, lump});
    const std::filesystem::path named = std::filesystem::path(file).replace_extension(".toml");
    out = std::make_shared<ScenarioWithSolver>(parseScenario(imported.scenario, named));
    out->assumptions = std::move(imported.assumptions);
  } catch (const exchange::ImportError& error) {
    throw ScenarioError(error.what());
  }
  for (const exchange::Assumption& each : out->assumptions)
    if (each.warning) py::module_::import("warnings").attr("warn")(inWords(each), py::arg("stacklevel") = 2);
  return warnedOf(std::move(out));
}

py::list assumptionsOf(const ScenarioWithSolver& self) {
  py::list out;
  for (const exchange::Assumption& each : self.assumptions)
    out.append(py::dict(py::arg("what") = each.what, py::arg("where") = each.where, py::arg("size") = each.size,
                        py::arg("unit") = each.unit, py::arg("warning") = each.warning));
  return out;
}

}  // namespace

void addDocuments(py::module_& module, ScenarioClass& scenario) {
  scenario
      .def(
          "to_dict", [](const ScenarioWithSolver& self) { return fromJson(scenarioJson(self.scenario)); },
          words::to_dict)
      .def(
          "to_toml", [](const ScenarioWithSolver& self) { return self.scenario.text; }, words::to_toml)
      .def_property_readonly("assumptions", &assumptionsOf, words::assumptions);
  module.def("import_model", &importModel, py::arg("path"), py::kw_only(), py::arg("base") = "",
             py::arg("platform") = "", py::arg("actuated") = std::vector<std::string>(),
             py::arg("close") = std::vector<std::string>(), py::arg("tolerance") = 1e-5, py::arg("lump") = 1e-3,
             py::arg("leave_out") = std::vector<std::string>(), py::arg("key") = "", words::import_model);
  module.def("read_scenario", &readAny, py::arg("path"), words::read_scenario);
  module.def("scenario", &scenarioOf, py::arg("dict_or_text"), py::kw_only(), py::arg("folder") = py::none(),
             words::scenario_of);
}

}  // namespace ursula::python
