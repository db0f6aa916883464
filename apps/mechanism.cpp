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
#include "base/text.h"
#include "model/instants.h"
#include "model/scenario_files.h"
#include "model/torque_names.h"
#include "report/page/scenario_picture.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/outside/given_motion.h"

namespace ursula {
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

CheckedScenario checkMechanism(const MechanismScenario& scenario, const std::string& picture_file,
                               std::string& freedoms) {
  return alongLoops(scenario, [&] {
    const MechanismAlong path = pathWithPicture(scenario, picture_file);
    LoopWork work;
    for (const double t : equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples))
      static_cast<void>(path.motion().inverseDynamics(t, work));
    CheckedScenario out{scenario.file.string(), scenario.name};
    out.warnings = scenario.read.warnings;
    out.assumptions = scenario.read.assumptions;
    if (!path.freedoms().idle.empty())
      out.assumptions.push_back(fmt::format("held at rest, since a spin about their own line has no effect: {}",
                                            fmt::join(path.freedoms().idle, ", ")));
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
    std::shared_ptr<const GivenEfforts> given;
    if (!other.torques.empty())
      given = std::make_shared<const GivenEfforts>(readEffortsAloud(other.torques, other.map, scenario));
    if (!other.trajectory.empty()) return validateMotion(scenario, other.trajectory, given.get(), options);
    MechanismSubject subject;
    subject.given = given;
    if (given) subject.about = {given->name, Formulation::external, CalledBy::torques};
    return validateMechanism(scenario, subject, options);
  });
}

GivenEfforts readEffortsAloud(const std::string& file, const std::vector<std::string>& map,
                              const MechanismScenario& scenario) {
  const Mechanism& mechanism = *scenario.mechanism;
  GivenEfforts given =
      readMotorEfforts(file, mechanism, scenario.trajectory->duration(), parseColumnMap(map, mechanism));
  sayHowRead(file, given.read_as, given.ignored, targetNames(mechanism));
  return given;
}

}  // namespace ursula
