#include "engines/further_engines.h"
#include "engines/loop_engine.h"
#include "engines/mujoco/mujoco_loop.h"

namespace ursula {

const std::vector<LoopEngineKind>& loopEngines() {
  static const std::vector<LoopEngineKind> table = {
      {"Simbody", "", alwaysAvailable, simbodyVersion, makeSimbodyCalls, Recipe::open,
       "take calcResidualForceIgnoringConstraints at accelerations that satisfy calcBiasForAccelerationConstraints, "
       "and "
       "solve for the motors beside the multipliers of calcGTranspose",
       "calcResidualForceIgnoringConstraints, read at the motors,", false},
      {"maximal coordinates", "", alwaysAvailable, [] { return std::string(); }, makeMaximalCalls, Recipe::no_bias,
       "solve Gᵀλ + Sτ = Mṫ + bias − w at twist rates of Gṫ = γ", "the same with γ left out", false},
      {"MuJoCo", "libmujoco-dev", mujocoAvailable, mujocoVersion, makeMujocoCalls, Recipe::own_inverse,
       "take mj_rne with armature · q̈ at accelerations that close the loops (mj_rnePostConstraint, "
       "mj_objectAcceleration), and solve for the motors beside the multipliers of mj_jacSite's rows",
       "mj_inverse with the equality constraints at their default softness, read at the motors,", true},
      {"DART", "libdart-dev", dartCallsAvailable, dartVersion, makeDartCalls, Recipe::open,
       "take computeInverseDynamics at accelerations that close the loops (getLinearAcceleration of the points), and "
       "solve for the motors beside the multipliers of getLinearJacobian's rows",
       "computeInverseDynamics, read at the motors,", false},
  };
  return table;
}

}  // namespace ursula
