// Stands in for the formulation if MuJoCo is missing at build time.

#include <stdexcept>

#include "parts/engines/mujoco/mujoco_mechanism.h"
#include "parts/engines/mujoco/mujoco_reading.h"

namespace ursula {

struct MujocoMechanism::Impl {};

MujocoMechanism::MujocoMechanism(const Mechanism&) { throw std::runtime_error("this was built without MuJoCo"); }
MujocoMechanism::~MujocoMechanism() = default;
Eigen::VectorXd MujocoMechanism::inverseDynamics(const MotorMotion&) {
  throw std::runtime_error("this was built without MuJoCo");
}

ReadingDifference readByMujoco(const std::filesystem::path&, const MechanismParameters&, const ReadingChoices&) {
  throw std::runtime_error("this was built without MuJoCo");
}

}  // namespace ursula
