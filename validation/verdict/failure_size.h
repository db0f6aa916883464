#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ursula {

struct ValidationResult;

/// What wrong efforts may come from, by their size alone. In the order of their names.
enum class FailureGrade {
  rounding,   ///< another order of operations, or few digits
  modelling,  ///< another idealisation of the machine: no term of its equations is missing as a whole
  wrong
};
/// "rounding", "modelling" or "wrong".
const char* name(FailureGrade grade);

/// A key of the scenario with another value.
struct ScenarioChange {
  std::string key, value;  ///< "manipulator.leg_defaults.spin", "free"
};

/// How large wrong efforts are, and what would make them right. Shares are of the motion's largest effort.
struct FailureSize {
  FailureGrade grade = FailureGrade::wrong;
  double limits = std::numeric_limits<double>::infinity();  ///< the largest error, in multiples of its limit
  double rounding = 1;     ///< where one more factor of the condition number stands, in multiples of the limit
  std::string least_term;  ///< of the machine's equations; empty for none
  double least_share = std::numeric_limits<double>::infinity();  ///< its largest effect
  std::vector<ScenarioChange> remedy;  ///< with all of them the efforts are right, as was evaluated; empty for none
};

/// One term of a machine's equations, or one way to idealise the machine.
struct ModelTerm {
  std::string name;                  ///< "gravity", "spin"
  std::vector<double> efforts = {};  ///< what it adds to the right efforts, one number for each motor and instant
  std::vector<ScenarioChange> left_out = {};  ///< the scenario without it; empty if no key says so
  bool is_all = false;                        ///< leaves nothing of the others that have keys
};

/// The judged efforts, one number for each motor and instant, all in one unit.
struct JudgedEfforts {
  std::vector<double> residual;   ///< given less right
  std::vector<double> limits;     ///< of rounding and digits
  std::vector<double> condition;  ///< a solver that squares the condition number rounds so many times more
  double largest = 0;             ///< effort of the motion
  double allowed = 0;             ///< by a user's tolerance
};

/// Whether the efforts are right if the scenario has these changes.
using AreRight = std::function<bool(const std::vector<ScenarioChange>&)>;

/// Grades wrong efforts: within `condition` times their limits it is rounding, as are few digits. It is a modelling
/// difference below the least term with an effect, or if the efforts are right without some terms that the scenario can
/// leave out. The result has the cause and `torque.between`. Returns nullopt if no effort is beyond its limit.
std::optional<FailureSize> sizeOf(JudgedEfforts efforts, const std::vector<ModelTerm>& terms,
                                  const ValidationResult& result, const AreRight& are_right);

}  // namespace ursula
