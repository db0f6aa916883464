#include "apps/mechanism.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/files_apart.h"
#include "apps/output.h"
#include "apps/suite/no_model.h"
#include "apps/verbs.h"
#include "base/csv.h"
#include "base/text.h"
#include "model/instants.h"
#include "model/scenario_files.h"
#include "report/page/scenario_picture.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/outside/given_motion.h"

namespace ursula {
std::vector<std::pair<std::string, std::string>> effortColumns(const std::vector<std::string>& texts,
                                                               const Mechanism& mechanism) {
  std::vector<std::string> known = {"t_s"};
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k) known.push_back(motorColumn(mechanism, k, "tau"));
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size())
      throw UsageError(fmt::format("--map {}: expected NAME=COLUMN, as in {}=tau1", shown(text), known[1]));
    const std::string name = text.substr(0, equals);
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(
          fmt::format("--map {}: '{}' is no column of this mechanism's efforts, expected t_s or {} to {}{}",
                      shown(text), shown(name), known[1], known.back(), didYouMean(name, known)));
    out.emplace_back(name, text.substr(equals + 1));
  }
  return out;
}

AnyScenario readAny(const std::string& file, std::initializer_list<std::string> written) {
  const std::string text = scenarioNotModel(file);
  const std::filesystem::path name = namedInput(file);
  AnyScenario out;
  if (isMechanism(text))
    out.mechanism = parseMechanism(text, name, partModelReader());
  else
    out.manipulator = parseScenario(text, name);
  requireApart(text, name, written);
  return out;
}

AnyScenario openAny(const std::string& file, std::initializer_list<std::string> written) {
  AnyScenario out = readAny(file, written);
  if (out.manipulator) sayWarnings(*out.manipulator);
  if (out.mechanism)
    for (const std::string& text : out.mechanism->read.warnings) say("{}\n", withoutControls(text));
  return out;
}

int inverseOfMechanism(const MechanismScenario& scenario, int samples, const std::string& out) {
  return alongLoops(scenario, [&] {
    const Mechanism& mechanism = *scenario.mechanism;
    const MechanismAlong path(scenario);
    std::vector<std::string> names = {"t_s"};
    for (const char* quantity : {"q", "qdot", "qddot", "tau"})
      for (std::size_t k = 0; k < mechanism.motorCount(); ++k) names.push_back(motorColumn(mechanism, k, quantity));
    LoopWork work;
    static_cast<void>(path.motion().inverseDynamics(0, work));
    for (const LoopSolver::JointValue& joint : path.solver().joints(work)) names.push_back(joint.name);
    std::vector<std::vector<double>> columns(names.size());
    for (const double t : equallySpaced(scenario.trajectory->duration(), samples)) {
      const MotorMotion motion = scenario.trajectory->at(t);
      const Eigen::VectorXd efforts = path.motion().inverseDynamics(t, work);
      std::size_t at = 0;
      columns[at++].push_back(t);
      for (const Eigen::VectorXd* each : {&motion.q, &motion.qdot, &motion.qddot, &efforts})
        for (Eigen::Index k = 0; k < each->size(); ++k) columns[at++].push_back((*each)(k));
      for (const LoopSolver::JointValue& joint : path.solver().joints(work)) columns[at++].push_back(joint.value);
    }
    writeOutput(out, csvText(names, columns));
    return exit_passed;
  });
}

namespace {

/// Makes the scenario's motion, and draws the machine, whether it can move or not.
MechanismAlong pathWithPicture(const MechanismScenario& scenario, const std::string& file) {
  const auto draw = [&](const MechanismPicture& machine, const char* when) {
    if (!file.empty()) writePicture(file, picture(machine, scenario.name + when));
  };
  try {
    MechanismAlong path(scenario);
    draw(*makePicture(scenario, path, 121), ", t = 0");
    return path;
  } catch (const std::exception&) {
    draw(*pictureAsRead(scenario), ", as its model places it: it cannot make the motion");
    throw;
  }
}

}  // namespace

int checkMechanism(const MechanismScenario& scenario, const std::string& picture_file) {
  return alongLoops(scenario, [&] {
    const MechanismAlong path = pathWithPicture(scenario, picture_file);
    LoopWork work;
    for (const double t : equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples))
      static_cast<void>(path.motion().inverseDynamics(t, work));
    const auto tell = [on_stderr = picture_file == "-"](const std::string& text) {
      on_stderr ? sayText(withoutControls(text)) : writeOutput("-", withoutControls(text));
    };
    for (const std::string& text : scenario.read.warnings) tell(text + "\n");
    for (const std::string& text : scenario.read.assumptions) tell(text + "\n");
    if (!path.freedoms().idle.empty())
      tell(fmt::format("held at rest, since a spin about their own line has no effect: {}\n",
                       fmt::join(path.freedoms().idle, ", ")));
    tell(fmt::format("{}: {} freedom{} and as many motors; the scenario and its motion are valid; {} warning{}\n",
                     scenario.file.string(), path.freedoms().freedoms, path.freedoms().freedoms == 1 ? "" : "s",
                     scenario.read.warnings.size(), scenario.read.warnings.size() == 1 ? "" : "s"));
    return exit_passed;
  });
}

ValidationResult judgeMechanism(const MechanismScenario& scenario, const OtherSubject& other,
                                const MechanismOptions& options) {
  return alongLoops(scenario, [&] {
    if (!other.solver.command.empty())
      return other.simulates ? validateExternalSimulator(scenario, other.solver, options)
                             : validateExternalSolver(scenario, other.solver, options);
    std::shared_ptr<const GivenEfforts> given;
    if (!other.torques.empty())
      given = std::make_shared<const GivenEfforts>(readMotorEfforts(other.torques, *scenario.mechanism,
                                                                    scenario.trajectory->duration(),
                                                                    effortColumns(other.map, *scenario.mechanism)));
    if (!other.trajectory.empty()) return validateMotion(scenario, other.trajectory, given.get(), options);
    MechanismSubject subject;
    subject.given = given;
    if (given) subject.about = {given->name, Formulation::external, CalledBy::torques};
    return validateMechanism(scenario, subject, options);
  });
}

}  // namespace ursula
