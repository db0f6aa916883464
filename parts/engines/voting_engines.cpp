#include "parts/engines/voting_engines.h"

#include "parts/engines/mujoco/mujoco_loop.h"

namespace ursula {

void addEngines(std::vector<EngineKind>& rows) {
  rows.push_back({"torque.maximal", "maximal coordinates",
                  "links and platform in maximal coordinates with Lagrange multipliers", alwaysAvailable,
                  makeMaximalLoop});
  rows.push_back(
      {"torque.mujoco", "MuJoCo", "MuJoCo's trees, closed by Lagrange multipliers", mujocoAvailable, makeMujocoLoop});
}

void addEnginesProvenance(std::vector<std::pair<std::string, std::string>>& rows) {
  rows.emplace_back("MuJoCo", mujocoVersion());
}

}  // namespace ursula
