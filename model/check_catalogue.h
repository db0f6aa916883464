#pragma once

#include <string>
#include <vector>

namespace ursula {

/// What a check needs beside the scenario; without it, the check is not applicable.
enum class CheckNeeds {
  nothing,
  load_history,     ///< a load that varies over time
  kinematics,       ///< a subject that gives more than torques
  any_instant,      ///< torques at any instant, not only those of a file
  direct_dynamics,  ///< a subject that solves (36)
  other_machines,   ///< a subject that can be created for another machine
  own_reactions,    ///< a subject that computes the reactions at the joints
  own_complement,   ///< a subject that computes T and D
  further_engine,   ///< a build that has this formulation
  torque_file,      ///< torques that come from a file
  model_file,       ///< a machine that a model file describes
};

/// Checks that answer one question, in the order of reports.
enum class CheckGroup { motors, fast, replay, kinematics, numerics, input };

/// Where a check's limit comes from if the user gives none.
enum class LimitFrom {
  exact,     ///< equality, or a theorem
  derived,   ///< counted rounding and errors propagated along the motion
  measured,  ///< the same computation with inputs changed by one rounding, or at other steps or tolerances
};

/// The description of one check. `ursula explain`, reports and docs/checks.md are made from it. A family in
/// validation/checks/families.cpp names the check and judges it.
struct CheckRow {
  const char* name;
  const char* unit;
  CheckNeeds needs;
  CheckGroup group;
  /// Whose answers it compares with: "Simbody", "MuJoCo", …; null for another formulation of this program, the pose in
  /// 50 digits, or a property of the solver itself.
  const char* engine;
  const char* title;
  const char* proves;
  const char* cannot_see;  ///< what it cannot see; empty if there is nothing to say
  LimitFrom from;
  const char* limit;  ///< where it comes from, in words
  const char* on_failure;
};

/// Returns every check, in the order of results.
const std::vector<CheckRow>& checkCatalogue();

/// Returns the names of all checks.
std::vector<std::string> namesOfChecks();

/// Returns null if no check has that name.
const CheckRow* checkRow(const std::string& name);

/// Returns the check's title, or its name if the catalogue lacks it.
std::string checkTitle(const std::string& name);

/// Returns the questions, in the order of CheckGroup.
const std::vector<std::string>& checkGroups();

/// Returns an index into checkGroups(); its size if the catalogue lacks the check.
std::size_t groupOf(const std::string& check);

/// Returns "exact", "derived" or "measured".
const char* name(LimitFrom from);

/// These functions return the three parts of the catalogue, in the order of checkCatalogue().
std::vector<CheckRow> checksOfInput();
std::vector<CheckRow> checksOfTorques();
std::vector<CheckRow> checksOfReplay();

}  // namespace ursula
