#include "validation/checks/direct_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nocsolver/errors.h"
#include "validation/replay/windowed_replay.h"
#include "validation/samples/place_name.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

double spin(const Vector6d& v, double length) { return v.tail<3>().norm() + length * v.head<3>().norm(); }

/// `between`: by what replays with other deviations and stops end elsewhere, over the deviation.
Check judgeBeside(const Growth& growth, const BesidePath& path, const EndsBeside& beside, double between,
                  const Units& units) {
  static constexpr const char* check = "direct.growth";
  if (!beside.gave_up.empty())
    return notJudgeable(Reason::unfinished, check, std::nan(""), std::nan(""), "", "", beside.gave_up);
  const double size = beside.size;
  const Vector6d expected = (growth.Phi * path.direction()).head<6>();
  const double grown = expected.norm(), error = (beside.whole_apart - 2 * size * expected).norm() / (2 * size);
  // What is even in the deviation bounds what is cubic. Intervals and differences of twice the length show what these
  // miss, of smooth equations more.
  const double bend = (beside.above + beside.below - 2 * beside.on_path).norm() / size;
  const double steps = integration_safety * (((growth.coarser - growth.Phi) * path.direction()).head<6>().norm() +
                                             ((growth.blunter - growth.coarser) * path.direction()).head<6>().norm());
  const double integration =
      integration_safety * (2 * (beside.above - beside.below) - beside.whole_apart).norm() / (2 * size);
  const double rounding = path.rounding() * path.size() / size;
  Worst worst;
  worst.add(error / grown, (bend + steps + integration + between + rounding) / grown, path.end());
  return judgedIfUseful(
      {check, "", 1}, worst,
      fmt::format("what is even in the deviation, {0:g} times what intervals and differences of twice the length "
                  "change, {0:g} times what a hundredfold tolerance changes, and rounding of the accelerations",
                  integration_safety),
      fmt::format("a deviation of the state by {:.2g} m grows {:.4g} times until t = {:.6g} s by the "
                  "variational equations; relative difference from Simbody put off the path as much either "
                  "way",
                  size * units.length, grown, path.end() * units.time),
      "deviations so small that they grow linearly are near what the replays round");
}

}  // namespace

Check judgeDirect(const std::vector<DirectSample>& direct, const Subject& subject,
                  const std::vector<PointwiseSample>& samples, const RoundingProfile& profile, const Units& units) {
  static constexpr const char* check = "direct.pointwise";
  SecondLook look(profile);
  Worst shown;
  double size = 0;
  try {
    for (const DirectSample& simbody : direct) {
      const PointwiseSample& sample = samples[simbody.sample];
      const double length = sample.conditioning.length;
      for (std::size_t set = 0; set < simbody.torques.size(); ++set) {
        const Vector6d &torques = simbody.torques[set], &found = simbody.accelerations[set];
        size = std::max(size, spin(found, length));
        const double error = spin(subject.accelerations(sample.motion, torques) - found, length);
        shown.add(error, look.limit(error, sample.conditioning, Rounded::direct, sample.motion, 1, &torques),
                  sample.motion.t, static_cast<int>(set) - 1);
      }
    }
  } catch (const PoseError& error) {
    return notMade(check, "m/s^2", std::string("no answer: ") + error.what());
  }
  if (!shown.any) return notMade(check, "m/s^2", "no instant was compared");
  const auto motor = [](int where) { return where < 0 ? "as commanded" : fmt::format("motor {} changed", where + 1); };
  const CheckedQuantity quantity{check, "m/s^2", size};
  const Shown at = shown.shown(quantity.useful());
  Check out = judgedIfUseful(
      quantity, shown,
      fmt::format("eps (|| T_P inv(I) || x the torque's and the platform's compliance x the forces that close the "
                  "loops) x {:g} x the spread measured in turned and rescaled frames",
                  rounding_safety),
      fmt::format("platform accelerations by (36) against Simbody's, under seven sets of torques each; shown for "
                  "t = {:.6g} s, torques {}",
                  at.t * units.time, motor(at.where)),
      causeOfRounding(samples, shown.widest_t));
  out.largest = {shown.largest, shown.largest_t * units.time, motor(shown.largest_where)};
  return out;
}

Check judgeGrowth(const Growth& growth, const BesidePath& path, const Units& units, bool second_look) {
  const EndsBeside& ends = path.ends();
  const Check first = judgeBeside(growth, path, ends, 0, units);
  if (first.verdict == Verdict::pass || !second_look) return first;
  const EndsBeside& closer = path.endsWithStops();
  if (!closer.gave_up.empty() && first.verdict != Verdict::fail) return first;
  const Vector6d apart = closer.whole_apart / closer.size - ends.whole_apart / ends.size;
  return judgeBeside(growth, path, closer, ends.gave_up.empty() ? integration_safety * apart.norm() / 2 : 0, units);
}

}  // namespace ursula
