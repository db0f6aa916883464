#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "base/text.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

void requireMotors(const MechanismScenario& scenario, const LoopSolver& solver, const loops::LoopPose& pose,
                   bool at_start, const LoopFreedoms& found) {
  if (found.free == 0 && found.contradicted == 0) return;
  std::string what = scenario.file.string() + ": error: ";
  // Motors that fit at one pose and not at another say that one is singular.
  if (at_start) what += "the pose at t = 0 s is singular: passive joints can move while the motors stand still; ";
  const auto singular = at_start ? std::nullopt : solver.singularLoop(pose);
  if (singular && (singular->freedoms.free < found.free || singular->freedoms.contradicted < found.contradicted))
    throw ScenarioError(fmt::format("{}{}; there {} motors are for {} freedoms", what,
                                    singularWords(*scenario.mechanism, *singular), scenario.mechanism->motorCount(),
                                    singular->freedoms.freedoms));
  what += fmt::format("{} motor{} for {} freedom{}", scenario.mechanism->motorCount(),
                      scenario.mechanism->motorCount() == 1 ? "" : "s", found.freedoms, found.freedoms == 1 ? "" : "s");
  if (found.free > 0) what += fmt::format("; these joints are left free: {}", fmt::join(found.free_joints, ", "));
  if (found.contradicted > 0)
    what += found.fighting.empty()
                ? "; the motors fight each other"
                : fmt::format("; these motors fight each other or the loops: {}", fmt::join(found.fighting, ", "));
  if (found.freedoms == 0) what += "; nothing can move: `base` or `close` of [mechanism] may hold a link of a loop";
  throw ScenarioError(what +
                      ". Expected as many motors as freedoms: see `motors` of [mechanism], and which joints the "
                      "model's closures fix");
}

}  // namespace

std::string assemblyInWords(const LoopSolver& solver) {
  constexpr double little = 0.1;
  const JointMove move = solver.assemblyMove();
  if (!(move.share > little)) return "";
  return fmt::format(
      "the file's pose is open by {:.2g} of the machine's length; closing it moves {} by {:.2g} {}, more than any "
      "other joint: if that is another assembly than yours, start from a pose that is nearly closed",
      solver.assemblyGap(), move.joint.empty() ? "a free body" : shown(move.joint), move.by, move.slides ? "m" : "rad");
}

MechanismAlong::MechanismAlong(const MechanismScenario& scenario) : scenario_(scenario) {
  solver_ = std::make_unique<LoopSolver>(*scenario.mechanism);
  if (scenario.mechanism->start().empty() && !solver_->mechanism().start().empty())
    scenario_.mechanism = std::make_shared<Mechanism>(solver_->mechanism());
  loops::LoopPose start = solver_->assembled();
  requireMotors(scenario, *solver_, start, false, solver_->freedoms(start));
  moveToStart(*solver_, *scenario.trajectory, start);
  freedoms_ = solver_->freedoms(start);
  requireMotors(scenario, *solver_, start, true, freedoms_);
  motion_ = std::make_unique<LoopMotion>(*solver_, *scenario.trajectory, start);
}

}  // namespace ursula
