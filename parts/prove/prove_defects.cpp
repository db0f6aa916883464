#include <fmt/format.h>

#include <set>
#include <stdexcept>

#include "base/errors.h"
#include "base/start_threads.h"
#include "model/check_catalogue.h"
#include "nocsolver/errors.h"
#include "parts/prove/defects.h"
#include "parts/prove/effect.h"
#include "parts/prove/prove.h"
#include "validation/checks/judges.h"
#include "validation/limits/further_engines.h"
#include "validation/validate.h"

namespace ursula {
namespace {

std::vector<std::string> failed(const std::vector<Check>& checks) {
  std::vector<std::string> out;
  for (const Check& check : checks)
    if (check.verdict == Verdict::fail) out.push_back(check.name);
  return out;
}

Subject right(const Scenario& scenario) { return nocSubject(*scenario.manipulator, scenario.load); }

/// One scenario, and the right solver's results for it.
class Proof {
 public:
  explicit Proof(const Scenario& scenario)
      : scenario_(scenario), right_answers_(scenario), reference_(makeReference(scenario)) {
    checks_ = validateMade(scenario_, right, options()).checks;
  }

  const std::vector<Check>& checks() const { return checks_; }

  DefectOutcome judge(const Defect& defect) const {
    DefectOutcome outcome{defect.name, defect.group, {}, defect.formulations_wanted, true, ""};
    try {
      const std::vector<Check> checks = defect.scenario ? inItsScenario(defect, outcome) : withIts(defect);
      outcome.caught_by = failed(checks);
      // A wrong solver also differs by rounding; a changed input or experiment differs only by its error.
      const bool rounds = defect.subject || (defect.scenario && movesAlike(defect.scenario(scenario_), scenario_));
      outcome.shows = !outcome.caught_by.empty() || sayOtherwise(checks, checks_, rounds ? 0.125 : 0.0);
      if (defect.subject) seeSubject(defect.subject(scenario_), outcome);
    } catch (const InvalidParameter& refusal) {
      outcome.refused = refusal.what();
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("defect \"{}\": {}", defect.name, error.what()));
    }
    return outcome;
  }

 private:
  ValidationOptions options() const {
    ValidationOptions out;
    out.budget = false;
    out.reference = reference_;
    return out;
  }

  void seeSubject(const Subject& subject, DefectOutcome& outcome) const {
    const RightAnswers::Off off = right_answers_.offIn(subject);
    outcome.shows = outcome.shows || off != RightAnswers::Off::nothing;
    // One formulation is enough for defects that keep the dynamics right, or that only other machines reveal (two
    // exchanged equal legs).
    if (off != RightAnswers::Off::dynamics && !outcome.caught()) outcome.formulations_wanted = 1;
  }

  std::vector<Check> withIts(const Defect& defect) const {
    ValidationOptions faulty = options();
    faulty.fault = std::make_shared<const InjectedFault>(defect.fault);
    return validateMade(scenario_, defect.subject ? defect.subject : right, faulty).checks;
  }

  /// Judges the commanded motion of a scenario that is refused as impossible.
  static std::vector<Check> judged(const Scenario& scenario, DefectOutcome& outcome) {
    ValidationOptions afresh;
    afresh.budget = false;
    try {
      return validate(scenario, afresh).checks;
    } catch (const PoseError& refusal) {
      outcome.refused = refusal.what();
      return judgeCommandedMotion(scenario);
    }
  }

  std::vector<Check> inItsScenario(const Defect& defect, DefectOutcome& outcome) const {
    return judged(defect.scenario(scenario_), outcome);
  }

  Scenario scenario_;
  RightAnswers right_answers_;
  std::shared_ptr<const Reference> reference_;
  std::vector<Check> checks_;
};

std::vector<CheckProof> proofsOf(const std::vector<Check>& checks, const std::vector<DefectOutcome>& outcomes) {
  std::vector<CheckProof> out;
  for (const Check& check : checks) {
    if (check.verdict == Verdict::not_applicable) continue;
    CheckProof proof{check.name, {}, {}};
    for (const DefectOutcome& outcome : outcomes) {
      if (outcome.caught_by.empty() || outcome.caught_by.front() != check.name) continue;
      (outcome.caught_by.size() == 1 ? proof.alone : proof.first).push_back(outcome.name);
    }
    out.push_back(proof);
  }
  return out;
}

}  // namespace

std::string engineOf(const std::string& check) {
  const CheckRow* row = checkRow(check);
  return row == nullptr || row->engine == nullptr ? check : row->engine;
}

int DefectOutcome::formulations() const {
  std::set<std::string> engines;
  for (const std::string& check : caught_by) engines.insert(engineOf(check));
  return static_cast<int>(engines.size());
}

DefectProof proveDefects(const Scenario& scenario, int jobs, const std::function<void(int)>& done) {
  const std::vector<Defect> defects = allDefects(*scenario.manipulator);
  const Proof proof(sampledForMany(scenario));
  std::vector<DefectOutcome> outcomes(defects.size());
  inParallel(jobs, static_cast<int>(defects.size()), [&](int k) {
    outcomes[k] = proof.judge(defects[k]);
    done(static_cast<int>(defects.size()));
  });
  DefectProof out;
  out.without_defect = failed(proof.checks());
  for (std::size_t k = 0; k < defects.size(); ++k) {
    if (!defects[k].control) {
      out.outcomes.push_back(std::move(outcomes[k]));
      continue;
    }
    ++out.controls;
    for (const std::string& check : outcomes[k].caught_by)
      out.without_defect.push_back(fmt::format("{} ({})", check, outcomes[k].name));
  }
  out.checks = proofsOf(proof.checks(), out.outcomes);
  return out;
}

}  // namespace ursula
