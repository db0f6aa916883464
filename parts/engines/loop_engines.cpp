#include <dlfcn.h>

#include <stdexcept>

#include "parts/engines/loop_engine.h"
#include "parts/engines/mujoco/mujoco_loop.h"
#include "parts/engines/voting_engines.h"
#include "simbody/simbody_loop.h"

namespace ursula {
namespace {

constexpr char dart[] = "ursula_dart.so";

/// Returns null if the module is not beside the program, or if its engine is not installed.
template <const char* file>
const EngineModule* module() {
  static const EngineModule* const found = [] {
    void* library = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
    return library == nullptr ? nullptr : static_cast<const EngineModule*>(::dlsym(library, "ursula_engine_module"));
  }();
  return found;
}

template <const char* file>
bool moduleAvailable() {
  return module<file>() != nullptr;
}

template <const char* file>
std::string moduleVersion() {
  return moduleAvailable<file>() ? module<file>()->version : "none";
}

template <const char* file>
std::unique_ptr<LoopEngine> makeByModule(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  if (!moduleAvailable<file>()) throw std::runtime_error(std::string(file) + " is not there");
  return module<file>()->make(manipulator, std::move(load));
}

}  // namespace

const std::vector<LoopEngineKind>& loopEngines() {
  static const std::vector<LoopEngineKind> table = {
      {"Simbody", "", alwaysAvailable, simbodyVersion, makeSimbodyCalls, Recipe::open,
       "take calcResidualForceIgnoringConstraints at accelerations that satisfy calcBiasForAccelerationConstraints, "
       "and solve for the motors beside the multipliers of calcGTranspose",
       "calcResidualForceIgnoringConstraints, read at the motors,", false},
      {"maximal coordinates", "", alwaysAvailable, [] { return std::string(); }, makeMaximalCalls, Recipe::no_bias,
       "solve Gᵀλ + Sτ = Mṫ + bias − w at twist rates of Gṫ = γ", "the same with γ left out", false},
      {"MuJoCo", "libmujoco-dev", mujocoAvailable, mujocoVersion, makeMujocoCalls, Recipe::own_inverse,
       "take mj_rne with armature · q̈ at accelerations that close the loops (mj_rnePostConstraint, "
       "mj_objectAcceleration), and solve for the motors beside the multipliers of mj_jacSite's rows",
       "mj_inverse with the equality constraints at their default softness, read at the motors,", true},
      {"DART", "libdart-dev", moduleAvailable<dart>, moduleVersion<dart>, makeByModule<dart>, Recipe::open,
       "take computeInverseDynamics at accelerations that close the loops (getLinearAcceleration of the points), and "
       "solve for the motors beside the multipliers of getLinearJacobian's rows",
       "computeInverseDynamics, read at the motors,", false},
  };
  return table;
}

}  // namespace ursula
