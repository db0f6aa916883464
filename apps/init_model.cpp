#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/verbs.h"
#include "base/errors.h"
#include "base/text.h"
#include "base/utf8.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

/// A basic string of TOML.
std::string tomlString(const std::string& text) {
  std::string out = "\"";
  for (const char c : utf8(text)) {
    if (c == '"' || c == '\\') out += '\\';
    const auto byte = static_cast<unsigned char>(c);
    out += byte < ' ' || byte == 0x7f ? fmt::format("\\u{:04X}", byte) : std::string(1, c);
  }
  return out + '"';
}

/// Returns the joints that could be motors: hinges and slides, those that close a loop last.
std::vector<std::string> candidates(const MechanismParameters& machine) {
  std::vector<std::string> out, closing;
  for (const MechanismJoint& joint : machine.joints)
    if (freedomsOf(joint.kind) == 1) (joint.closure ? closing : out).push_back(joint.name);
  out.insert(out.end(), closing.begin(), closing.end());
  return out;
}

/// Returns "its 1 freedom", "each of its 3 freedoms", or that without the number if the loops cannot be assembled.
std::string freedomsInWords(MechanismParameters machine, const std::string& motor) try {
  machine.motors = {motor};
  const Mechanism mechanism(std::move(machine));
  const LoopSolver solver(mechanism);
  const int found = solver.freedoms(solver.assembled()).freedoms;
  return found == 1 ? "its 1 freedom" : fmt::format("each of its {} freedoms", found);
} catch (const LoopError&) {
  return "each of its freedoms";
}

[[noreturn]] void askForMotors(const std::string& model, const MechanismParameters& machine) {
  constexpr std::size_t most = 40;
  std::vector<std::string> names;
  for (const std::string& each : candidates(machine)) names.push_back(shown(each));
  if (names.empty())
    throw UsageError(fmt::format("{}: no joint is a hinge or a slide, expected one for a motor", shownPath(model)));
  const std::string freedoms = freedomsInWords(machine, candidates(machine).front());
  const std::size_t more = names.size() - std::min(names.size(), most);
  names.resize(names.size() - more);
  throw UsageError(fmt::format(
      "{}: it drives no joint, expected --motors A,B,…, one for {}; candidates: "
      "{}{}",
      shownPath(model), freedoms, fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : ""));
}

/// A motion of a fifth of a radian, or of a twentieth of the machine's size; smaller by halves until the loops can
/// follow.
struct SmallMotion {
  std::vector<FourierSeries> motors;

  static SmallMotion of(const Mechanism& mechanism, const Eigen::VectorXd& start, double share) {
    SmallMotion out;
    for (std::size_t k = 0; k < mechanism.motorCount(); ++k) {
      const double full = mechanism.motor(k).slides() ? 0.05 * mechanism.length() : 0.2;
      // as printed, so that what is tried is what is written
      const double amplitude = std::stod(fmt::format("{:.3g}", share * full));
      out.motors.push_back({start(static_cast<Eigen::Index>(k)), {amplitude}, {}});
    }
    return out;
  }
};

/// Returns the largest such motion that can be followed and computed. Throws LoopError if there is none, and
/// ScenarioError for a wrong number of motors.
SmallMotion motionFor(MechanismScenario scenario) {
  const LoopSolver solver(*scenario.mechanism);
  const Eigen::VectorXd start = solver.motorCoordinates(solver.assembled());
  constexpr int most = 12, instants = 40;
  for (int tries = 0;; ++tries) {
    const SmallMotion motion = SmallMotion::of(*scenario.mechanism, start, std::ldexp(1, -tries));
    scenario.trajectory = makeFourier(2, 2, motion.motors);
    try {
      const MechanismAlong along(scenario);
      LoopWork work;
      for (int k = 0; k <= instants; ++k)
        static_cast<void>(along.motion().inverseDynamics(scenario.trajectory->duration() * k / instants, work));
      return motion;
    } catch (const LoopError&) {
      if (tries + 1 == most) throw;
    }
  }
}

/// Returns the file's stem if that can be a scenario's name.
std::string nameFor(const std::string& file, const std::string& model) {
  const std::string stem = std::filesystem::path(file == "-" ? model : file).stem().string();
  const bool plain = !stem.empty() && stem != "." && stem != ".." && stem.find('\\') == std::string::npos &&
                     std::all_of(stem.begin(), stem.end(), [](unsigned char c) { return c >= ' ' && c != 0x7f; });
  return plain ? stem : "my-machine";
}

std::string pathFrom(const std::string& file, const std::string& model) {
  const std::filesystem::path whole = std::filesystem::absolute(model);
  std::error_code failed;
  const std::filesystem::path path =
      std::filesystem::relative(whole, file == "-" ? "." : std::filesystem::absolute(file).parent_path(), failed);
  return failed || path.empty() ? whole.string() : path.string();
}

std::string textOf(const std::string& name, const std::string& path, const Mechanism& mechanism,
                   const SmallMotion& motion) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k) names.push_back(tomlString(mechanism.motor(k).name));
  std::string text = fmt::format(
      "name = {}\n\n[mechanism]\nfile = {}\nmotors = [{}]\noutput = {}\n\n[trajectory]\nkind = \"fourier\"  # q(t) = "
      "offset + sum of sin_j sin(2 pi j t / period) and cos_j cos(2 pi j t / period)\nduration = 2.0\nperiod = "
      "2.0\nmotors = [\n",
      tomlString(name), tomlString(path), fmt::join(names, ", "),
      tomlString(mechanism.bodies()[mechanism.output()].name));
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k)
    text += fmt::format("  {{ offset = {}, sin = [{}], cos = [] }},  # {}, {}\n", motion.motors[k].offset,
                        motion.motors[k].sin.front(), shown(mechanism.motor(k).name),
                        mechanism.motor(k).slides() ? "m" : "rad");
  return text + "]\n";
}

}  // namespace

int initFromModel(const std::string& file, const std::string& model, const std::vector<std::string>& motors) {
  const ModelReader reader = partModelReader();
  if (reader == nullptr) throw UsageError("--model: this build has no reader of models; ./dev build adds it");
  MechanismChoices choices;
  choices.motors = motors;
  MechanismScenario scenario;
  scenario.file = model;
  try {
    scenario.read = reader(model, choices);
    if (scenario.read.machine.motors.empty()) askForMotors(model, scenario.read.machine);
    scenario.mechanism = std::make_shared<Mechanism>(scenario.read.machine);
  } catch (const InvalidParameter& refusal) {
    throw UsageError(fmt::format("{}: {}, expected {}",
                                 refusal.place() == "mechanism.motors" ? "--motors" : refusal.place(), refusal.value(),
                                 refusal.bound()));
  }
  const SmallMotion motion = alongLoops(scenario, [&] { return motionFor(scenario); });
  for (const std::string& text : scenario.read.warnings) say("{}\n", withoutControls(text));
  if (const std::string moved = assemblyInWords(LoopSolver(*scenario.mechanism)); !moved.empty()) say("{}\n", moved);
  writeOutput(file,
              schemaLine(file) + textOf(nameFor(file, model), pathFrom(file, model), *scenario.mechanism, motion));
  if (file != "-") say("wrote {}; next: ursula check {}\n", file, shellWord(file));
  return exit_passed;
}

}  // namespace ursula
