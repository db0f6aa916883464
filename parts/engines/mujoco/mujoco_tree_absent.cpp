// Stands in for the formulation if MuJoCo is missing at build time.

#include <stdexcept>

#include "parts/engines/closed_mechanism.h"
#include "parts/engines/mujoco/mujoco_reading.h"

namespace ursula {

BuiltTree buildMujoco(const Mechanism&, const WeldedMechanism&) {
  throw std::runtime_error("this was built without MuJoCo");
}

ReadingDifference readByMujoco(const std::filesystem::path&, const MechanismParameters&, const ReadingChoices&) {
  throw std::runtime_error("this was built without MuJoCo");
}

}  // namespace ursula
