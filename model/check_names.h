#pragma once

#include <string>
#include <vector>

namespace ursula {

/// What a check needs beside the scenario; where that is not there, the check is not applicable.
enum class CheckNeeds {
  nothing,
  load_history,     ///< a load that varies over time
  kinematics,       ///< a subject that says more than torques
  any_instant,      ///< torques at any instant, not those of a file alone
  direct_dynamics,  ///< a subject that solves (36)
  other_machines,   ///< a subject that can be made for another machine
  own_reactions,    ///< a subject that finds the reactions at the joints
  own_complement,   ///< a subject that forms T and D
  further_engine,   ///< a build that has this formulation
  torque_file,      ///< torques that come from a file
};

/// One check of those that a result lists.
struct CheckName {
  const char* name;
  const char* unit;
  CheckNeeds needs;
};

/// Every check, in the order in which results list them.
const std::vector<CheckName>& checkNames();

/// Their names alone.
std::vector<std::string> namesOfChecks();

}  // namespace ursula
