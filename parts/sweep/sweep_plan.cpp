#include "parts/sweep/sweep_plan.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "base/errors.h"
#include "base/provenance.h"
#include "base/sha1.h"
#include "base/utf8.h"
#include "model/mechanism_numbers.h"
#include "model/scenario_files.h"
#include "model/scenario_numbers.h"
#include "model/scenario_sections.h"
#include "model/toml_reader.h"
#include "model/toml_writer.h"

namespace ursula {
namespace {

std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::optional<MechanismScenario> mechanismOf(const SweepFile& sweep) {
  const std::string text = scenarioText(sweep.scenario);
  if (!isMechanism(text)) return std::nullopt;
  if (sweep.pointwise)
    throw ScenarioError(fmt::format("{}: error: pointwise: {} has [mechanism], expected [manipulator]",
                                    sweep.file.string(), sweep.scenario.string()));
  return parseMechanism(text, sweep.scenario, partModelReader());
}

Scenario outlineOf(const MechanismScenario& mechanism) {
  Scenario out;
  out.name = mechanism.name;
  out.file = mechanism.file;
  out.text = mechanism.text;
  out.simulation = mechanism.simulation;
  return out;
}

}  // namespace

struct SweepPlan::Document {
  toml::table table;
  ScenarioNumbers numbers{table};
  std::vector<std::filesystem::path> files;
  const MechanismParameters* machine = nullptr;  ///< of a mechanism

  Document(const SweepFile& sweep, const Scenario& base, const MechanismScenario* mechanism)
      : table(parseToml(base.text, base.file.string())) {
    if (mechanism != nullptr) machine = &mechanism->read.machine;
    takeTolerances(table, base.file.string());
    files = makeFilesAbsolute(table, base.file);
    if (!sweep.samples) return;
    if (!table.contains("simulation")) table.insert("simulation", toml::table{});
    table["simulation"].as_table()->insert_or_assign("samples", *sweep.samples);
  }

  std::string text() const { return tomlText(table); }

  /// Returns the keys that a key of the sweep means; `*` is every body, joint, leg or entry.
  std::vector<std::string> expanded(const std::string& key) const {
    const std::string prefix = "mechanism.";
    if (machine == nullptr || key.rfind(prefix, 0) != 0) return numbers.expanded(key);
    const std::vector<std::string> names = mechanismNumbers(*machine);
    const std::size_t star = key.find('*');
    if (star == std::string::npos) return {key};
    std::vector<std::string> out;
    const std::string before = key.substr(prefix.size(), star - prefix.size()), after = key.substr(star + 1);
    for (const std::string& name : names)
      if (name.size() > before.size() + after.size() && name.rfind(before, 0) == 0 &&
          name.compare(name.size() - after.size(), after.size(), after) == 0)
        out.push_back(prefix + name);
    if (out.empty()) throw NumberKeyError(fmt::format("'{}': '*' stands for nothing in the model", key));
    return out;
  }

  /// Returns the place of a key in the document. A number of the model is written there first.
  std::string written(const std::string& key) {
    const std::string prefix = "mechanism.";
    if (machine == nullptr || key.rfind(prefix, 0) != 0) return key;
    const std::string name = key.substr(prefix.size());
    try {
      const double value = mechanismNumber(*machine, name);
      toml::table& mechanism = *table["mechanism"].as_table();
      if (!mechanism.contains("numbers")) mechanism.insert("numbers", toml::table{});
      mechanism["numbers"].as_table()->insert_or_assign(name, value);
    } catch (const InvalidParameter& refusal) {
      throw NumberKeyError(fmt::format("{}, expected {}", refusal.value(), refusal.bound()));
    }
    return "mechanism.numbers.\"" + name + '"';
  }

