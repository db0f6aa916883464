#include "model/scenario_keys.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "model/trajectories/trajectory_kinds.h"

namespace ursula {
namespace {

ScenarioTable document() {
  return {"",
          "(the top of the file)",
          "A machine, its motion and how that is judged. SI units throughout; B is the base's frame, M the platform's.",
          {{"name", KeyType::string, "", required_key, "results go to results/NAME; a name that a folder can have"},
           tableKey("manipulator", required_key, "the machine", "manipulator"),
           tableKey("trajectory", required_key, "the commanded motion of the platform", "trajectory"),
           tableKey("load", no_default, "what acts on the platform from outside", "load"),
           tableKey("simulation", no_default, "how finely it is looked at and integrated", "simulation"),
           tableKey("acceptance", no_default, "limits of your own", "acceptance")}};
}

ScenarioKey force(const char* meaning) { return {"force", KeyType::vector, "N", "[0.0, 0.0, 0.0]", meaning}; }

ScenarioKey moment() {
  return {"moment", KeyType::vector, "N·m", "[0.0, 0.0, 0.0]", "a couple, on top of what the force's arm gives"};
}

ScenarioTable load() {
  return {"load",
          "[load]",
          "A force and a moment on the platform: constant (`force`, `moment`), or over time by one of `file` and "
          "`table`, quintic between the rows and constant beyond them.",
          {force("constant"),
           moment(),
           {"point", KeyType::vector, "m", "[0.0, 0.0, 0.0]", "where the force acts, in M; zero is P"},
           choiceKey("frame", "\"base\"", "in which force and moment are given", {"base", "platform"}),
           {"file", KeyType::string, "", no_default,
            "a CSV with `t_s`, `f_{x,y,z}_N`, `m_{x,y,z}_Nm`; a relative path is taken from the scenario's folder"},
           tableKey("table", no_default, "rows over time, at least two", "load.table", KeyType::tables)}};
}

ScenarioTable loadTable() {
  return {"load.table",
          "table = [{ … }, …]",
          "",
          {{"time", KeyType::number, "s", required_key, "increasing"}, force("at that time"), moment()}};
}

ScenarioTable simulation() {
  return {"simulation",
          "[simulation]",
          "Every key has a default, recorded in the results.",
          {{"samples",
            KeyType::integer,
            "",
            "301",
            "instants judged and written, from 0 to t_f",
            {"an integer from 2 to 1000000", 2, 1e6}},
           choiceKey("integrator", "\"rkf78\"", "of the replays: rkf78 is Boost.Odeint's, rk_merson Simbody's",
                     {"rkf78", "rk_merson"}),
           {"tolerance",
            KeyType::number,
            "",
            "1e-14",
            "of the integrator, absolute and relative",
            {"a number from 1e-15 to 1e-3", 1e-15, 1e-3}}}};
}

ScenarioTable acceptance() {
  return {"acceptance",
          "[acceptance]",
          "Limits of your own in place of derived ones: `\"torque.pointwise\" = 1e-6`, in the check's unit, > 0, by "
          "the names that `summary.json` lists. And:",
          {{"torque",
            KeyType::limits,
            "",
            no_default,
            "a tolerance for efforts, as `--rtol` and `--atol`; both are added",
            {},
            {},
            "acceptance.torque"}}};
}

ScenarioTable tolerance() {
  return {"acceptance.torque",
          "torque = { … }",
          "At least one of the two.",
          {{"relative", KeyType::share, "", no_default, "of the largest effort of the motion, or `\"1%\"`", above_zero},
           {"absolute", KeyType::number, "N·m or N", no_default, "", above_zero}}};
}

}  // namespace

std::vector<std::string> ScenarioTable::names() const {
  std::vector<std::string> out;
  for (const ScenarioKey& each : keys) out.emplace_back(each.name);
  return out;
}

const ScenarioKey& ScenarioTable::key(const std::string& wanted) const {
  for (const ScenarioKey& each : keys)
    if (wanted == each.name) return each;
  throw std::out_of_range("no key '" + wanted + "' in the scenario's table '" + name + "'");
}

const std::vector<ScenarioTable>& scenarioTables() {
  static const std::vector<ScenarioTable> tables = [] {
    std::vector<ScenarioTable> all = {document()};
    for (ScenarioTable& each : machineTables()) all.push_back(std::move(each));
    for (ScenarioTable& each : motionTables()) all.push_back(std::move(each));
    for (ScenarioTable each : {load(), loadTable(), simulation(), acceptance(), tolerance()})
      all.push_back(std::move(each));
    return all;
  }();
  return tables;
}

std::string otherFrictionName(const std::string& key) {
  constexpr std::pair<const char*, const char*> names[] = {
      {"phi", "actuated"}, {"psi", "universal"}, {"theta", "knee"}};
  for (const auto& [one, other] : names) {
    if (key == one) return other;
    if (key == other) return one;
  }
  return "";
}

const ScenarioTable& scenarioTable(std::string_view name) {
  for (const ScenarioTable& each : scenarioTables())
    if (name == each.name) return each;
  throw std::out_of_range("no table '" + std::string(name) + "' in a scenario");
}

}  // namespace ursula
