// Stands in for the formulation if MuJoCo is missing at build time.

#include <stdexcept>

#include "parts/engines/closed_mechanism.h"
#include "parts/engines/loop_engine.h"
#include "parts/engines/mujoco/mujoco_loop.h"
#include "parts/engines/mujoco/mujoco_reading.h"

namespace ursula {
namespace {

[[noreturn]] void throwAbsent() { throw std::runtime_error("this was built without MuJoCo"); }

}  // namespace

struct MujocoLoop::Impl {};

MujocoLoop::MujocoLoop(const Manipulator&, std::shared_ptr<const Load>) { throwAbsent(); }

MujocoLoop::~MujocoLoop() = default;

Vector6d MujocoLoop::inverseDynamics(const Motion<double>&) { throwAbsent(); }

bool mujocoAvailable() { return false; }

std::string mujocoVersion() { return "none"; }

std::unique_ptr<Engine> makeMujocoLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<MujocoLoop>(manipulator, std::move(load));
}

BuiltTree buildMujoco(const Mechanism&, const WeldedMechanism&) { throwAbsent(); }

ReadingDifference readByMujoco(const std::filesystem::path&, const MechanismParameters&, const ReadingChoices&) {
  throwAbsent();
}

std::unique_ptr<LoopEngine> makeMujocoCalls(const Manipulator&, std::shared_ptr<const Load>) { throwAbsent(); }

}  // namespace ursula
