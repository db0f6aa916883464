// docs/audit.md.

#include <fmt/format.h>

#include <cmath>

#include "studies/audit/audit.h"
#include "studies/audit/words.h"

namespace ursula {
namespace audit {
namespace {

std::string introduction(const Audit& result) {
  int failing = 0, misprints = 0, holding = 0;
  AuditRow torques;
  for (const AuditRow& row : result.rows) {
    if (row.equation == "(37)") torques = row;
    if (row.kind == AuditRow::Kind::fails) ++failing;
    if (row.kind == AuditRow::Kind::misprint) ++misprints;
    if (row.kind == AuditRow::Kind::holds) ++holding;
  }
  return fmt::format(
      "# The paper's formulas on trial\n\n"
      "*Written by `ursula audit`; `./dev docs` refreshes it and a test holds it against a fresh run. Do not edit.*\n\n"
      "Every formula of *Kinematics and dynamics of a six-degree-of-freedom parallel manipulator with revolute legs* "
      "(Robotica, 1997)\n"
      "that can be measured, as printed in our source and, where that fails, beside what holds. Our source is a scan: "
      "whether an error is\n"
      "the paper's or the scan's cannot be told from it. {} readings fail, {} are plain misprints, {} hold as "
      "printed.\n"
      "With the failing ones put right, the method does what the paper says: its torques (37) agree with virtual work "
      "over differenced\n"
      "positions to {} of {} N·m.\n\n",
      failing, misprints, holding, number(torques.residual_printed), number(torques.size));
}

std::string method(const Audit& result) {
  std::string instants;
  for (double t : result.instants) instants += fmt::format("{}{}", instants.empty() ? "" : ", ", t);
  return fmt::format(
      "## Method\n\n"
      "The machine and motion are those of the paper's example (`{}`, t_f = {} s, not given in our source).\n\n"
      "- **Truth** comes without the paper's formulas: for a pose of the platform, B by rigid motion, R where two "
      "circles meet in the\n"
      "  leg's plane, angles by their definitions (Fig. 3). Rates and accelerations are central differences of these "
      "positions in\n"
      "  50-digit arithmetic, extrapolated to eighth order; momentum rates follow by the product rule; torques and T "
      "by virtual work,\n"
      "  with ∂(positions)/∂(pose) by differences again.\n"
      "- **Residual**: each formula alone, with exact inputs, against that truth; the largest component over six legs "
      "at\n"
      "  t = {} s, \"of\" the largest component of the truth. Where a formula holds, some 1e-40 is left: the "
      "differences' rounding.\n"
      "- **What it does**: the misreading alone put into the whole algorithm of Fig. 6. The torque's largest error "
      "over {} instants, also\n"
      "  over the largest torque of the motion, {:.0f} N·m; and these torques replayed open loop on a Simbody model of "
      "the loop\n"
      "  (tolerance {:.0e}): when P is off the helix by 1 mm and by 10 mm, and how far at t_f. A replay is lost where "
      "P is off by more than\n"
      "  the platform's size or the loop cannot be integrated on. The row \"none\" is the control: what holds, "
      "replayed likewise.\n"
      "- The leg's index i is left out. Symbols are those of [notation.md](notation.md); where each equation is in the "
      "code,\n"
      "  [equations.md](equations.md) says.\n\n"
      "To reproduce: `./dev build`, then `build/ursula audit` (`--json FILE` for the numbers to 17 digits, `--markdown "
      "FILE` for this page).\n"
      "Another machine or motion: `build/ursula audit SCENARIO`.\n\n",
      result.scenario, result.duration, instants, result.torque_samples, result.largest_torque,
      result.replay_tolerance);
}

std::string failing(const Audit& result, AuditRow::Kind kind) {
  std::string out =
      "| equation | as printed in our source | what holds | residual as printed | of what holds | note |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const AuditRow& row : result.rows)
    if (row.kind == kind)
      out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.equation, row.printed, row.holds,
                         residualOf(row.residual_printed, row), number(row.residual_holds), row.note);
  return out + "\n";
}

std::string effectRow(const AuditRow& row, double duration) {
  const AuditEffect& effect = *row.effect;
  if (!effect.refused.empty()) return fmt::format("| {} | none: {} | | | | |\n", row.equation, effect.refused);
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.equation, number(effect.torque_error),
                     number(effect.relative_error), instant(effect.to_1_mm), instant(effect.to_10_mm),
                     ending(effect, duration));
}

std::string effects(const Audit& result) {
  std::string out =
      "| put into the algorithm | torque error, N·m | over the largest | 1 mm off after | 10 mm off after | at t_f |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const AuditRow& row : result.rows)
    if (row.effect) out += effectRow(row, result.duration);
  for (const AuditRow& row : result.together) out += effectRow(row, result.duration);
  return out + "\n";
}

std::string holding(const Audit& result) {
  std::string out = "| equation | as printed | residual | note |\n| --- | --- | --- | --- |\n";
  for (const AuditRow& row : result.rows)
    if (row.kind == AuditRow::Kind::holds)
      out += fmt::format("| {} | {} | {} | {} |\n", row.equation, row.printed, residualOf(row.residual_printed, row),
                         row.note);
  return out + "\n";
}

std::string besides(const Audit& result) {
  std::string out = "| place | says | found |\n| --- | --- | --- |\n";
  for (const AuditRemark& remark : result.remarks)
    out += fmt::format("| {} | {} | {} |\n", remark.place, remark.says, remark.found);
  return out;
}

}  // namespace
}  // namespace audit

std::string auditMarkdown(const Audit& result) {
  return audit::introduction(result) + audit::method(result) + "## Formulas that do not hold as printed\n\n" +
         audit::failing(result, AuditRow::Kind::fails) + "## What each does to torques and motion\n\n" +
         audit::effects(result) +
         "## Misprints\n\nDimensions or types do not match, or a symbol is plainly another's.\n\n" +
         audit::failing(result, AuditRow::Kind::misprint) + "## Formulas that hold as printed\n\n" +
         "Definitions are not measured by themselves: (29), (30), (46) enter (36), (37), (38).\n\n" +
         audit::holding(result) + "## Besides the formulas\n\n" + audit::besides(result);
}

}  // namespace ursula
