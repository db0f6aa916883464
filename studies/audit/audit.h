#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// What a misread formula does, put alone into the whole algorithm.
struct AuditEffect {
  std::string refused;        ///< why there are no torques; empty where there are
  double torque_error = 0;    ///< largest over the motion, N·m
  double relative_error = 0;  ///< the same over the largest torque
  double to_1_mm = -1;        ///< s until the replay is that far from the path; negative: never
  double to_10_mm = -1;       ///< s
  double replay_end = 0;      ///< s; before t_f where P was off by more than the platform's size
  double end_deviation = 0;   ///< of P at replay_end, m
};

/// One formula of the paper on trial. Residuals are the largest mismatch of any component over legs and instants.
struct AuditRow {
  enum class Kind { holds, fails, misprint };

  Kind kind = Kind::holds;
  std::string equation, printed, holds, unit, note;
  double residual_printed = 0;  ///< NaN where none can be said
  double residual_holds = 0;    ///< of the formula that holds; NaN as above
  double size = 0;              ///< the largest component of what both should give
  std::optional<AuditEffect> effect;
};

/// What the text says besides its formulas, and what was found.
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
  std::vector<AuditRow> together;  ///< all errors at once, and none as a control; effects only
  std::vector<AuditRemark> remarks;
};

/// Measures all of it for the scenario's machine and motion. Throws PoseError where the motion cannot be made.
Audit runAudit(const Scenario& scenario);

/// For a terminal of 120 columns.
std::string auditText(const Audit& result);
std::string auditJson(const Audit& result);
/// The page docs/audit.md.
std::string auditMarkdown(const Audit& result);
/// The same as a page of the report's looks, formulas typeset; needs no script and no network.
std::string auditHtml(const Audit& result);

}  // namespace ursula
