#include "parts/sweep/sweep_plan.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "base/provenance.h"
#include "base/sha1.h"
#include "base/utf8.h"
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

}  // namespace

struct SweepPlan::Document {
  toml::table table;
  ScenarioNumbers numbers{table};
  std::vector<std::filesystem::path> files;

  Document(const SweepFile& sweep, const Scenario& base) : table(parseToml(base.text, base.file.string())) {
    takeTolerances(table, base.file.string());
    files = makeFilesAbsolute(table, base.file);
    if (!sweep.samples) return;
    if (!table.contains("simulation")) table.insert("simulation", toml::table{});
    table["simulation"].as_table()->insert_or_assign("samples", *sweep.samples);
  }

  std::string text() const { return tomlText(table); }

  /// Throws ScenarioError at the sweep's key.
  std::vector<VariedNumber> hold(const SweepFile& sweep) {
    std::vector<VariedNumber> out;
    std::set<std::string> seen;
    for (const Vary& vary : sweep.vary) try {
        for (const std::string& key : numbers.expanded(vary.key)) {
          if (!seen.insert(key).second) throw NumberKeyError(fmt::format("'{}' varies twice, expected once", key));
          out.push_back({key, vary.by, numbers.hold(key)});
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
      base_(readScenario(file_.scenario)),
      document_(std::make_unique<Document>(file_, base_)),
      points_(file_, document_->hold(file_)) {
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
