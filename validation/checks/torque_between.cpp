#include "validation/checks/torque_between.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nocsolver/errors.h"
#include "validation/samples/place_name.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// Of the first round, and a quarter of it again where the torques curve. At the spacing that this gives the paper's
/// motion of 3 s, a pulse of 1 ms is met more than once.
constexpr int least_instants = 8192;
/// A second, in the scenario's own units of time: a long motion has no wider gaps than a short one …
constexpr double instants_per_time = 600;
/// … but for what would take seconds.
constexpr int most_instants = 65536;

struct Instant {
  double t = 0;
  Vector6d torques = Vector6d::Zero();
};

/// k φ⁻¹ mod 1: gaps of at most three lengths, none of them in step with anything (Knuth, The Art of Computer
/// Programming 3, sect. 6.4, theorem S).
std::vector<double> goldenInstants(double duration, int count) {
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(count));
  for (int k = 1; k <= count; ++k) out.push_back(duration * std::fmod(k * ratio, 1.0));
  return out;
}

/// The middles of the quarter of intervals about whose ends the torques curve most.
std::vector<double> curvedInstants(const std::vector<Instant>& instants) {
  std::vector<std::pair<double, double>> curved;  // second difference, middle
  for (std::size_t k = 1; k + 1 < instants.size(); ++k) {
    const Instant &a = instants[k - 1], &b = instants[k], &c = instants[k + 1];
    const double share = (b.t - a.t) / (c.t - a.t);
    const double bend = (b.torques - (1 - share) * a.torques - share * c.torques).cwiseAbs().maxCoeff();
    curved.emplace_back(std::isnan(bend) ? std::numeric_limits<double>::infinity() : bend, (b.t + c.t) / 2);
  }
  const std::size_t count = curved.size() / 4;
  std::nth_element(curved.begin(), curved.begin() + static_cast<std::ptrdiff_t>(count), curved.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(curved[k].second);
  return out;
}

/// The larger of the two samples beside t: a first look, that spares most instants a limit of their own.
class SampledTorqueLimit {
 public:
  explicit SampledTorqueLimit(const std::vector<PointwiseSample>& samples) : samples_(samples) {}
  double at(double t) const {
    const auto after = std::lower_bound(samples_.begin(), samples_.end(), t,
                                        [](const PointwiseSample& each, double x) { return each.motion.t < x; });
    const auto i = std::min(static_cast<std::size_t>(after - samples_.begin()), samples_.size() - 1);
    return std::min(limitOf(i), limitOf(i == 0 ? 0 : i - 1));
  }

 private:
  double limitOf(std::size_t i) const { return samples_[i].conditioning.torqueRounding(); }
  const std::vector<PointwiseSample>& samples_;
};

class Comparison {
 public:
  Comparison(const Scenario& scenario, const Subject& subject, const std::vector<PointwiseSample>& samples,
             const RoundingProfile& profile)
      : trajectory_(*scenario.trajectory),
        subject_(subject),
        other_(subject.formulation == Formulation::noc ? fastSubject(*scenario.manipulator, scenario.load)
                                                       : nocSubject(*scenario.manipulator, scenario.load)),
        limit_(samples),
        profile_(profile),
        look_(profile) {}

  Instant at(double t) {
    const Motion<double> motion = trajectory_.at(t);
    const Instant out{t, subject_.torques(motion)};
    Eigen::Index leg = 0;
    const double error = (out.torques - other_.torques(motion)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(&leg);
    double limit = limit_.at(t);
    // A limit of its own is dear: for what would decide, and not for each instant of torques that are wrong all along.
    const bool decided = worst_.beyond() && Worst::share(error, limit) <= Worst::share(worst_.value, worst_.limit);
    if (!(error <= limit) && !decided) {
      const Conditioning here = profile_.at(motion);
      limit = look_.limit(error, here, Rounded::torque, motion);
    }
    worst_.add(error, limit, t, static_cast<int>(leg));
    return out;
  }

  const Worst& worst() const { return worst_; }

 private:
  const Trajectory& trajectory_;
  const Subject& subject_;
  Subject other_;  ///< of another formulation than the subject
  SampledTorqueLimit limit_;
  const RoundingProfile& profile_;
  SecondLook look_;
  Worst worst_;
};

}  // namespace

Check judgeBetween(const Scenario& scenario, const Subject& subject, const std::vector<PointwiseSample>& samples,
                   const RoundingProfile& profile, const Units& units) {
  static constexpr const char* check = "torque.between";
  if (samples.empty()) return notMade(check, units.efforts.unit, "no instant was compared");
  const double duration = scenario.trajectory->duration();
  const int count =
      std::clamp(static_cast<int>(std::min(instants_per_time * duration, 1e9)), least_instants, most_instants);
  Comparison comparison(scenario, subject, samples, profile);
  std::vector<Instant> instants;
  double gap = 0, before = 0;
  try {
    // In that order, not in time: what is largest is then met early.
    const std::vector<double> golden = goldenInstants(duration, count);
    foresee(subject, *scenario.trajectory, golden);
    for (double t : golden) instants.push_back(comparison.at(t));
    std::sort(instants.begin(), instants.end(), [](const Instant& a, const Instant& b) { return a.t < b.t; });
    for (const Instant& instant : instants) {
      gap = std::max(gap, instant.t - before);
      before = instant.t;
    }
    const std::vector<double> curved = curvedInstants(instants);
    foresee(subject, *scenario.trajectory, curved);
    for (double t : curved) comparison.at(t);
  } catch (const PoseError& error) {
    return notMade(check, units.efforts.unit, std::string("no answer: ") + error.what());
  }
  gap = std::max(gap, duration - before);
  const Worst& shown = comparison.worst();
  Check out = judged(
      check, shown.value, shown.limit, units.efforts.unit, "as for torque.pointwise, at each instant",
      fmt::format("torques against {}, at {} instants between the samples; shown for t = {:.6g} s, leg {}; a pulse "
                  "longer than {:.2g} s and larger than {:.2g} {} would have been seen",
                  subject.formulation == Formulation::noc ? "those of the fast kernels" : "the NOC's",
                  count + count / 4, shown.t * units.time, units.legOf(shown.where) + 1, gap * units.time,
                  shown.widest_limit * units.effort(), units.efforts.unit));
  out.largest = {shown.largest, shown.largest_t * units.time, placeName(units.legOf(shown.largest_where), false)};
  return out;
}

}  // namespace ursula