  /// Throws ScenarioError at the sweep's key.
  std::vector<VariedNumber> hold(const SweepFile& sweep) {
    std::vector<VariedNumber> out;
    std::set<std::string> seen;
    for (const Vary& vary : sweep.vary) try {
        for (const std::string& key : expanded(vary.key)) {
          if (!seen.insert(key).second) throw NumberKeyError(fmt::format("'{}' varies twice, expected once", key));
          out.push_back({key, vary.by, numbers.hold(written(key))});
          if (vary.by.values.empty() && numbers.isInteger(out.size() - 1))
            throw NumberKeyError(fmt::format("'{}': expected an integer, so 'values'", key));
          if (vary.by.kind == Variation::Kind::relative && out.back().nominal == 0)
            throw NumberKeyError(fmt::format(
                "'{}' is 0 in the scenario, and 'relative' leaves it so, expected another way to vary", key));
        }
      } catch (const NumberKeyError& error) {
        throw ScenarioError(fmt::format("{}: error: {}", vary.place, error.what()));
      }
    return out;
  }
};

SweepPlan::SweepPlan(SweepFile file)
    : file_(std::move(file)),
      mechanism_(mechanismOf(file_)),
      base_(mechanism_ ? outlineOf(*mechanism_) : readScenario(file_.scenario)),
      document_(std::make_unique<Document>(file_, base_, mechanism())),
      points_(file_, document_->hold(file_)) {
  if (mechanism_) return;
  for (const VariedNumber& number : points_.numbers()) {
    const std::string part = number.key.substr(0, number.key.find('.'));
    bool& varies = part == "manipulator"  ? varies_machine_
                   : part == "trajectory" ? varies_trajectory_
                   : part == "load"       ? varies_load_
                                          : varies_other_;
    varies = true;
  }
  base_ = parseScenario(document_->text(), file_.scenario);  // with the sweep's samples
}

SweepPlan::~SweepPlan() = default;

void SweepPlan::setTo(std::int64_t i) {
  const std::vector<double> values = points_.at(i);
  try {
    for (std::size_t k = 0; k < values.size(); ++k) document_->numbers.set(k, values[k]);
  } catch (const NumberKeyError& error) {
    throw ScenarioError(fmt::format("point {}: error: {}", i, error.what()));
  }
}

std::string SweepPlan::parameters(std::int64_t i) const {
  const std::vector<double> values = points_.at(i);
  std::string out = "{";
  for (std::size_t k = 0; k < values.size(); ++k)
    out += fmt::format("{}{}:{}", k == 0 ? "" : ",", nlohmann::json(points_.numbers()[k].key).dump(), values[k]);
  return out + "}";
}

std::string SweepPlan::text(std::int64_t i) {
  setTo(i);
  const std::string name = document_->table["name"].value_or(std::string());
  *document_->table["name"].as_string() = fmt::format("{}-{}", name, i);
  const std::string text = document_->text();
  *document_->table["name"].as_string() = name;
  return fmt::format("# Point {} of the sweep {}\n\n{}", i, file_.file.filename().string(), text);
}

MechanismScenario SweepPlan::readMechanism(std::int64_t i) {
  return parseMechanism(text(i), fmt::format("point {} of {}", i, file_.file.filename().string()), partModelReader());
}

/// Errors have line numbers of the output of `sweep show`, not of the base scenario.
Scenario SweepPlan::read(std::int64_t i) {
  return parseScenario(text(i), fmt::format("point {} of {}", i, file_.file.filename().string()));
}

Scenario SweepPlan::make(std::int64_t i) {
  if (varies_other_) return read(i);
  setTo(i);
  const TomlSection document(document_->table, "", file_.scenario.string());
  Scenario out = base_;
  out.name = fmt::format("{}-{}", base_.name, i);
  out.text.clear();
  try {
    if (varies_machine_)
      out.manipulator = std::make_shared<Manipulator>(readManipulator(document.requiredSection("manipulator")));
    if (varies_trajectory_) out.trajectory = readTrajectory(document.requiredSection("trajectory"));
    if (varies_load_) out.load = readLoad(document.requiredSection("load"));
  } catch (const std::exception&) {
    return read(i);  // it throws the error with its place
  }
  return out;
}

SweepIdentity SweepPlan::identity() const {
  SweepIdentity out;
  out.text = file_.text;
  out.version = buildProvenance().version;
  out.file = utf8(file_.file.string());
  out.scenario = bytesOf(file_.scenario);
  out.name = base_.name;
  out.what = ursula::name(file_.work);
  out.design = ursula::name(file_.design);
  out.pointwise = file_.pointwise;
  out.points = points_.count();
  Sha1 meaning;  // of everything that determines a sweep's rows, to the last bit
  const auto add = [&meaning](const std::string& text) { meaning.add(fmt::format("{}:{}", text.size(), text)); };
  const auto addNumber = [&add](double value) { add(fmt::format("{:a}", value)); };
  for (const std::string& text :
       {out.what, out.design, out.scenario,
        fmt::format("{} {} {} {}", out.points, file_.seed, file_.pointwise, file_.samples.value_or(0))})
    add(text);
  for (const std::filesystem::path& file : document_->files) add(bytesOf(file));
  for (const VariedNumber& number : points_.numbers()) {
    out.keys.push_back(number.key);
    add(number.key);
    for (const double value : {static_cast<double>(number.by.kind), number.by.a, number.by.b}) addNumber(value);
    for (const double value : number.by.values) addNumber(value);
  }
  out.hash = meaning.digits();
  return out;
}

}  // namespace ursula
