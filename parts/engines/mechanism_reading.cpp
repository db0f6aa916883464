// MuJoCo's own reader as a second reader of model files.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "parts/engines/mujoco/mujoco_loop.h"
#include "parts/engines/mujoco/mujoco_reading.h"
#include "parts/engines/voting_engines.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

constexpr const char* check = "model.reading";

bool has(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

ReadingChoices choicesOf(const MechanismScenario& scenario, const std::string& model) {
  ReadingChoices out;
  const auto& said = scenario.read.assumptions;
  out.of_file_pose = std::none_of(said.begin(), said.end(), [](const std::string& each) {
    return has(each, "The initial pose is that of the keyframe");
  });
  out.is_urdf = has(model, "<robot");
  for (const std::string& each : said)
    if (const auto at = each.find(": This joint is another one than in the URDF"); at != std::string::npos)
      out.retyped.push_back(each.substr(0, at));
  out.leaves_out = has(scenario.text, "leave_out");
  const std::string of_mechanism = scenario.text.substr(0, scenario.text.find("[trajectory]"));
  out.has_file_gravity = !has(of_mechanism, "gravity");
  out.by_eigenvalues =
      !has(model, "diaginertia") || has(model, "fullinertia") || has(model, "<include") || has(model, "<geom");
  return out;
}

}  // namespace

Check addMechanismReading(const MechanismScenario& scenario);

Check addMechanismReading(const MechanismScenario& scenario) {
  if (!mujocoAvailable()) return notApplicable(check, "1", "this build has no MuJoCo");
  std::ifstream in(scenario.model, std::ios::binary);
  const std::string model((std::istreambuf_iterator<char>(in)), {});
  if (has(model, "<sdf")) return notApplicable(check, "1", "MuJoCo reads MJCF and URDF, this is SDF");
  const ReadingChoices choices = choicesOf(scenario, model);
  const ReadingDifference found = readByMujoco(scenario.model, scenario.read.machine, choices);
  if (!found.refusal.empty())
    return notApplicable(check, "1",
                         fmt::format("MuJoCo {} does not read the file ({})", mujocoVersion(), found.refusal));
  if (found.bodies + found.joints == 0) return notApplicable(check, "1", "bodies and joints of the file have no names");
  return judged(check, found.value, found.limit, "1",
                found.limit > 1e-12 ? "inertias that MuJoCo diagonalises keep half of their digits"
                                    : "some thousand roundings along chains of frames",
                fmt::format("{} bodies, {} joints and {} closures by name{}{}{}", found.bodies, found.joints,
                            found.closures, found.where.empty() ? "" : "; largest: " + found.where,
                            found.left_out.empty() ? ""
                                                   : fmt::format("; left out, as MuJoCo does not read it: {}",
                                                                 fmt::join(found.left_out, ", ")),
                            choices.of_file_pose ? "" : "; frames not, because the pose is a keyframe's"));
}

}  // namespace ursula
