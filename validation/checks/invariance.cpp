#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/samples/pointwise.h"

namespace ursula {
namespace {

struct Words {
  const char *check, *what;
};

Words wordsOf(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::rotation:
      return {"invariance.rotation", "the whole world turned, gravity included, leaves the torques"};
    case Symmetry::axes:
      return {"invariance.axes", "other axes on the platform and another origin leave the torques"};
    case Symmetry::units:
      return {"invariance.units", "much smaller and much larger units leave the torques"};
    case Symmetry::labels:
      return {"invariance.labels", "legs relabelled carry their torques along"};
    case Symmetry::mass:
      return {"invariance.mass", "masses, inertias and friction doubled double the torques"};
    case Symmetry::time_reversal:
      break;
  }
  return {"invariance.time_reversal", "the mean of the torques forwards and backwards is that without friction"};
}

Check judgeInvariance(const InvarianceSamples& sides, const std::vector<PointwiseSample>& samples,
                      const RoundingProfile& profile, const Units& units) {
  const Words words = wordsOf(sides.symmetry);
  if (!sides.refused.empty()) return notMade(words.check, units.efforts.unit, "no answer: " + sides.refused);
  if (sides.found.empty()) return notMade(words.check, units.efforts.unit, "no instant was compared");
  RemeasuredLimits look(profile);
  WorstShare worst;
  for (std::size_t k = 0; k < sides.found.size(); ++k) {
    const PointwiseSample& sample = samples[k];
    Eigen::Index leg = 0;
    const double error = (sides.expected[k] - sides.found[k]).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(&leg);
    worst.add(error, look.limit(error, sample.conditioning, Rounded::solver, sample.motion, 2), sample.motion.t,
              static_cast<int>(leg));
  }
  const double seen = largestTorque(samples), along = profile.sizes().of(Rounded::torque);
  return judgedShown({words.check, units.efforts.unit, std::max(seen, along), 0, seen, along}, worst, units,
                     {"twice the solver's own rounding: both sides round",
                      fmt::format("{}, at {} instants", words.what, samples.size()), motorsOf(units),
                      causeOfRounding(samples, worst.widest_t)});
}

}  // namespace

std::vector<Check> judgeInvariances(const std::vector<InvarianceSamples>& invariances,
                                    const std::vector<PointwiseSample>& samples, const RoundingProfile& profile,
                                    const Units& units) {
  std::vector<Check> checks;
  checks.reserve(invariances.size());
  for (const InvarianceSamples& sides : invariances) checks.push_back(judgeInvariance(sides, samples, profile, units));
  return checks;
}

Check judgeEngineFrames(const std::vector<FrameDifference>& differences, const std::vector<PointwiseSample>& samples,
                        const Units& units) {
  static constexpr const char* check = "invariance.engines";
  WorstShare worst;
  for (const FrameDifference& each : differences)
    worst.add(each.difference, each.limit, each.t, static_cast<int>(each.quantity));
  if (!worst.any) return notMade(check, units.efforts.unit, "no instant was compared");
  return judgedShown(
      {check, units.efforts.unit, largestTorque(samples)}, worst, units,
      {fmt::format("eps x the shape of each engine's torques x {:g} x its spread measured over changed inputs",
                   rounding_safety),
       "torques of each engine in other frames, with other labels and units, against its own in the given one",
       [](int quantity) { return std::string(nameOfEngine(static_cast<Rounded>(quantity))); },
       causeOfRounding(samples, worst.widest_t)});
}

}  // namespace ursula
