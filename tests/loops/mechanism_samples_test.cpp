// What a file of motors' samples may hold: rates and accelerations that belong to the coordinates, and few digits.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "base/errors.h"
#include "model/mechanism_scenario.h"
#include "tests/base/temporary_folder.h"
#include "tests/loops/loop_scenario.h"

namespace ursula {
namespace {

std::string samplesWith(double factor, bool euler) {
  std::string text = "t_s,q_1_rad,qdot_1_rad_s\n";
  double q = 0;
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.02 * i, rate = 0.4 * std::cos(2 * t);
    if (euler && i > 0) q += 0.02 * rate;
    text += fmt::format("{},{},{}\n", t, euler ? q : 0.2 * std::sin(2 * t), factor * rate);
  }
  return text;
}

/// Rates that are those of another motion are refused; those of a step of first order are no contradiction.
TEST(MechanismSamples, haveRatesThatBelongToTheirCoordinates) {
  const MechanismScenario scenario = loopScenario("fourbar");
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    const auto file = folder.path() / "motion.csv";
    std::ofstream(file) << text;
    return readMotorSamples(file, *scenario.mechanism);
  };
  EXPECT_NO_THROW(read(samplesWith(1, false)));
  EXPECT_NO_THROW(read(samplesWith(1, true)));
  for (const double factor : {-1.0, 57.3, 1.1}) try {
      read(samplesWith(factor, false));
      ADD_FAILURE() << factor;
    } catch (const CsvError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("qdot_1_rad_s is"));
      EXPECT_THAT(error.what(), testing::HasSubstr("motion.csv:"));
    }
}

/// A rate that rises within one row by more than the accelerations at both say, as where a joint begins to slip; with
/// `factor` for the accelerations.
std::string slippingSamples(double factor) {
  constexpr double slip_at = 1.01, slip = 0.005, acceleration = 0.5;
  std::string text = "t_s,q_1_rad,qdot_1_rad_s,qddot_1_rad_s2\n";
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.02 * i, slipped = t > slip_at ? slip : 0;
    text += fmt::format("{},{},{},{}\n", t, acceleration / 2 * t * t + slipped * (t - slip_at),
                        acceleration * t + slipped, factor * acceleration);
  }
  return text;
}

TEST(MechanismSamples, maySlipWithinOneRow) {
  const MechanismScenario scenario = loopScenario("fourbar");
  const TemporaryFolder folder;
  const auto read = [&](double factor) {
    const auto file = folder.path() / "motion.csv";
    std::ofstream(file) << slippingSamples(factor);
    return readMotorSamples(file, *scenario.mechanism);
  };
  EXPECT_TRUE(read(1).has_derivatives);
  EXPECT_THROW(read(1.1), CsvError) << "accelerations of another motion";
}

/// Columns as other tools print them, of a constant rate and of a constant acceleration.
std::string printedSamples(double acceleration, double factor, bool degrees) {
  const double unit = degrees ? 180 / std::acos(-1.0) : 1;
  std::string text =
      degrees ? "t_ms,q_1_deg,qdot_1_deg_s,qddot_1_deg_s2\n" : "t_s,q_1_rad,qdot_1_rad_s,qddot_1_rad_s2\n";
  for (int i = 0; i <= 60; ++i) {
    const double t = i / 30.0, q = 0.1 + t / 7 + acceleration * t * t / 2, rate = 1 / 7.0 + acceleration * t;
    text += fmt::format("{:.{}f},{:.6f},{:.3f},{:.2f}\n", degrees ? 1000 * t : t, degrees ? 1 : 4, unit * q,
                        factor * unit * rate, unit * acceleration);
  }
  return text;
}

TEST(MechanismSamples, mayHaveFewDigits) {
  const MechanismScenario scenario = loopScenario("fourbar");
  const TemporaryFolder folder;
  const auto file = folder.path() / "motion.csv";
  for (const bool degrees : {false, true})
    for (const double acceleration : {0.0, 0.25}) {
      std::ofstream(file) << printedSamples(acceleration, 1, degrees);
      EXPECT_NO_THROW(readMotorSamples(file, *scenario.mechanism)) << acceleration;
      std::ofstream(file) << printedSamples(acceleration, 1.1, degrees);
      EXPECT_THROW(readMotorSamples(file, *scenario.mechanism), CsvError) << acceleration;
    }
}

}  // namespace
}  // namespace ursula
