#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "parts/random/random_recipe.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The result of the validation with one defect.
struct DefectOutcome {
  std::string name, group;
  std::vector<std::string> caught_by;  ///< names of the failed checks, in the order of the result
  int formulations_wanted = 2;         ///< as in Defect
  bool shows = true;                   ///< false if the defect changes nothing in this scenario
  std::string refused;                 ///< why nothing could be validated: an impossible machine or motion

  int formulations() const;  ///< number of formulations that caught it
  bool caught() const { return !refused.empty() || formulations() >= formulations_wanted; }
};

/// The defects that one check alone catches, and those that it catches first in the order of the result.
struct CheckProof {
  std::string check;
  std::vector<std::string> alone, first;
};

struct DefectProof {
  std::vector<DefectOutcome> outcomes;
  std::vector<CheckProof> checks;  ///< every check of the scenario's result
  /// Checks that fail the right solver, or a mechanism without a defect; then nothing is proved.
  std::vector<std::string> without_defect;
  int controls = 0;  ///< number of mechanisms that were tried without a defect
};

/// Returns what a check compares with: "Simbody" in either topology, "maximal coordinates", "MuJoCo", or the check
/// itself if it needs none.
std::string engineOf(const std::string& check);

/// The smallest relative error of one parameter at which `torque.pointwise` fails.
struct Sensitivity {
  std::string parameter, group;
  double smallest_caught = 0;  ///< relative; infinite if even 0.1 passes
  double torque_change = 0;    ///< torque change at that error, relative to the largest torque; NaN if it was refused
};

struct RandomOutcomes {
  int runs = 0, passed = 0;
  std::vector<std::string> failed, inconclusive;  ///< seed, worst check and reason
  std::map<std::string, double> largest_share;    ///< by check: the largest share of its limit
};

/// Validates every defect of allDefects() in turn. Order and content do not depend on `jobs`.
DefectProof proveDefects(const Scenario& scenario, int jobs, const std::function<void(int)>& done);

/// Returns the scenario with samples for one run among many: about three for each step of the replay.
Scenario sampledForMany(Scenario scenario);

/// Finds the smallest caught error of every parameter, to one in a hundred.
std::vector<Sensitivity> proveSensitivities(const Scenario& scenario);

/// Makes the reverse test: `count` random valid scenarios from `seed` on, of which none may fail.
RandomOutcomes proveRandom(std::uint64_t seed, int count, int jobs, const std::function<void(int)>& done,
                           RandomKind kind = RandomKind::URS);

/// Names the worst check of the scenario from `seed`: "seed 3: torque.pointwise 2 of 1 N m: leg 2".
std::string worstText(std::uint64_t seed, const std::vector<Check>& checks);

/// Returns the number of effective defects that too few formulations caught.
int weakDefects(const std::vector<DefectOutcome>& outcomes);

/// Returns whether the check catches a defect alone or first.
inline bool isNeeded(const CheckProof& proof) { return !proof.alone.empty() || !proof.first.empty(); }

/// Returns the defects that the check catches alone, else those that it catches first; of more than `most`, their
/// number.
std::string caughtBy(const CheckProof& proof, std::size_t most);

/// Returns the number of checks that are not needed, because earlier ones catch everything that they do.
int idleChecks(const std::vector<CheckProof>& checks);

/// Returns every check that caught anything, in the order of its first catch.
std::vector<std::string> catchingChecks(const std::vector<DefectOutcome>& outcomes);

/// The sensitivities of one kind of parameter.
struct SensitivityGroup {
  std::string name;
  int count = 0, unseen = 0;
  Sensitivity worst;          ///< the worst of those caught
  double smallest = 1;        ///< relative error that is caught
  double largest_change = 0;  ///< largest torque change, relative to the largest torque, at the smallest caught error
};
std::vector<SensitivityGroup> groupsOf(const std::vector<Sensitivity>& sensitivities);

/// All results of `ursula prove`.
struct ProveResult {
  std::string scenario;
  std::optional<DefectProof> proof;  ///< nullopt if only random scenarios were tried
  std::vector<Sensitivity> sensitivities;
  RandomOutcomes random;
  std::uint64_t seed = 0;  ///< seed of the first random scenario
};

/// Returns whether the right solver passes, every defect is caught, every check is needed and no random scenario fails.
bool isProved(const ProveResult& found);

/// Returns a page in the report's style: defects by checks, the need for each check, thresholds, random scenarios.
std::string proveHtml(const ProveResult& found);

/// The built-in scenarios/proving-ground.toml, into which `ursula prove` injects defects.
Scenario provingGround();

}  // namespace ursula
