// docs/audit.md.

#include <fmt/format.h>

#include <cmath>

#include "parts/audit/audit.h"
#include "parts/audit/remarks.h"

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
      "# Audit of the paper's formulas\n\n"
      "*`ursula audit` writes this page; `./dev docs` refreshes it, and a test compares it with a fresh run. Do not "
      "edit.*\n\n"
      "This page checks every measurable formula of *Kinematics and dynamics of a six-degree-of-freedom parallel "
      "manipulator with revolute legs* (Robotica, 1997).\n"
      "It gives each formula as printed in our source and, if that fails, the correct one. Our source is a scan: it "
      "does not tell whether an error is\n"
      "the paper's or the scan's. {} readings fail, {} are plain misprints, {} hold as printed.\n"
      "With the failing formulas corrected, the method does what the paper says: its torques (37) agree with virtual "
      "work over differenced\n"
      "positions to {} of {} N·m.\n\n",
      failing, misprints, holding, number(torques.residual_printed), number(torques.size));
}

std::string method(const Audit& result) {
  std::string instants;
  for (double t : result.instants) instants += fmt::format("{}{}", instants.empty() ? "" : ", ", t);
  return fmt::format(
      "## Method\n\n"
      "The machine and motion are those of the paper's example (`{}`, t_f = {} s, not given in our source).\n\n"
      "- The **reference** does not use the paper's formulas. For a pose of the platform, B follows from rigid motion, "
      "R is where two circles meet in the\n"
      "  leg's plane, and angles follow from their definitions (Fig. 3). Rates and accelerations are central "
      "differences of these positions in\n"
      "  50-digit arithmetic, extrapolated to eighth order. Momentum rates follow from the product rule, torques and T "
      "from virtual work,\n"
      "  with ∂(positions)/∂(pose) again by differences.\n"
      "- The **residual** compares one formula, with exact inputs, with this reference. It is the largest component "
      "over six legs at\n"
      "  t = {} s, \"of\" the largest component of the reference. If a formula holds, some 1e-40 is left: the rounding "
      "of the differences.\n"
      "- The **effect** is that of one misreading in the whole algorithm of Fig. 6. It gives the torque's largest "
      "error over {} instants, also\n"
      "  relative to the largest torque of the motion, {:.0f} N·m. These torques are then replayed open loop on a "
      "Simbody model of the loop\n"
      "  (tolerance {:.0e}): when P is off the helix by 1 mm and by 10 mm, and how far at t_f. A replay is lost if P "
      "is off by more than\n"
      "  the platform's size or the integration of the loop cannot continue. The row \"none\" is the control: a replay "
      "of the correct formulas.\n"
      "- The leg's index i is left out. Symbols are those of [notation.md](notation.md); [equations.md](equations.md) "
      "gives each\n"
      "  equation's place in the code.\n\n"
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
         audit::failing(result, AuditRow::Kind::fails) + "## Effect of each on torques and motion\n\n" +
         audit::effects(result) +
         "## Misprints\n\nDimensions or types do not match, or a symbol clearly belongs to another quantity.\n\n" +
         audit::failing(result, AuditRow::Kind::misprint) + "## Formulas that hold as printed\n\n" +
         "Definitions are not measured alone: (29), (30), (46) enter (36), (37), (38).\n\n" + audit::holding(result) +
         "## Further statements of the text\n\n" + audit::besides(result);
}

}  // namespace ursula
