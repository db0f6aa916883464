#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/checks/judges.h"
#include "validation/mechanism/mechanism_evidence.h"

namespace ursula {
namespace {

/// Judges one kind of value over the samples.
class Judge {
 public:
  Judge(const MechanismEvidence& evidence) : evidence_(evidence), mechanism_(*evidence.scenario->mechanism) {}

  std::string motorName(int k) const { return k < 0 ? "" : mechanism_.motor(k).name; }

  /// Efforts of the subject against `theirs`, which returns null where there are none.
  template <class Theirs>
  Check efforts(const std::string& name, const std::string& what, const std::vector<MechanismSample>& samples,
                const Theirs& theirs, double level) const {
    WorstShare worst;
    CheckedQuantity of{name, evidence_.unit, evidence_.largest};
    of.seen = of.along = evidence_.largest;
    double condition = 1;
    for (const MechanismSample& sample : samples) {
      const MotorEfforts difference = sample.subject - theirs(sample);
      condition = std::max(condition, sample.condition);
      for (Eigen::Index k = 0; k < difference.size(); ++k) {
        const double in = evidence_.efforts_in(k);
        const double given = sample.given.size() > 0 ? sample.given(k) * in : 0;
        worst.add(std::abs(difference(k)) * in, evidence_.limit(sample, k, level) + given, sample.motion.t,
                  static_cast<int>(k));
        of.given = std::max(of.given, given);
      }
    }
    return shown(of, worst, fmt::format("{}, at {} instants", what, samples.size()), condition, true);
  }

  Check shown(const CheckedQuantity& of, const WorstShare& worst, const std::string& what, double condition,
              bool of_motor) const {
    if (!worst.any) return notMade(of.name, of.unit, "no instant was compared");
    const std::string basis = fmt::format(
        "eps x kappa(G_p)^2 x the terms that cancel x {:.3g}, what independent roundings add up to, and 10 times what "
        "one "
        "rounding of the inputs changes of the engine; there "
        "kappa(G_p) = {:.3g} at most",
        evidence_.level, condition);
    const auto place = [this, of_motor](int where) { return of_motor ? motorName(where) : std::string(); };
    ShownWords words{basis, what, nullptr, "passive joints hardly follow the motors (near a singular pose)"};
    if (of_motor) words.place = place;
    return judgedShown(of, worst, Units(), words);
  }

  /// A number of each sample that vanishes up to rounding of `size`.
  template <class Value, class Size>
  Check number(const std::string& name, const std::string& unit, const std::string& what, double times,
               const Value& value, const Size& size, bool of_motion) const {
    WorstShare worst;
    CheckedQuantity of{name, unit};
    of.seen = 0, of.along = 0, of.of_motion = of_motion;
    double condition = 1;
    for (const MechanismSample& sample : evidence_.samples) {
      const double own = size(sample);
      condition = std::max(condition, sample.condition);
      of.size = std::max(of.size, own);
      worst.add(
          value(sample),
          times * (evidence_.level + evidence_.levelOfSimbody()) * rounding * sample.condition * sample.condition * own,
          sample.motion.t);
    }
    of.seen = of.along = of.size;
    return shown(of, worst, fmt::format("{}, at {} instants", what, evidence_.samples.size()), condition, false);
  }

