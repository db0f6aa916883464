// Stands in for the road where this is built without MuJoCo.

#include <stdexcept>

#include "model/loops/mujoco/mujoco_loop.h"

namespace ursula {

struct MujocoLoop::Impl {};

MujocoLoop::MujocoLoop(const Manipulator&, std::shared_ptr<const Load>) {
  throw std::runtime_error("this was built without MuJoCo");
}

MujocoLoop::~MujocoLoop() = default;

Vector6d MujocoLoop::inverseDynamics(const Motion<double>&) {
  throw std::runtime_error("this was built without MuJoCo");
}

bool mujocoAvailable() { return false; }

std::string mujocoVersion() { return "none"; }

}  // namespace ursula
