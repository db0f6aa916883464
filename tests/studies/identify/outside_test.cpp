// Errors that no number of the model has, and what identify does not reach yet; docs/identify.md has the figures.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/studies/identify/paper_machine_log.h"
#include "tests/studies/identify/random_logs.h"

namespace ursula {
namespace {

/// An error of motor or leg 3 that no number of the model has, and a size of it that none can miss.
struct OutsideError {
  const char* kind;  ///< of the cause
  const char* unit;
  double largest;  ///< in units of `unit`
};
const OutsideError outside_errors[] = {{"elastic_joint", "% of the motion for the largest effort", 10},
                                       {"backlash", "% of the motion", 10},
                                       {"load_dependent_friction", "% of the effort", 30},
                                       {"parameter", "degrees of the axis", 10}};

MeasuredLog logWith(const OutsideError& error, double size, const RandomLog& log) {
  ManipulatorParameters machine = log.truth;
  const bool bent = std::string(error.kind) == "parameter";
  if (bent) {
    Vector3d& axis = machine.legs[2].base_axis;
    axis = Eigen::AngleAxisd(size * std::acos(-1.0) / 180, axis.unitOrthogonal()) * axis;
  }
  SyntheticRows rows = bent ? syntheticRows(log.model, machine, log.how) : log.rows;
  SyntheticLog how = log.how;
  how.effort_noise = how.motion_noise = how.delay = 0;
  const SyntheticRows exact = syntheticRows(log.model, machine, how);
  const Eigen::ArrayXd q = exact.motion.col(2), S = exact.efforts.col(2);
  const double stroke = q.maxCoeff() - q.minCoeff(), most = S.abs().maxCoeff(), share = size / 100;
  if (error.kind == std::string("elastic_joint")) rows.motion.col(2).array() += share * stroke * S / most;
  if (error.kind == std::string("backlash"))
    rows.motion.col(2).array() += 0.5 * share * stroke * (S / (0.01 * most)).tanh();
  if (error.kind == std::string("load_dependent_friction")) {
    Eigen::ArrayXd rate = Eigen::ArrayXd::Zero(q.size());
    rate.segment(1, q.size() - 2) = (q.tail(q.size() - 2) - q.head(q.size() - 2)) * (0.5 * how.rate);
    rows.efforts.col(2).array() += share * S.abs() * (rate / 0.01).tanh();
  }
  return logOf(rows, log.model);
}

/// Prints the smallest size, of two for each power of ten, that is called wrong, and the causes that are then named.
TEST(OutsideErrors, areToldFromNoise) {
  for (const unsigned seed : {2U, 3U, 6U})
    for (const OutsideError& error : outside_errors) {
      const RandomLog log = randomLog(seed);
      IdentifyOptions options;
      options.tolerances = log.tolerances;
      double found = 0;
      bool named = false, outside = false;
      for (double size = error.largest; size > error.largest * 2e-4; size /= std::sqrt(10.0)) {
        IdentifyResult result;
        try {
          result = identify(log.model, logWith(error, size, log), options);
        } catch (const std::exception&) {  // the machine cannot follow
          continue;
        }
        if (result.verdict != Verdict::fail) break;
        found = size;
        named = !result.causes.empty() && result.causes[0].kind == error.kind && result.causes[0].motor % 3 == 0;
        outside = !result.causes.empty() && result.causes[0].outside;
      }
      std::printf("%s: %s from %.2g %s%s%s\n", log.model.name.c_str(), error.kind, found, error.unit,
                  named ? ", named" : "", outside ? ", outside" : "");
      std::fflush(stdout);
      EXPECT_GT(found, 0) << error.kind;
    }
}

using IdentifyOpen = Identify;

TEST_F(IdentifyOpen, elasticJointIsToldFromAllMassesAndInertias) {
  const IdentifyResult result = runWithCompliance();
  ASSERT_FALSE(result.causes.empty());
  EXPECT_TRUE(result.causes[0].outside);
}

}  // namespace
}  // namespace ursula
