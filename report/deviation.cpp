#include <fmt/format.h>

#include <cmath>

#include "base/leading_number.h"
#include "report/quantity.h"
#include "report/report.h"

namespace ursula {
namespace {

/// "0.03 %"; a plain number below a millionth, because nobody reads 0.0000003 %.
std::string shareText(double share) {
  return share >= 1e-6 ? report::percentText(share) : fmt::format("{:.1e} of the largest", share);
}

std::string driftText(const EffortDeviation& deviation) {
  if (!std::isfinite(deviation.drift) || deviation.largest == 0) return "";
  if (deviation.drift > deviation.length)
    return fmt::format("from errors of this size the open-loop motion may be lost within {:.3g} s; ",
                       deviation.duration);
  std::string drift = report::quantity(deviation.drift, "m", 2);
  if (const auto joint = drift.find("\u00a0"); joint != std::string::npos) drift.replace(joint, 2, " ");
  return fmt::format("from errors of this size the open-loop motion would drift by up to {} in {:.3g} s; ", drift,
                     deviation.duration);
}

/// Rounds up, so that the rounded value passes, too.
std::string roundedUp(double value) {
  if (!(value > 0 && std::isfinite(value))) return fmt::format("{:g}", value);
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 4);
  double steps = std::floor(value / digit);
  while (leadingNumber(fmt::format("{:.5g}", steps * digit)).value < value) ++steps;
  return fmt::format("{:.5g}", steps * digit);
}

}  // namespace

std::string sentence(const EffortDeviation& deviation) {
  if (std::isnan(deviation.largest)) return "The largest deviation is unknown: a torque is not a number.";
  if (deviation.largest_effort == 0)
    return fmt::format("No torque is needed here; the largest that was found is {:.3g} {}.", deviation.largest,
                       deviation.unit);
  constexpr double right = 1e-6;  // torques with larger errors are not called right
  const std::string seen =
      std::isfinite(deviation.seen)
          ? fmt::format(" An error of {:.1g} of the largest torque would have been seen.", deviation.seen)
          : "";
  return fmt::format(
      "{} {}: the largest deviation is {} {} of {:.6g} {}, {} at t = {:.4g} s; {}the smallest --rtol that "
      "would pass is {}.{}",
      deviation.relative() <= right || deviation.largest == 0 ? "Right to" : "Off by at most",
      shareText(deviation.relative()), fmt::format(deviation.largest < 1000 ? "{:.3g}" : "{:.0f}", deviation.largest),
      deviation.unit, deviation.largest_effort, deviation.unit, deviation.where, deviation.t, driftText(deviation),
      roundedUp(deviation.smallestRelative()), seen);
}

}  // namespace ursula
