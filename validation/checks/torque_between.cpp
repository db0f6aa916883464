#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <algorithm>

#include "nocsolver/errors.h"
#include "simbody/simbody_loop.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/asked_instants.h"

namespace ursula {
namespace {

constexpr const char* check_name = "torque.between";

/// Instants of the first round; a quarter more follow where the torques curve. On the paper's motion of 3 s this
/// spacing meets a pulse of 1 ms more than once.
constexpr int least_instants = 8192;
/// Instants per unit of time of the scenario, so that a long motion has no wider gaps than a short one.
constexpr double instants_per_time = 600;
/// More instants than this would take seconds.
constexpr int most_instants = 65536;

/// Simbody's efforts as a subject, with which the NOC is compared.
Subject simbodySubject(const Scenario& scenario) {
  const auto loop =
      std::make_shared<SimbodyLoop>(*scenario.manipulator, SimbodyLoop::Topology::ball_per_leg, scenario.load);
  Subject subject;
  subject.torques = [loop](const Motion<double>& motion) {
    loop->place(motion);
    return loop->inverseDynamics();
  };
  return subject;
}

/// The smaller limit of the two samples beside t. Most instants stay within it and need no limit of their own.
class SampledTorqueLimit {
 public:
  explicit SampledTorqueLimit(const std::vector<PointwiseSample>& samples) : samples_(samples) {}
  double at(double t) const {
    const std::size_t i = indexFrom(samples_, t);
    return std::min(limitOf(i), limitOf(i == 0 ? 0 : i - 1));
  }

 private:
  double limitOf(std::size_t i) const { return samples_[i].conditioning.torqueRounding(); }
  const std::vector<PointwiseSample>& samples_;
};

class Comparison {
 public:
  Comparison(const Scenario& scenario, Formulation judged, const std::vector<PointwiseSample>& samples,
             const RoundingProfile& profile)
      : trajectory_(*scenario.trajectory),
        other_(judged == Formulation::noc ? simbodySubject(scenario)
                                          : nocSubject(*scenario.manipulator, scenario.load)),
        limit_(samples),
        profile_(profile),
        look_(profile) {}

  void add(const Answered& answer) {
    const double t = answer.t;
    const Motion<double> motion = trajectory_.at(t);
    const Vector6d expected = other_.torques(motion);
    Eigen::Index leg = 0;
    const double error = (answer.torques - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(&leg);
    double limit = limit_.at(t);
    // A limit of its own is expensive, so an instant gets one only if it could decide.
    const bool decided =
        worst_.beyond() && WorstShare::share(error, limit) <= WorstShare::share(worst_.value, worst_.limit);
    if (!(error <= limit) && !decided) {
      const Conditioning here = profile_.at(motion);
      limit = look_.limit(error, here, Rounded::torque, motion);
    }
    worst_.add(error, limit, t, static_cast<int>(leg));
    size_ = std::max(size_, expected.cwiseAbs().maxCoeff());
  }

  const WorstShare& worst() const { return worst_; }
  double size() const { return size_; }  ///< of the expected torques

 private:
  const Trajectory& trajectory_;
  Subject other_;  ///< uses another formulation than the subject
  SampledTorqueLimit limit_;
  const RoundingProfile& profile_;
  RemeasuredLimits look_;
  WorstShare worst_;
  double size_ = 0;
};

double widestGap(const std::vector<Answered>& in_order, double duration) {
  double gap = 0, before = 0;
  for (const Answered& answer : in_order) {
    gap = std::max(gap, answer.t - before);
    before = answer.t;
  }
  return std::max(gap, duration - before);
}

/// `what` says what was compared.
Check checkOf(const Comparison& comparison, const std::string& what, double gap,
              const std::vector<PointwiseSample>& samples, double along, const Units& units) {
  const WorstShare& worst = comparison.worst();
  const double seen = comparison.size();
  const CheckedQuantity quantity{check_name, units.efforts.unit, std::max(seen, along), 0, seen, along};
  Check check = judgedShown(
      quantity, worst, units,
      {"as for torque.pointwise, at each instant", what, motorsOf(units), causeOfRounding(samples, worst.widest_t),
       fmt::format("; a pulse longer than {:.2g} s and larger than {:.2g} {} would have been seen", gap * units.time,
                   std::min(worst.widest_limit, quantity.useful()) * units.effort(), units.efforts.unit)});
  check.gap = gap * units.time;
  return check;
}

}  // namespace

Check judgeBetween(const Scenario& scenario, const Subject& subject, const std::vector<PointwiseSample>& samples,
                   const RoundingProfile& profile, const Units& units) {
  if (samples.empty()) return notMade(check_name, units.efforts.unit, "no instant was compared");
  const double duration = scenario.trajectory->duration();
  const int count =
      std::clamp(static_cast<int>(std::min(instants_per_time * duration, 1e9)), least_instants, most_instants);
  Comparison comparison(scenario, subject.formulation, samples, profile);
  std::vector<Answered> instants;
  const auto ask = [&](const std::vector<double>& at) {
    foresee(subject, *scenario.trajectory, at);
    for (double t : at) {
      instants.push_back({t, subject.torques(scenario.trajectory->at(t))});
      comparison.add(instants.back());
    }
  };
  try {
    ask(goldenInstants(duration, count));  // not in time order, so that large deviations appear early
    sortByTime(instants);
    ask(curvedInstants(instants, (instants.size() - 2) / 4));
  } catch (const PoseError& error) {
    return notMade(check_name, units.efforts.unit, std::string("no answer: ") + error.what());
  }
  sortByTime(instants);
  const char* other = subject.formulation == Formulation::noc ? "Simbody's" : "the NOC's";
  return checkOf(comparison,
                 fmt::format("torques against {}, at {} instants between the samples", other, instants.size()),
                 widestGap(instants, duration), samples, profile.sizes().of(Rounded::torque), units);
}

Check judgeAnswers(const Scenario& scenario, std::vector<Answered> answers, const std::vector<PointwiseSample>& samples,
                   const RoundingProfile& profile, const Units& units) {
  Comparison comparison(scenario, Formulation::external, samples, profile);
  for (const Answered& answer : answers) comparison.add(answer);
  sortByTime(answers);
  return checkOf(comparison, "every answer that it gave against the NOC's, at its own instant",
                 widestGap(answers, scenario.trajectory->duration()), samples, profile.sizes().of(Rounded::torque),
                 units);
}

}  // namespace ursula
