#include "parts/causes/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parts/causes/hypotheses.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Shares of wrong answers that differ more are no chance.
constexpr double most_unlike = 10;
/// An instant so near to a sample, relative to the motion's duration, is the sample's.
constexpr double same_instant = 1e-9;
/// An error of less than this many limits is not called wrong: the limits of the samples stand for instants between.
constexpr double sure_beyond = 2;

/// "all 301 samples", "3 of 301 samples", "none of 301 samples".
std::string countText(const Places::Count& of, const char* what) {
  if (of.wrong == of.all) return fmt::format("all {} {}", of.all, what);
  return of.wrong == 0 ? fmt::format("none of {} {}", of.all, what)
                       : fmt::format("{} of {} {}", of.wrong, of.all, what);
}

}  // namespace

bool Places::areAlike() const {
  if (others.all == 0 || samples.wrong + others.wrong == 0) return true;
  return samples.share() <= most_unlike * others.share() && others.share() <= most_unlike * samples.share();
}

Places placesOf(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                const std::vector<Answered>& answers) {
  Places out;
  out.samples.all = samples.size();
  for (const PointwiseSample& sample : samples)
    out.samples.wrong += !(sample.torque.error <= sure_beyond * sample.torque.limit);
  const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
  const double end = scenario.trajectory->duration();
  for (const Answered& answer : answers) {
    const std::size_t after = indexFrom(samples, answer.t), before = after > 0 ? after - 1 : 0;
    const auto isAt = [&](std::size_t k) { return std::abs(samples[k].motion.t - answer.t) <= same_instant * end; };
    if (isAt(before) || isAt(after)) continue;
    const Vector6d expected = noc.torques(scenario.trajectory->at(answer.t));
    Eigen::Index motor = 0;
    const double error = (answer.torques - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(&motor);
    ++out.others.all;
    if (error <= sure_beyond * std::max(samples[before].conditioning.torqueRounding(),
                                        samples[after].conditioning.torqueRounding()))
      continue;
    out.first = out.others.wrong == 0 ? answer.t : std::min(out.first, answer.t);
    out.last = std::max(out.last, answer.t);
    ++out.others.wrong;
    if (!(error <= out.largest)) out.largest = error, out.largest_t = answer.t, out.motor = static_cast<int>(motor);
  }
  return out;
}

void sayPlaces(const Places& places, const Manipulator& machine, const FrameChange& natural, Diagnosis& diagnosis) {
  const MotorNames motors = motorNames(machine);
  const double time = natural.units.time;
  if (diagnosis.summary.empty()) {
    diagnosis.summary =
        fmt::format("{} by up to {:.4g} {} at t = {:.6g} s", motors(places.motor),
                    places.largest * natural.effort(places.motor), motors.unit(places.motor), places.largest_t * time);
    diagnosis.deviation = diagnosis.summary;
  }
  diagnosis.cause = fmt::format("no simple explanation: wrong at {} and at {}", countText(places.samples, "samples"),
                                countText(places.others, "other instants that were asked"));
  if (places.others.wrong > 0)
    diagnosis.cause += fmt::format(", those from t = {:.6g} to {:.6g} s", places.first * time, places.last * time);
  diagnosis.claim = CauseClaim::none;
  diagnosis.named.reset();
  diagnosis.others.clear();
  diagnosis.together.clear();
}

}  // namespace ursula
