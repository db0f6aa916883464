#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "studies/random/random_kind.h"
#include "validation/verdict/result.h"

namespace ursula {

/// What the validation said of one defect.
struct DefectOutcome {
  std::string name, group;
  std::vector<std::string> caught_by;  ///< names of the checks that failed, in the order of the result
  int formulations_wanted = 2;         ///< as Defect::formulations
  bool shows = true;                   ///< false where the scenario gives the defect nothing to change
  std::string refused;                 ///< why there was nothing to validate: no machine or no motion can be so

  int engines() const;  ///< on which it was caught
  bool caught() const { return !refused.empty() || engines() >= formulations_wanted; }
};

/// Of one check: what it alone catches, and what it catches first of all in the order of the result.
struct CheckProof {
  std::string check;
  std::vector<std::string> alone, first;
};

struct DefectProof {
  std::vector<DefectOutcome> outcomes;
  std::vector<CheckProof> checks;  ///< every check that the scenario's result has
  /// Checks that fail the right solver, or a mechanism that injects nothing: then nothing is proved.
  std::vector<std::string> without_defect;
  int controls = 0;  ///< mechanisms that were tried without a defect
};

/// What a check compares with: "Simbody" in either topology, "maximal coordinates", "MuJoCo", or itself where it needs
/// none of them.
std::string engineOf(const std::string& check);

/// The smallest relative error of one parameter that `torque.pointwise` still fails.
struct Sensitivity {
  std::string parameter, group;
  double smallest_caught = 0;  ///< relative; infinite where not even 0.1 shows
  double torque_change = 0;    ///< the change of torque at that error, relative to the largest torque
};

struct RandomOutcomes {
  int runs = 0, passed = 0;
  std::vector<std::string> failed, inconclusive;  ///< seed, worst check and why
  std::map<std::string, double> largest_share;    ///< of its limit that a check's value reached, by its name
};

/// Every defect of allDefects() in turn, judged by the whole validation. Order and content do not depend on `jobs`.
DefectProof proveDefects(const Scenario& scenario, int jobs, const std::function<void(int)>& done);

/// With few samples, for one of many validations: enough for three a step of the replay.
Scenario sampledForMany(Scenario scenario);

/// By bisection of the exponent, to one in a hundred.
std::vector<Sensitivity> proveSensitivities(const Scenario& scenario);

/// The other direction: `count` random valid scenarios from `seed` on; none may fail.
RandomOutcomes proveRandom(std::uint64_t seed, int count, int jobs, const std::function<void(int)>& done,
                           RandomKind kind = RandomKind::URS);

}  // namespace ursula
