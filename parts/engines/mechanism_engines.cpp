// The engines that vote on machines with any closed loops, beside Simbody.

#include "parts/engines/closed_mechanism.h"
#include "parts/engines/voting_engines.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

std::unique_ptr<MechanismEngine> engineOf(const MechanismScenario& scenario, BuildTree* build, const char* check,
                                          const char* name, const char* voice) {
  const auto engine = std::make_shared<ClosedMechanism>(*scenario.mechanism, build);
  auto out = std::make_unique<MechanismEngine>();
  out->check = check;
  out->voice = voice;
  out->engine = name;
  out->efforts = [engine](const MotorMotion& motion) { return MotorEfforts(engine->inverseDynamics(motion)); };
  return out;
}

}  // namespace

void addMechanismEngines(std::vector<MakeMechanismEngine>& rows);

void addMechanismEngines(std::vector<MakeMechanismEngine>& rows) {
  rows.push_back([](const MechanismScenario& scenario) {
    return engineOf(scenario, buildMaximal, "torque.maximal", "maximal coordinates",
                    "all bodies in maximal coordinates with Lagrange multipliers");
  });
  rows.push_back([](const MechanismScenario& scenario) -> std::unique_ptr<MechanismEngine> {
    if (!mujocoAvailable()) return nullptr;
    return engineOf(scenario, buildMujoco, "torque.mujoco", "MuJoCo",
                    "MuJoCo's tree, its loops closed by the complement");
  });
}

}  // namespace ursula
