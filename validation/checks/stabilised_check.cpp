#include "validation/checks/judges.h"
#include "validation/limits/conditioning.h"

#include <fmt/format.h>

#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// Above this share of the largest torque, a limit proves nothing if the replay gave up. Rounding alone may then
/// destabilise the machine.
constexpr double telling_limit = 1e-4;

}  // namespace

Check judgeStabilised(const StabilisedReplay& found, double largest, const Units& units) {
  static constexpr const char* check = "feedback.torque";
  const std::string stopped =
      found.stopped.empty() ? "" : fmt::format("; {} at t = {:.6g} s", found.stopped, found.stopped_at * units.time);
  const std::string cause = found.noisiest ? causeOfRounding(*found.noisiest) : "";
  if (found.gave_up && found.torque <= found.limit) {
    const std::string why = "the stabilised replay gave up" + stopped;
    if (found.limit <= telling_limit * largest) return notMade(check, units.efforts.unit, why);
    return notJudgeable(Reason::limit_useless, check, found.torque, found.limit, units.efforts.unit, "",
                        fmt::format("{}; the limit exceeds {:g} of the largest torque: {}", why, telling_limit, cause));
  }
  const std::string basis = fmt::format(
      "{:.3g} {}, twice the torque's largest rounding and the loops' as torque, answered with {:.3g} of it, and half "
      "of it again from a step",
      found.rounding * units.effort(), units.efforts.unit, found.answer);
  const std::string why = fmt::format(
      "torque that a weak stabilising term added over the whole motion, {:.3g} of the largest torque; shown for "
      "t = {:.6g} s of {} steps, {} derivative evaluations{}",
      largest > 0 ? found.torque / largest : found.torque, found.t * units.time, found.steps, found.evaluations,
      stopped);
  WorstShare worst;
  worst.add(found.torque, found.limit, found.t);
  Check out = judgedIfUseful({check, units.efforts.unit, largest}, worst, basis, why, cause);
  if (found.torque <= found.limit && found.too_long)
    out = notJudgeable(Reason::unfinished, check, found.torque, found.limit, units.efforts.unit, basis, why);
  out.largest = {found.torque, found.t * units.time, ""};
  return out;
}

}  // namespace ursula
