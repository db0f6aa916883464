#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "nocsolver/errors.h"
#include "validation/samples/pointwise.h"

namespace ursula {
namespace {

std::string motorChanged(int where) { return where < 0 ? "as commanded" : fmt::format("motor {} changed", where + 1); }

/// Takes one of Simbody's answers, the conditioning there, and the 0-based motor that is changed (−1 for none).
using Compare = std::function<void(const DirectAnswer&, const Conditioning&, int motor)>;

/// `what` precedes the instant in the words; `each` passes on the answers to compare.
Check judgeAccelerations(const char* check, const char* what, const std::function<void(const Compare&)>& each,
                         const Subject& subject, const std::vector<PointwiseSample>& samples,
                         const RoundingProfile& profile, const Units& units) {
  RemeasuredLimits look(profile);
  WorstShare worst;
  double size = 0;
  try {
    each([&](const DirectAnswer& simbody, const Conditioning& at, int motor) {
      size = std::max(size, twistSize(simbody.twist_rate, at.length));
      const Vector6d found = subject.accelerations(simbody.state, simbody.torques);
      const double error = twistSize(found - simbody.twist_rate, at.length);
      worst.add(error, look.limit(error, at, Rounded::direct, simbody.state, 1, &simbody.torques), simbody.state.t,
                motor);
    });
  } catch (const PoseError& error) {
    return notMade(check, "m/s^2", std::string("no answer: ") + error.what());
  }
  if (!worst.any) return notMade(check, "m/s^2", "no state was compared");
  const double along = profile.sizes().of(Rounded::direct);
  return judgedShown(
      {check, "m/s^2", std::max(size, along), 0, size, along}, worst, units,
      {fmt::format("eps (|| T_P inv(I) || x the torque's and the platform's compliance x the forces that close the "
                   "loops) x {:g} x the spread measured over changed inputs",
                   rounding_safety),
       fmt::format("platform accelerations by (36) against Simbody's, {}", what), motorChanged,
       causeOfRounding(samples, worst.widest_t, Rounded::direct)});
}

}  // namespace

Check judgeDirect(const std::vector<DirectSample>& direct, const Subject& subject,
                  const std::vector<PointwiseSample>& samples, const RoundingProfile& profile, const Units& units) {
  const auto each = [&](const Compare& compare) {
    for (const DirectSample& here : direct)
      for (std::size_t set = 0; set < here.commanded.size(); ++set)
        compare(here.commanded[set], samples[here.sample].conditioning, static_cast<int>(set) - 1);
  };
  return judgeAccelerations("direct.pointwise", "under seven sets of torques each", each, subject, samples, profile,
                            units);
}

Check judgeOffPath(const std::vector<DirectSample>& direct, const Subject& subject,
                   const std::vector<PointwiseSample>& samples, const RoundingProfile& profile, const Units& units) {
  const auto each = [&](const Compare& compare) {
    for (const DirectSample& here : direct)
      for (const DirectAnswer& answer : here.off_path) compare(answer, profile.at(answer.state), -1);
  };
  return judgeAccelerations("direct.off_path", "in states beside the path", each, subject, samples, profile, units);
}

}  // namespace ursula
