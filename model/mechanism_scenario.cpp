#include "model/mechanism_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/errors.h"
#include "base/text.h"
#include "model/mechanism_keys.h"
#include "model/mechanism_numbers.h"
#include "model/scenario_files.h"
#include "model/scenario_sections.h"
#include "model/toml_reader.h"

namespace ursula {
namespace {

std::vector<double> numbersOf(const TomlSection& table, const char* key) {
  std::vector<double> out;
  const toml::node* node = table.table().get(key);
  if (node == nullptr) return out;
  if (!node->is_array()) table.fail(key, "expected an array of numbers");
  for (const toml::node& each : *node->as_array()) {
    const auto number = each.value<double>();
    if (!number || !std::isfinite(*number)) table.fail(key, "expected an array of finite numbers");
    out.push_back(*number);
  }
  return out;
}

MechanismChoices readChoices(const TomlSection& table) {
  MechanismChoices out;
  const auto motors = table.readStrings("motors");
  if (motors && motors->empty()) table.fail("motors", "[], expected the names of one or more joints, or no such key");
  out.motors = motors.value_or(std::vector<std::string>());
  out.close = table.readStrings("close").value_or(std::vector<std::string>());
  out.leave_out = table.readStrings("leave_out").value_or(std::vector<std::string>());
  table.read("base", out.base);
  table.read("key", out.key);
  if (Vector3d gravity; table.read("gravity", gravity)) out.gravity = gravity;
  return out;
}

/// The motors' count and units decide how a motion is read.
void requireCount(const TomlSection& table, std::size_t given, const Mechanism& mechanism) {
  if (given == mechanism.motorCount()) return;
  std::string names;
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k)
    names += (k == 0 ? "" : ", ") + shown(mechanism.motor(k).name);
  table.fail("motors",
             fmt::format("{} entries, expected {}, one for each motor: {}", given, mechanism.motorCount(), names));
}

std::unique_ptr<MotorTrajectory> readFourier(const TomlSection& table, const Mechanism& mechanism) {
  table.allowOnly(mechanismTable("trajectory.fourier"));
  double duration = 0, period = 0;
  table.require("duration", duration);
  if (!table.read("period", period)) period = duration;
  std::vector<FourierSeries> motors;
  for (const TomlSection& each : table.sections("motors")) {
    each.allowOnly(mechanismTable("trajectory.fourier.motors"));
    FourierSeries series;
    each.read("offset", series.offset);
    series.sin = numbersOf(each, "sin");
    series.cos = numbersOf(each, "cos");
    motors.push_back(series);
  }
  requireCount(table, motors.size(), mechanism);
  return makeFourier(duration, period, std::move(motors));
}

std::unique_ptr<MotorTrajectory> readHold(const TomlSection& table, const Mechanism& mechanism) {
  table.allowOnly(mechanismTable("trajectory.hold"));
  double duration = 0;
  table.require("duration", duration);
  const std::vector<double> q = numbersOf(table, "motors");
  requireCount(table, q.size(), mechanism);
  return makeMotorHold(duration, Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size())));
}

std::shared_ptr<const MotorTrajectory> readMotorSamples(const TomlSection& table, const Mechanism& mechanism,
                                                        const std::vector<std::string>& map, MechanismScenario& out) {
  table.allowOnly(mechanismTable("trajectory.samples"));
  std::string name;
  table.require("file", name);
  std::filesystem::path file = name;
  if (file.is_relative()) file = std::filesystem::path(table.file()).parent_path() / file;
  MotorSamples read = ursula::readMotorSamples(file, mechanism, map);
  out.motion_read_as = std::move(read.read_as);
  out.mapped = std::move(read.mapped);
  return read.trajectory;
}

std::shared_ptr<const MotorTrajectory> readMotion(const TomlSection& table, const Mechanism& mechanism,
                                                  const std::vector<std::string>& map, MechanismScenario& out) {
  const auto kind = table.readChoice(mechanismTable("trajectory").key("kind"));
  if (!kind) table.missing("kind", "'fourier', 'samples' or 'hold'");
  switch (*kind) {
    case 0:
      return readFourier(table, mechanism);
    case 1:
      return readMotorSamples(table, mechanism, map, out);
    default:
      return readHold(table, mechanism);
  }
}

/// Replaces numbers of the model by those of `[mechanism.numbers]`.
void takeNumbers(const TomlSection& table, MechanismParameters& machine) {
  for (const auto& [key, node] : table.table()) {
    const std::string name(key.str());
    double value = 0;
    table.require(name, value);
    try {
      setMechanismNumber(name, value, machine);
    } catch (const InvalidParameter& refusal) {
      table.fail(name, fmt::format("{}, expected {}", refusal.value(), refusal.bound()));
    }
  }
}

void assemble(const TomlSection& document, ModelReader reader, const std::vector<std::string>& map,
              MechanismScenario& out) {
  requireOneMachine(document);
  document.allowOnly(mechanismTable(""));
  Scenario common;
  readJudging(document, common);
  out.name = common.name;
  out.simulation = common.simulation;
  out.acceptance = common.acceptance;
  out.tolerance = common.tolerance;
  const TomlSection table = document.requiredSection("mechanism");
  table.allowOnly(mechanismTable("mechanism"));
  std::string model, output;
  table.require("file", model);
  table.read("output", output);
  out.model = model;
  if (out.model.is_relative()) out.model = out.file.parent_path() / out.model;
  if (reader == nullptr) table.fail("file", "this build has no reader of models; ./dev build adds it");
  out.read = reader(out.model, readChoices(table));
  if (const auto numbers = table.section("numbers")) takeNumbers(*numbers, out.read.machine);
  out.mechanism = std::make_shared<Mechanism>(out.read.machine, output);
  out.trajectory = readMotion(document.requiredSection("trajectory"), *out.mechanism, map, out);
}

}  // namespace

bool isMechanism(const std::string& text) {
  try {
    return parseToml(text, "").contains("mechanism");
  } catch (const ScenarioError&) {
    return false;
  }
}

bool isMechanismFile(const std::filesystem::path& file) { return isMechanism(scenarioText(file)); }

MechanismScenario parseMechanism(const std::string& text, const std::filesystem::path& file, ModelReader reader,
                                 const std::vector<std::string>& map) {
  const toml::table table = parseToml(text, file.string());
  const TomlSection document(table, "", file.string());
  MechanismScenario out;
  out.file = file;
  out.text = text;
  try {
    assemble(document, reader, map, out);
    return out;
  } catch (const PlacedError& error) {
    throw error.in(text);
  } catch (const InvalidParameter& refusal) {
    throw located(refusal, document).in(text);
  }
}

MechanismScenario readMechanism(const std::filesystem::path& file, ModelReader reader) {
  return parseMechanism(scenarioText(file), file, reader);
}

}  // namespace ursula
