#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/limits/engine_view.h"
#include "validation/samples/place_name.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

double largest(const LegReactions& a, double length) { return distance(a, LegReactions{}, length); }

}  // namespace

Check judgeReactions(const std::vector<ReactionSample>& reactions, const std::vector<PointwiseSample>& samples,
                     const RoundingProfile& profile, const Units& units) {
  RemeasuredLimits look(profile);
  double size = 0;
  WorstShare worst;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const PointwiseSample& sample = samples[k];
    const Conditioning& at = sample.conditioning;
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      const LegReactions& recovered = reactions.at(k).recovered[leg];
      size = std::max(size, largest(recovered, at.length));
      const double error = reactions[k].errors[leg];
      worst.add(error, look.limit(error, at, Rounded::reactions, sample.motion), sample.motion.t,
                static_cast<int>(leg));
    }
  }
  if (!worst.any) return notMade("reactions.pointwise", "N", "no instant was compared");
  const CheckedQuantity quantity{"reactions.pointwise", "N", size};
  const JudgedValue shown = worst.shown(quantity.useful());
  Check check = judgedIfUseful(
      quantity, worst,
      fmt::format("eps (kappa(B)^2 kappa(legs) x || |T|' |w| || / length + largest mass x the acceleration's) x "
                  "{:g} x the spread measured in turned and rescaled frames",
                  rounding_safety),
      fmt::format("forces, and moments over the machine's length, at all joints against Simbody's mobilizer and "
                  "constraint reactions, at {} instants; shown for t = {:.6g} s, leg {}; the largest is {:.6g} N",
                  samples.size(), shown.t * units.time, shown.where + 1, size * units.force()),
      causeOfRounding(samples, worst.widest_t));
  check.largest = {worst.largest, worst.largest_t * units.time, placeName(worst.largest_where, false)};
  return check;
}

}  // namespace ursula