  const MechanismEvidence& evidence_;
  const Mechanism& mechanism_;
};

Check judgeAccelerations(const Judge& judge, const std::string& name, const std::string& what,
                         MotorEfforts MechanismSample::*ours,
                         const std::function<MotorEfforts(const MechanismSample&)>& theirs) {
  const MechanismEvidence& evidence = judge.evidence_;
  const double length = judge.mechanism_.length();
  WorstShare worst;
  CheckedQuantity of{name, "m/s^2"};
  double condition = 1;
  for (const MechanismSample& sample : evidence.samples) {
    const MotorEfforts difference = sample.*ours - theirs(sample);
    condition = std::max(condition, sample.condition);
    MotorEfforts response = (2 * evidence.level + evidence.acceleration_level) * evidence.response(sample);
    if (sample.given.size() > 0) response += sample.inverse_inertia.cwiseAbs() * sample.given;
    for (Eigen::Index k = 0; k < difference.size(); ++k) {
      const double in = judge.mechanism_.motor(k).slides() ? 1 : length;
      worst.add(std::abs(difference(k)) * in, response(k) * in, sample.motion.t, static_cast<int>(k));
      of.size = std::max({of.size, std::abs(sample.motion.qddot(k)) * in,
                          (sample.inverse_inertia * sample.noc).cwiseAbs().maxCoeff() * in});
      of.given =
          std::max(of.given, sample.given.size() > 0 ? (sample.inverse_inertia.cwiseAbs() * sample.given)(k)*in : 0);
    }
  }
  of.seen = of.along = of.size;
  return judge.shown(of, worst, what, condition, true);
}

std::vector<Check> judgeComplement(const Judge& judge) {
  std::vector<Check> out;
  out.push_back(judge.number(
      "complement.orthogonality", "1", "D T over T: what the joints hold fixed does not move", 1,
      [](const MechanismSample& s) { return s.across; }, [](const MechanismSample&) { return 1.0; }, false));
  int least = std::numeric_limits<int>::max();
  for (const MechanismSample& sample : judge.evidence_.samples) least = std::min(least, sample.rank);
  const auto motors = static_cast<int>(judge.mechanism_.motorCount());
  out.push_back(
      judged("complement.rank", std::abs(motors - least), 0, "1", "exact: as many columns as motors",
             fmt::format("rank {} of T for {} motors, at {} instants", least, motors, judge.evidence_.samples.size())));
  return out;
}

std::vector<Check> judgeKinematics(const Judge& judge) {
  using S = MechanismSample;
  const double length = judge.mechanism_.length();
  return {judge.number(
              "kinematics.positions", "m", "mass centres and orientations of all bodies against Simbody's", 1,
              [](const S& s) { return s.position; }, [length](const S&) { return length; }, false),
          judge.number(
              "kinematics.twists", "m/s", "twists of all bodies against Simbody's", 1,
              [](const S& s) { return s.twist; }, [](const S& s) { return s.twist_size; }, true),
          judge.number(
              "kinematics.accelerations", "m/s^2", "twist rates of all bodies against Simbody's", 2,
              [](const S& s) { return s.twist_rate; },
              [length](const S& s) { return s.twist_rate_size + s.twist_size * s.twist_size / length; }, true)};
}

Check judgeInvariance(const Judge& judge, const MechanismInvariance& invariance) {
  const MechanismEvidence& evidence = judge.evidence_;
  WorstShare worst;
  double condition = 1;
  for (const InvarianceSample& sample : invariance.samples)
    for (Eigen::Index k = 0; k < sample.difference.size(); ++k) {
      condition = std::max(condition, sample.condition);
      const double shape = rounding * sample.condition * sample.condition * sample.scale(k) * evidence.efforts_in(k);
      worst.add(std::abs(sample.difference(k)) * evidence.efforts_in(k),
                2 * (evidence.level + evidence.motion_level) * shape, sample.t, static_cast<int>(k));
    }
  CheckedQuantity of{invariance.check, evidence.unit, evidence.largest};
  of.seen = of.along = evidence.largest;
  return judge.shown(of, worst, fmt::format("the NOC's efforts, at {} instants", invariance.samples.size()), condition,
                     true);
}

std::vector<Check> judgeWindows(const Judge& judge) {
  struct Row {
    const char *name, *unit, *what;
    double MechanismWindow::*value, MechanismWindow::*limit;
    double size;
  };
  const double length = judge.mechanism_.length();
  const double speed = length / judge.evidence_.scenario->trajectory->duration();
  using W = MechanismWindow;
  const Row rows[] = {
      {"replay.position", "m", "the output body at the end of each window", &W::position, &W::position_limit, length},
      {"replay.orientation", "rad", "the output body at the end of each window", &W::orientation, &W::orientation_limit,
       1},
      {"closure.position", "m", "gaps of the cut joints", &W::closure_position, &W::closure_position_limit, length},
      {"closure.velocity", "m/s", "their rates", &W::closure_velocity, &W::closure_velocity_limit, speed}};
  std::vector<Check> out;
  for (const Row& row : rows) {
    if (!judge.evidence_.replay_diverged.empty()) {
      out.push_back(notJudgeable(Reason::not_covered, row.name, std::nan(""), std::nan(""), row.unit, "",
                                 judge.evidence_.replay_diverged));
      continue;
    }
    WorstShare worst;
    for (const W& window : judge.evidence_.windows) worst.add(window.*row.value, window.*row.limit, window.end);
    CheckedQuantity of{row.name, row.unit, row.size};
    out.push_back(judgedShown(
        of, worst, Units(),
        {"10 times what twice the steps and the rounding of efforts change of it",
         fmt::format("{}, {} windows in Simbody under the efforts", row.what, judge.evidence_.windows.size()), nullptr,
         "deviations grow within a window"}));
  }
  return out;
}

Check judgePower(const MechanismEvidence& evidence) {
  WorstShare worst;
  CheckedQuantity of{"energy.power", "W"};
  of.of_motion = true;
  for (const MechanismPower& power : evidence.powers) {
    worst.add(power.error, power.limit, power.t);
    of.size = std::max(of.size, power.size);
    of.given = std::max(of.given, power.given);
  }
  of.seen = of.along = of.size;
  return judgedShown(
      of, worst, Units(),
      {"the efforts' limits times the rates, rounding of the energies over the step, and what "
       "half the step changes of their differences",
       fmt::format("the motors' power against Simbody's energies and losses, at {} instants", evidence.powers.size()),
       nullptr, "the energies change too quickly near a singular pose"});
}

/// What lies between the rows of a file, or beyond them, is not judged.
Check judgeCover(const MechanismEvidence& evidence) {
  const Cover& cover = evidence.cover;
  const double duration = evidence.scenario->trajectory->duration();
  const std::string why = cover.is_cut ? fmt::format("the rows cover {:.6g} to {:.6g} s of a motion from 0 to {:.6g} s",
                                                     cover.begin, cover.end, duration)
                                       : fmt::format(
                                             "the rows are up to {:.6g} s apart; rows so far apart tell no more of the "
                                             "efforts between than their mean does",
                                             cover.widest_gap);
  return notJudgeable(Reason::not_covered, "torque.between", std::nan(""), std::nan(""), evidence.unit, "", why);
}

}  // namespace

std::vector<Check> judgeMechanism(const MechanismEvidence& evidence, const MechanismSubject& subject) {
  std::vector<Check> out;
  if (evidence.samples.empty()) return out;
  const Judge judge(evidence);
  using S = MechanismSample;
  for (std::size_t e = 0; e < evidence.engines.size(); ++e)
    out.push_back(judge.efforts(
        evidence.engines[e].check, "efforts against " + evidence.engines[e].voice, evidence.samples,
        [e](const S& s) { return s.engines[e]; }, evidence.engines[e].level));
  if (!subject.isNoc())
    out.push_back(judge.efforts(
        "torque.against_noc", "efforts against the NOC", evidence.samples, [](const S& s) { return s.noc; }, 0));
  if (!evidence.between.empty()) {
    Check between = judge.efforts(
        "torque.between",
        subject.isNoc() ? "the NOC against Simbody between the samples" : "answers against the NOC between the samples",
        evidence.between, [](const S& s) { return s.noc; }, subject.isNoc() ? evidence.levelOfSimbody() : 0);
    between.gap = 2 * evidence.scenario->trajectory->duration() / static_cast<double>(evidence.between.size());
    out.push_back(between);
  }
  if (!evidence.cover.isWhole()) out.push_back(judgeCover(evidence));
  out.push_back(judgeAccelerations(judge, "acceleration.pointwise",
                                   "accelerations of the motors in Simbody under the efforts, commanded state",
                                   &S::acceleration, [](const S& s) { return s.motion.qddot; }));
  if (!evidence.powers.empty()) out.push_back(judgePower(evidence));
  if (subject.isNoc()) {
    out.push_back(judgeAccelerations(judge, "direct.pointwise", "direct dynamics (36) against Simbody's, same efforts",
                                     &S::direct, [](const S& s) { return s.acceleration; }));
    for (Check& check : judgeComplement(judge)) out.push_back(std::move(check));
    for (Check& check : judgeKinematics(judge)) out.push_back(std::move(check));
    for (const MechanismInvariance& each : evidence.invariances) out.push_back(judgeInvariance(judge, each));
  }
  if (!evidence.windows.empty() || !evidence.replay_diverged.empty())
    for (Check& check : judgeWindows(judge)) out.push_back(std::move(check));
  return out;
}

}  // namespace ursula
