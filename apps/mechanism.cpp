#include "apps/mechanism.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/files_apart.h"
#include "apps/output.h"
#include "apps/suite/no_model.h"
#include "apps/validate_options.h"
#include "apps/verbs.h"
#include "base/csv.h"
#include "base/csv_dialect.h"
#include "base/text.h"
#include "model/instants.h"
#include "model/motor_table.h"
#include "model/scenario_files.h"
#include "model/torque_names.h"
#include "report/page/scenario_picture.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/outside/given_motion.h"

namespace ursula {
AnyScenario readAny(const std::string& file, std::initializer_list<std::string> written,
                    const std::vector<std::string>& map) {
  const std::string text = scenarioNotModel(file);
  const std::filesystem::path name = namedInput(file);
  AnyScenario out;
  if (isMechanism(text))
    out.mechanism = parseMechanism(text, name, partModelReader(), map);
  else
    out.manipulator = parseScenario(text, name);
  requireApart(text, name, written);
  return out;
}

AnyScenario openAny(const std::string& file, std::initializer_list<std::string> written,
                    const std::vector<std::string>& map) {
  AnyScenario out = readAny(file, written, map);
  if (out.manipulator) sayWarnings(*out.manipulator);
  if (!out.mechanism) return out;
  if (!out.mechanism->motion_read_as.empty()) say("{}\n", out.mechanism->motion_read_as);
  for (const std::string& text : out.mechanism->read.warnings) say("{}\n", withoutControls(text));
  return out;
}

void requireUsed(const std::vector<std::string>& map, const std::vector<std::string>& used) {
  for (const std::string& each : map)
    if (std::find(used.begin(), used.end(), each) == used.end())
      throw UsageError(
          fmt::format("--map {}: no file of motion or efforts that is read has this column and takes this name for it",
                      shown(each)));
}

void requireUsed(const std::vector<std::string>& map, const AnyScenario& any) {
  requireUsed(map, any.mechanism ? any.mechanism->mapped : std::vector<std::string>());
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

CheckedScenario checkMechanism(const MechanismScenario& scenario, const std::string& picture_file,
                               std::string& freedoms) {
  return alongLoops(scenario, [&] {
    const MechanismAlong path = pathWithPicture(scenario, picture_file);
    LoopWork work;
    for (const double t : equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples))
      static_cast<void>(path.motion().inverseDynamics(t, work));
    CheckedScenario out{scenario.file.string(), scenario.name};
    out.warnings = scenario.read.warnings;
    if (std::string moved = assemblyInWords(path.solver()); !moved.empty()) out.warnings.push_back(std::move(moved));
    out.assumptions = scenario.read.assumptions;
    if (!path.freedoms().idle.empty())
      out.assumptions.push_back(fmt::format("held at rest, since a spin about their own line has no effect: {}",
                                            fmt::join(path.freedoms().idleNames(), ", ")));
    freedoms = fmt::format("{} freedom{} and as many motors; ", path.freedoms().freedoms,
                           path.freedoms().freedoms == 1 ? "" : "s");
    return out;
  });
}

ValidationResult judgeMechanism(const MechanismScenario& scenario, const OtherSubject& other,
                                const MechanismOptions& options) {
  return alongLoops(scenario, [&] {
    if (!other.solver.command.empty())
      return other.simulates ? validateExternalSimulator(scenario, other.solver, options)
                             : validateExternalSolver(scenario, other.solver, options);
    std::vector<std::string> used = scenario.mapped;
    if (!other.trajectory.empty()) {
      const MotorTable motion = readMotorTable(other.trajectory, *scenario.mechanism, other.map);
      used.insert(used.end(), motion.mapped.begin(), motion.mapped.end());
      if (!motion.read_as.empty()) say("{}: read as: {}\n", shownPath(other.trajectory), motion.read_as);
    }
    std::shared_ptr<const GivenEfforts> given;
    if (!other.torques.empty())
      given = std::make_shared<const GivenEfforts>(readEffortsAloud(other.torques, other.map, used, scenario));
    else if (!other.trajectory.empty())
      requireUsed(other.map, used);
    if (!other.trajectory.empty()) return validateMotion(scenario, other.trajectory, given.get(), options, other.map);
    MechanismSubject subject;
    subject.given = given;
    if (given) subject.about = {given->name, Formulation::external, CalledBy::torques};
    return validateMechanism(scenario, subject, options);
  });
}

namespace {

/// The entries for a file of efforts: not those that the motion's file used, unless this one has such a column, too.
std::vector<std::string> effortEntries(const std::string& file, const std::vector<std::string>& map,
                                       const std::vector<std::string>& used, const Mechanism& mechanism) {
  if (map.empty()) return {};
  const std::vector<std::string> header = guessDialect(readCsvText(file), file).header_cells;
  std::vector<std::string> out;
  for (const std::string& each : map) {
    const auto [name, column] = mapEntry(each);
    const bool is_own =
        meaningOfTarget(name, mechanism).has_value() && std::find(header.begin(), header.end(), column) != header.end();
    if (is_own || std::find(used.begin(), used.end(), each) == used.end()) out.push_back(each);
  }
  return out;
}

}  // namespace

GivenEfforts readEffortsAloud(const std::string& file, const std::vector<std::string>& map,
                              const std::vector<std::string>& used, const MechanismScenario& scenario) {
  const Mechanism& mechanism = *scenario.mechanism;
  const std::vector<std::string> own = effortEntries(file, map, used, mechanism);
  GivenEfforts given =
      readMotorEfforts(file, mechanism, scenario.trajectory->duration(), parseColumnMap(own, mechanism));
  sayHowRead(file, given.read_as, given.ignored, targetNames(mechanism));
  return given;
}

}  // namespace ursula
