#include "validation/mechanism/validate_mechanism.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "simbody/simbody_mechanism.h"
#include "validation/checks/judges.h"
#include "validation/checks/tolerance.h"
#include "validation/findings/findings.h"
#include "validation/verdict/effort_words.h"

namespace ursula {
namespace {

/// Instants of a picture that are smooth to the eye; fewer for many bodies, because a page holds all of their poses.
int instantsOfPicture(const Mechanism& mechanism) {
  return std::clamp(4000 / static_cast<int>(mechanism.bodies().size() + 1), 121, 301);
}

std::string listOf(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

/// The engines of the core: Simbody with two spanning trees.
MakeMechanismEngine simbodyEngine(SimbodyMechanism::Tree tree, const char* check, const char* voice) {
  return [tree, check, voice](const MechanismScenario& scenario) {
    auto loop = std::make_shared<SimbodyMechanism>(*scenario.mechanism, tree);
    auto out = std::make_unique<MechanismEngine>();
    out->check = check;
    out->voice = voice;
    out->engine = "Simbody";
    if (tree == SimbodyMechanism::Tree::other) out->placed = loop;
    out->efforts = [loop](const MotorMotion& motion) {
      loop->place(motion);
      return MotorEfforts(loop->inverseDynamics());
    };
    return out;
  };
}

/// Finds which voice contradicts the others, if one alone does.
OddOne oddOneOf(const MechanismEvidence& evidence, const std::vector<Check>& checks, const MechanismSubject& subject) {
  OddOne out;
  out.formulations = static_cast<int>(evidence.engines.size()) + 1 + (subject.isNoc() ? 0 : 1);
  std::vector<Voice> wrong;
  for (const MechanismEngine& engine : evidence.engines) {
    if (!fails(checks, engine.check)) continue;
    const auto same =
        std::find_if(wrong.begin(), wrong.end(), [&](const Voice& v) { return v.engine == engine.engine; });
    if (same == wrong.end())
      wrong.push_back({engine.engine, {engine.voice}});
    else
      same->formulations.push_back(engine.voice);
  }
  out.agree = wrong.empty() && !fails(checks, "torque.against_noc");
  if (out.agree) return out;
  std::set<std::string> engines;
  for (const MechanismEngine& engine : evidence.engines) engines.insert(engine.engine);
  const bool contradicts_noc = subject.isNoc() || fails(checks, "torque.against_noc");
  if (wrong.size() == engines.size() && contradicts_noc) {
    out.odd = {{"", {"the efforts under test"}}};
    if (engines.size() == 1 && subject.isNoc()) out.odd.push_back(wrong.front());
  } else if (wrong.size() == 1 && (!contradicts_noc || subject.isNoc())) {
    out.odd = wrong;
  }
  return out;
}

std::optional<EffortDeviation> deviationOf(const MechanismEvidence& evidence, const std::vector<Check>& checks) {
  EffortDeviation out;
  bool any = false;
  for (const Check& check : checks)
    if (isOf(check, "torque") && !std::isnan(check.largest.value)) takeLargest(check, any, out);
  if (!any) return std::nullopt;
  out.seen_for = evidence.cover.widest_gap;
  takeBetween(checks, out);
  out.unit = evidence.unit;
  out.largest_effort = evidence.largest;
  out.drift = std::nan("");
  out.duration = evidence.scenario->trajectory->duration();
  out.length = evidence.scenario->mechanism->length();
  return out;
}

/// Whether this check would have been made with more time.
bool wasLeft(const Check& check, const MechanismSubject& subject, const MechanismEvidence& evidence) {
  if (evidence.out_of_time.empty()) return false;
  const std::string& name = check.name;
  for (const MechanismEngine& engine : evidence.engines)
    if (engine.check == name) return true;
  if (name == "acceleration.pointwise" || name == "energy.power") return true;
  if (name == "torque.against_noc") return !subject.isNoc();
  if (name == "torque.between") return subject.given == nullptr;
  if (!subject.isNoc()) return false;
  for (const char* of : {"kinematics.positions", "kinematics.twists", "kinematics.accelerations", "direct.pointwise"})
    if (name == of) return true;
  return isOf(check, "complement") || (isOf(check, "invariance") && name != "invariance.engines") ||
         isOf(check, "replay") || isOf(check, "closure");
}

std::string whyNotOf(const CheckRow& row, const MechanismSubject& subject, const MechanismEvidence& evidence) {
  Check check;
  check.name = row.name;
  const std::string& name = check.name;
  const bool is_quick = subject.between == 0;
  if (is_quick && (name == "torque.between" || (subject.isNoc() && (isOf(check, "replay") || isOf(check, "closure")))))
    return "left out by the caller's options";
  if (!evidence.not_replayed.empty() && (isOf(check, "replay") || isOf(check, "closure"))) return evidence.not_replayed;
  if (wasLeft(check, subject, evidence)) return "";
  if (name == "energy.power") return "no motor moves where the loops can follow to both sides";
  if (name == "energy.balance") return "energy.power judges machines of this kind by their energies";
  for (const char* of_paths : {"feedback", "integration", "energy", "motion", "fast", "reactions"})
    if (isOf(check, of_paths)) return "not made for machines of this kind";
  if (name == "kinematics.joint_angles" || name == "kinematics.joint_rates" || name == "kinematics.joint_accelerations")
    return "the bodies' motion is compared instead";
  if (isOf(check, "kinematics") || name == "direct.off_path" || name == "invariance.engines")
    return subject.isNoc() ? "not made for machines of this kind" : "the subject gives efforts alone";
  if (row.needs == CheckNeeds::model_file) return "this build has no second reader of model files";
  if (row.needs == CheckNeeds::further_engine) return "this build has no such engine for machines of this kind";
  if (row.needs == CheckNeeds::torque_file) return "the efforts are the NOC's own";
  if (subject.isNoc()) return "not made for machines of this kind";
  if (subject.given) return "a file gives efforts alone, at its own instants";
  return "the subject gives efforts alone";
}

void addSeries(const MechanismEvidence& evidence, ValidationResult& result) {
  const Mechanism& mechanism = *evidence.scenario->mechanism;
  const auto column = [&](const std::string& name, const auto& value) {
    std::vector<double> values;
    for (const MechanismSample& sample : evidence.samples) values.push_back(value(sample));
    result.timeseries.add(name, std::move(values));
  };
  using S = MechanismSample;
  column("t_s", [](const S& s) { return s.motion.t; });
  const auto n = static_cast<Eigen::Index>(mechanism.motorCount());
  for (const auto& [quantity, member] :
       {std::pair("q", &MotorMotion::q), {"qdot", &MotorMotion::qdot}, {"qddot", &MotorMotion::qddot}})
    for (Eigen::Index k = 0; k < n; ++k)
      column(motorColumn(mechanism, k, quantity), [k, member = member](const S& s) { return (s.motion.*member)(k); });
  for (int k = 0; k < 3; ++k)
    column(fmt::format("output_{}_m", "xyz"[k]), [k](const S& s) { return s.output.translation()(k); });
  const auto efforts = [&](const std::string& prefix, const auto& of) {
    for (Eigen::Index k = 0; k < n; ++k)
      column(prefix + motorColumn(mechanism, k, "tau"), [k, &of](const S& s) { return of(s)(k); });
  };
  efforts("", [](const S& s) { return s.subject; });
  efforts("noc_", [](const S& s) { return s.noc; });
  if (!evidence.engines.empty()) efforts("simbody_", [](const S& s) { return s.engines.front(); });
  const bool newton = evidence.unit == "N";
  column(newton ? "error_tau_N" : "error_tau_Nm", [&](const S& s) {
    return (s.subject - (evidence.engines.empty() ? s.noc : s.engines.front()))
        .cwiseProduct(evidence.efforts_in)
        .cwiseAbs()
        .maxCoeff();
  });
  column(newton ? "limit_tau_N" : "limit_tau_Nm", [&](const S& s) {
    double least = 0;
    for (Eigen::Index k = 0; k < n; ++k)
      least = std::max(least, evidence.limit(s, k) + s.given(k) * evidence.efforts_in(k));
    return least;
  });
}

void addFacts(const MechanismAlong& along, const MechanismSubject& subject, const MechanismEvidence& evidence,
              ValidationResult& result) {
  const MechanismScenario& scenario = *evidence.scenario;
  const auto words = [&](const char* name, const std::string& text) { result.findings.push_back({name, text}); };
  words("odd one out of the formulations", inWords(result.odd_one));
  words("freedoms", fmt::format("{}, one for each motor", along.freedoms().freedoms));
  if (!along.freedoms().idle.empty())
    words("held at rest",
          listOf(along.freedoms().idleNames()) + ": a spin about the body's own line has no effect on any effort");
  double condition = 0, at = 0;
  for (const MechanismSample& sample : evidence.samples)
    if (sample.condition > condition) condition = sample.condition, at = sample.motion.t;
  result.findings.push_back({"largest condition number of the passive rates", "", condition, std::nan(""), "", at});
  for (const std::string& text : scenario.read.warnings) words("warning on reading the model", text);
  for (const std::string& text : scenario.read.assumptions) words("assumed on reading the model", text);
  if (along.solver().assemblyGap() > 1e-9)
    result.findings.push_back({"gap of the file's pose, of the machine's length, closed by least movement", "",
                               along.solver().assemblyGap()});
  if (const std::string moved = assemblyInWords(along.solver()); !moved.empty()) words("assembly", moved);
  if (subject.given && !subject.given->read_as.empty()) words("effort file read as", subject.given->read_as);
  if (subject.given && !subject.given->ignored.empty()) words("columns ignored", listOf(subject.given->ignored));
  if (!evidence.not_replayed.empty()) words("replay", "none: " + evidence.not_replayed);
  result.replay_windows = evidence.windows.size();
}

/// How often the subject is asked. A solver may be slow: at most 2,000 times, unless somebody wants it thorough.
MechanismSubject asAsked(MechanismSubject subject, const MechanismOptions& options) {
  constexpr int between_if_thorough = 8192, most_questions = 2000, for_terms = 30;
  if (subject.answers && options.thorough) subject.between = between_if_thorough;
  if (subject.answers && !options.thorough) subject.most_samples = most_questions - subject.between - for_terms;
  if (options.quick) subject.between = 0;
  return subject;
}

}  // namespace

ValidationResult validateMechanism(const MechanismScenario& read, const MechanismSubject& given,
                                   const MechanismOptions& options) {
  const MechanismSubject subject = asAsked(given, options);
  const Deadline deadline(options.time_limit, options.asked_to_end);
  const MechanismAlong along(read);
  const MechanismScenario& scenario = along.scenario();
  std::vector<MakeMechanismEngine> makers = {
      simbodyEngine(SimbodyMechanism::Tree::other, "torque.pointwise", "Simbody, other joints cut"),
      simbodyEngine(SimbodyMechanism::Tree::of_file, "torque.twin", "Simbody, the file's closures cut")};
  for (MakeMechanismEngine& each : partMechanismEngines()) makers.push_back(std::move(each));
  ValidationResult result = emptyResult(scenario, subject.about);
  result.mechanism = makePicture(scenario, along, instantsOfPicture(*scenario.mechanism));
  MechanismEvidence evidence;
  evidence.scenario = &scenario;
  try {
    const auto tell = [&](double share) {
      if (options.progress) options.progress(0.7 * share, "experiments");
    };
    evidence = gatherMechanism(scenario, along.motion(), subject, makers, deadline, tell);
    if (subject.isNoc() && !options.quick && evidence.out_of_time.empty()) {
      LoopWork work;
      replayMechanism([&](double t) { return along.motion().inverseDynamics(t, work); }, deadline, evidence);
    }
  } catch (const OutOfTime& over) {
    evidence.out_of_time = over.what();
  }
  if (scenario.tolerance)
    requireTellingTolerance(*scenario.tolerance, scenario.name, "effort", evidence.unit, evidence.largest);
  deadline.remove();
  result.checks = judgeMechanism(evidence, subject);
  if (partModelReading() != nullptr) result.checks.push_back(partModelReading()(scenario));
  result.odd_one = oddOneOf(evidence, result.checks, subject);
  result.deviation = deviationOf(evidence, result.checks);
  listEveryCheck([&](const CheckRow& check) { return whyNotOf(check, subject, evidence); }, evidence.out_of_time,
                 result);
  judgeByTolerance(scenario.tolerance, scenario.acceptance,
                   evidence.cover.isWhole() ? 0 : std::numeric_limits<double>::infinity(), result);
  judgeByUser(scenario.acceptance, result);
  addSeries(evidence, result);
  addFacts(along, subject, evidence, result);
  if (result.verdict == Verdict::fail && !subject.isNoc() && !onlyOddEngineFails(result)) {
    if (partMechanismCause() != nullptr) partMechanismCause()(scenario, evidence, result);
    if (evidence.out_of_time.empty()) result.size = failureSize(evidence, makers, result);
  }
  addEffortWords(result);
  return result;
}

}  // namespace ursula
