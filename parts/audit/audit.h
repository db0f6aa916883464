#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// The effect of one wrong formula, alone in the whole algorithm.
struct AuditEffect {
  std::string refused;        ///< why there are no torques; else empty
  double torque_error = 0;    ///< largest over the motion, N·m
  double relative_error = 0;  ///< the same over the largest torque
  double to_1_mm = -1;        ///< s until the replay is 1 mm from the path; negative for never
  double to_10_mm = -1;       ///< s
  double replay_end = 0;      ///< s; before t_f if P was off by more than the platform's size
  double end_deviation = 0;   ///< of P at replay_end, m
};

/// One formula of the paper under audit. Residuals are the largest mismatch of any component over legs and instants.
struct AuditRow {
  enum class Kind { holds, fails, misprint };

  Kind kind = Kind::holds;
  std::string equation, printed, holds, unit, note;
  double residual_printed = 0;  ///< NaN if undefined
  double residual_holds = 0;    ///< of the correct formula; NaN as above
  double size = 0;              ///< largest component of the expected values
  std::optional<AuditEffect> effect;
};

/// A statement of the text beside its formulas, and our finding.
struct AuditRemark {
  std::string place, says, found;
};

struct Audit {
  std::string scenario;
  double duration = 0;           ///< t_f, s
  std::vector<double> instants;  ///< of the residuals, s
  double largest_torque = 0;     ///< N·m
  int torque_samples = 0;
  double replay_tolerance = 0;
  std::vector<AuditRow> rows;      ///< in the order of the equations
  std::vector<AuditRow> together;  ///< all errors at once, and none as a control; only effects
  std::vector<AuditRemark> remarks;
};

/// Measures everything for the scenario's machine and motion. Throws PoseError if the motion is impossible.
Audit runAudit(const Scenario& scenario);

/// Text for a terminal of 120 columns.
std::string auditText(const Audit& result);
std::string auditJson(const Audit& result);
/// The page docs/audit.md.
std::string auditMarkdown(const Audit& result);
/// The same as a page in the report's style with typeset formulas; needs no script and no network.
std::string auditHtml(const Audit& result);

}  // namespace ursula
