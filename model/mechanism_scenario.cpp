#include "model/mechanism_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/csv.h"
#include "base/csv_dialect.h"
#include "base/csv_digits.h"
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
  out.motors = table.readStrings("motors").value_or(std::vector<std::string>());
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

/// Returns the same table in s, rad and m, by columns in ms, us, degrees and mm.
CsvTable inSi(CsvTable table) {
  const std::tuple<const char*, const char*, double> units[] = {
      {"_ms", "_s", 1e-3}, {"_us", "_s", 1e-6}, {"_deg", "_rad", degree}, {"_mm", "_m", 1e-3}};
  for (std::size_t c = 0; c < table.names.size(); ++c)
    for (const auto& [from, to, factor] : units) {
      std::string& name = table.names[c];
      const std::size_t at = name.find(from);
      const bool of_time = std::string(to) == "_s";
      if (at == std::string::npos || (of_time && name != std::string("t") + from)) continue;
      const std::size_t end = at + std::string(from).size();
      if (end < name.size() && name.compare(end, 2, "_s") != 0) continue;
      const std::string si = name.substr(0, at) + to + name.substr(end);
      if (table.find(si) != nullptr) continue;
      name = si;
      for (double& value : table.columns[c]) value *= factor;
      break;
    }
  return table;
}

/// Returns the column of one quantity of motor k, by number or by the joint's own name; null if there is none.
const std::vector<double>* columnOf(const CsvTable& table, const Mechanism& mechanism, std::size_t k, const char* of) {
  const std::string named = motorColumn(mechanism, k, of);
  if (const auto* found = table.find(named)) return found;
  const std::string number = std::to_string(k + 1);
  const std::string unit = named.substr(named.find('_' + number + '_') + number.size() + 1);
  const std::string joint = mechanism.motor(k).name;
  return table.find(std::string(of) == "q" ? joint + unit : fmt::format("{}_{}{}", of, joint, unit));
}

/// Throws if given derivatives contradict what they belong to. Between two instants the mean slope is a derivative's
/// value there; it lies within the range of the nearest four derivatives, as far as that range goes on either side.
/// `quantum` is the rounding of the values.
void requireDerivatives(const CsvTable& table, const Mechanism& mechanism, const char* value, const char* rate,
                        double quantum) {
  const std::vector<double>& t = table.at("t_s");
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k) {
    const std::vector<double>*q = columnOf(table, mechanism, k, value), *r = columnOf(table, mechanism, k, rate);
    if (q == nullptr || r == nullptr) continue;
    double most = 0;
    for (const double each : *q) most = std::max(most, std::abs(each));
    for (std::size_t i = 0; i + 1 < t.size() && t.size() >= 4; ++i) {
      const std::size_t first = std::min(i == 0 ? 0 : i - 1, t.size() - 4);
      const auto [low, high] = std::minmax_element(r->begin() + static_cast<std::ptrdiff_t>(first),
                                                   r->begin() + static_cast<std::ptrdiff_t>(first + 4));
      const double h = t[i + 1] - t[i], slope = ((*q)[i + 1] - (*q)[i]) / h;
      const double slack = *high - *low + (2 * quantum + 1e-15 * most) / h + 1e-12 * std::abs(slope);
      if (!(h > 0) || (slope >= *low - slack && slope <= *high + slack)) continue;
      const auto nameOf = [&](const std::vector<double>* column) {
        return table.names[static_cast<std::size_t>(column - table.columns.data())];
      };
      throw CsvError(
          fmt::format("{}: error: {} is {:.6g} at t = {:.6g} s, but {} changes by {:.6g} a second from there "
                      "to the next row, expected its derivative; without the column it is taken from {}",
                      table.place(i), nameOf(r), (*r)[i], t[i], nameOf(q), slope, nameOf(q)));
    }
  }
}

}  // namespace

MotorSamples readMotorSamples(const std::filesystem::path& file, const Mechanism& mechanism) {
  const std::string text = readCsvText(file);
  CsvOptions options;
  options.dialect = guessDialect(text, file);
  const CsvTable read = inSi(parseCsv(text, file, options));
  const Eigen::MatrixXd rates = motorColumns(read, mechanism, "qdot", false);
  const Eigen::MatrixXd accelerations = motorColumns(read, mechanism, "qddot", false);
  MotorSamples out;
  out.t = read.at("t_s");
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k)
    if (const auto* column = columnOf(read, mechanism, k, "q"))
      out.quantum =
          std::max(out.quantum, halfDigit(read, read.names[static_cast<std::size_t>(column - read.columns.data())]));
  requireDerivatives(read, mechanism, "q", "qdot", out.quantum);
  requireDerivatives(read, mechanism, "qdot", "qddot", 0);
  try {
    out.trajectory = makeMotorSamples(out.t, motorColumns(read, mechanism, "q", true), rates, accelerations);
    return out;
  } catch (const InvalidParameter& refusal) {
    throw CsvError(fmt::format("{}: error: {}: {}, expected {}", file.string(), refusal.place(), refusal.value(),
                               refusal.bound()));
  }
}

namespace {

std::shared_ptr<const MotorTrajectory> readMotorSamples(const TomlSection& table, const Mechanism& mechanism) {
  table.allowOnly(mechanismTable("trajectory.samples"));
  std::string name;
  table.require("file", name);
  std::filesystem::path file = name;
  if (file.is_relative()) file = std::filesystem::path(table.file()).parent_path() / file;
  return ursula::readMotorSamples(file, mechanism).trajectory;
}

std::shared_ptr<const MotorTrajectory> readMotion(const TomlSection& table, const Mechanism& mechanism) {
  const auto kind = table.readChoice(mechanismTable("trajectory").key("kind"));
  if (!kind) table.missing("kind", "'fourier', 'samples' or 'hold'");
  switch (*kind) {
    case 0:
      return readFourier(table, mechanism);
    case 1:
      return readMotorSamples(table, mechanism);
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

void assemble(const TomlSection& document, ModelReader reader, MechanismScenario& out) {
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
  out.trajectory = readMotion(document.requiredSection("trajectory"), *out.mechanism);
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

MechanismScenario parseMechanism(const std::string& text, const std::filesystem::path& file, ModelReader reader) {
  const toml::table table = parseToml(text, file.string());
  const TomlSection document(table, "", file.string());
  MechanismScenario out;
  out.file = file;
  out.text = text;
  try {
    assemble(document, reader, out);
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

Eigen::MatrixXd motorColumns(const CsvTable& table, const Mechanism& mechanism, const char* of, bool required) {
  Eigen::MatrixXd out;
  const auto n = static_cast<Eigen::Index>(mechanism.motorCount());
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::vector<double>* column = columnOf(table, mechanism, k, of);
    if (column == nullptr && !required && k == 0) return out;
    if (column == nullptr) column = &table.at(motorColumn(mechanism, k, of));
    if (k == 0) out.resize(static_cast<Eigen::Index>(column->size()), n);
    out.col(k) = Eigen::Map<const Eigen::VectorXd>(column->data(), static_cast<Eigen::Index>(column->size()));
  }
  return out;
}

std::string motorColumn(const Mechanism& mechanism, std::size_t k, const char* quantity) {
  const bool slides = mechanism.motor(k).slides();
  const std::string of = quantity;
  if (of == "tau") return fmt::format("tau_{}_{}", k + 1, mechanism.effortUnit(k));
  const char* power = of == "q" ? "" : of == "qdot" ? "_s" : "_s2";
  return fmt::format("{}_{}_{}{}", of, k + 1, slides ? "m" : "rad", power);
}

}  // namespace ursula
