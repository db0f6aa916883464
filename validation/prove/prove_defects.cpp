#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "model/errors.h"
#include "model/loops/further_roads.h"
#include "nocsolver/errors.h"
#include "validation/checks/commanded_motion.h"
#include "validation/prove/defects.h"
#include "validation/prove/prove.h"
#include "validation/validate.h"

namespace ursula {
namespace {

bool equal(const JointVariables<double>& a, const JointVariables<double>& b) {
  return a.phi == b.phi && a.psi == b.psi && a.theta == b.theta && a.d == b.d;
}

bool equal(const KinematicAnswer& a, const KinematicAnswer& b) {
  for (std::size_t i = 0; i < body_count; ++i)
    if (a.bodies[i].c != b.bodies[i].c || a.bodies[i].R != b.bodies[i].R || a.bodies[i].twist != b.bodies[i].twist ||
        a.bodies[i].twist_rate != b.bodies[i].twist_rate)
      return false;
  return equal(a.joints.q, b.joints.q) && equal(a.joints.q_dot, b.joints.q_dot) &&
         equal(a.joints.q_ddot, b.joints.q_ddot) && a.T == b.T && a.T_rate == b.T_rate;
}

bool equal(const Subject& a, const Subject& b, const Motion<double>& motion) {
  const Vector6d torques = b.torques(motion);
  return a.torques(motion) == torques && equal(a.kinematics(motion), b.kinematics(motion)) &&
         a.accelerations(motion, torques) == b.accelerations(motion, torques);
}

/// True where an answer differs in any bit from the right solver's, at instants that are no samples of anything.
bool answersDiffer(const Scenario& scenario, const Subject& subject) {
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  constexpr int instants = 31;
  for (int k = 0; k < instants; ++k) try {
      const double t = scenario.trajectory->duration() * (k + 0.37) / instants;
      if (!equal(subject, right, scenario.trajectory->at(t))) return true;
    } catch (const PoseError&) {
      return true;
    }
  return false;
}

bool sameValues(const std::vector<Check>& a, const std::vector<Check>& b) {
  const auto same = [](const Check& one, const Check& other) {
    const bool both_nan = std::isnan(one.value) && std::isnan(other.value);
    return one.name == other.name && one.verdict == other.verdict && (one.value == other.value || both_nan);
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

std::vector<std::string> failed(const std::vector<Check>& checks) {
  std::vector<std::string> out;
  for (const Check& check : checks)
    if (check.verdict == Verdict::fail) out.push_back(check.name);
  return out;
}

Subject right(const Scenario& scenario) { return nocSubject(*scenario.manipulator, scenario.load); }

/// One scenario, and what the right solver makes of it.
class Proof {
 public:
  explicit Proof(const Scenario& scenario) : scenario_(scenario), reference_(makeReference(scenario)) {
    checks_ = validateMade(scenario_, right, options()).checks;
  }

  const std::vector<Check>& checks() const { return checks_; }

  DefectOutcome judge(const Defect& defect) const {
    DefectOutcome outcome{defect.name, defect.group, {}, defect.roads, true, ""};
    try {
      const std::vector<Check> checks = defect.scenario ? inItsScenario(defect, outcome) : withIts(defect);
      outcome.caught_by = failed(checks);
      outcome.shows =
          !sameValues(checks, checks_) || (defect.subject && answersDiffer(scenario_, defect.subject(scenario_)));
    } catch (const InvalidParameter& refusal) {
      outcome.refused = refusal.what();
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

  std::vector<Check> withIts(const Defect& defect) const {
    ValidationOptions spoilt = options();
    spoilt.spoil = std::make_shared<const Spoil>(defect.spoil);
    return validateMade(scenario_, defect.subject ? defect.subject : right, spoilt).checks;
  }

  /// A motion that cannot be made is refused, but judged all the same for what it is.
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

std::string roadOf(const std::string& check) {
  if (const RoadKind* further = furtherRoadOf(check)) return further->engine;
  const auto begins = [&check](const char* with) { return check.rfind(with, 0) == 0; };
  // Against the solver's own formulas, the pose in 50 digits, a second reading.
  const bool alone = check == "kinematics.jacobian_difference" || check == "torque.between";
  if (alone || begins("invariance.") || begins("motion.")) return check;
  return "Simbody";
}

int DefectOutcome::roads() const {
  std::set<std::string> roads;
  for (const std::string& check : caught_by) roads.insert(roadOf(check));
  return static_cast<int>(roads.size());
}

DefectProof proveDefects(const Scenario& scenario, int jobs, const std::function<void(int)>& done) {
  const std::vector<Defect> defects = allDefects(*scenario.manipulator);
  const Proof proof(sampledForMany(scenario));
  DefectProof out;
  out.outcomes.resize(defects.size());
  inParallel(jobs, static_cast<int>(defects.size()), [&](int k) {
    out.outcomes[static_cast<std::size_t>(k)] = proof.judge(defects[static_cast<std::size_t>(k)]);
    done(static_cast<int>(defects.size()));
  });
  out.checks = proofsOf(proof.checks(), out.outcomes);
  out.without_defect = failed(proof.checks());
  return out;
}

}  // namespace ursula
