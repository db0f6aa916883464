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

/// Checks that answer one question together, in the order in which reports list them.
enum class CheckGroup { motors, fast, replay, kinematics, numerics, input };

/// What a subject is held against.
enum class StandsOn {
  engine,  ///< Simbody, or the further engine that has the check
  itself,  ///< no engine: the solver's own formulas, the pose in 50 digits, a second reading
};

/// Where a check's limit comes from, unless the user gives one.
enum class LimitFrom {
  exact,     ///< equality, or what a theorem gives
  derived,   ///< rounding counted, errors carried along the motion
  measured,  ///< the same computation in other changes of frame, at other steps or tolerances
};

/// All there is to say about one check. `ursula explain`, reports and docs/checks.md are made of it; what judges it is
/// the family of validation/checks/families.cpp that names it.
struct CheckRow {
  const char* name;
  const char* unit;
  CheckNeeds needs;
  CheckGroup group;
  StandsOn stands_on;
  const char* title;
  const char* meaning;     ///< what it shows, in a line
  const char* proves;      ///< the same at length
  const char* cannot_see;  ///< empty where nothing need be said
  LimitFrom from;
  const char* limit;  ///< where it comes from, in words
  const char* on_failure;
};

/// Every check, in the order in which results list them.
const std::vector<CheckRow>& checkCatalogue();

/// Their names alone.
std::vector<std::string> namesOfChecks();

/// Null for a name that no check has.
const CheckRow* checkRow(const std::string& name);

/// What people call a check; its name where it is not of the catalogue.
std::string checkTitle(const std::string& name);

/// The questions, by CheckGroup.
const std::vector<std::string>& checkGroups();

/// Index into checkGroups(); its size for a check that is not of the catalogue.
std::size_t groupOf(const std::string& check);

/// "exact", "derived" or "measured".
const char* name(LimitFrom from);

}  // namespace ursula
