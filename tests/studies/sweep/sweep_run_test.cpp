// Results of points, which do not depend on jobs, shards or stops.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "model/instants.h"
#include "parts/fast/solver.h"
#include "parts/sweep/merge.h"
#include "parts/sweep/run.h"
#include "tests/studies/sweep/sweeps.h"
#include "validation/validate.h"

namespace ursula {
namespace {

std::map<std::string, SweepValue> valuesOf(const SweepPoint& point) {
  std::map<std::string, SweepValue> out;
  for (const SweepValue& value : point.values) out[value.name] = value;
  return out;
}

const std::string around = "design = \"random\"\ncount = 60\nsamples = 21\n" +
                           vary("platform.mass", "uniform = [400.0, 600.0]") +
                           vary("leg_defaults.distal.length", "uniform = [0.5, 1.5]");

/// The expected values come from the paper's equations, pose by pose.
TEST(SweepWorker, findsTheLargestEffortsAndTheWorstPose) {
  SweepPlan plan = planOf("inverse", around);
  const PointWork make = workOn(plan);
  int judged = 0;
  for (std::int64_t i = 0; i < 60; ++i) {
    const SweepPoint point = make(i);
    if (point.verdict != "pass") continue;
    ++judged;
    const Scenario scenario = parseScenario(plan.text(i), "point.toml");
    const Solver<double> solver(*scenario.manipulator);
    Workspace<double> work;
    double kappa = 0, sine = 1;
    Vector6d largest = Vector6d::Zero();
    for (const double t : equallySpaced(3, 21)) {
      const Motion<double> motion = scenario.trajectory->at(t);
      largest = largest.cwiseMax(solver.inverseDynamics(motion, work).cwiseAbs());
      solver.inverseKinematics(motion, work);
      solver.jacobians(motion, work);
      for (int leg = 0; leg < leg_count; ++leg) sine = std::min(sine, solver.margins(work, leg).sine);
      Matrix6d B = solver.B(work);
      B.leftCols<3>() /= solver.length();
      const auto singular = B.jacobiSvd().singularValues();
      kappa = std::max(kappa, singular(0) / singular(5));
    }
    const auto found = valuesOf(point);
    ASSERT_EQ(found.size(), 14u);
    for (int k = 0; k < 6; ++k) {
      const std::string name = "tau_" + std::to_string(k + 1);
      EXPECT_NEAR(found.at(name + "_Nm").value, largest(k), 1e-11 * largest.maxCoeff());
      const Motion<double> there = scenario.trajectory->at(found.at(name + "_t_s").value);
      EXPECT_NEAR(std::abs(solver.inverseDynamics(there, work)(k)), largest(k), 1e-11 * largest.maxCoeff());
    }
    EXPECT_NEAR(found.at("sin_theta").value, sine, 1e-13);
    EXPECT_NEAR(found.at("kappa_B").value, kappa, 0.02 * kappa);
  }
  EXPECT_GT(judged, 5);
}

TEST(SweepWorker, outOfReachIsAResultAndANumberThatNoMachineHasAnError) {
  SweepPlan plan = planOf("inverse", around);
  const PointWork make = workOn(plan);
  int unreachable = 0;
  for (std::int64_t i = 0; i < 60; ++i) {
    const SweepPoint point = make(i);
    if (point.verdict != "out_of_reach") continue;
    ++unreachable;
    const auto found = valuesOf(point);
    EXPECT_EQ(point.error, "");
    EXPECT_THAT(found.at("refused_leg").value, testing::AllOf(testing::Ge(1), testing::Le(6)));
    EXPECT_GE(found.at("refused_t_s").value, 0);
    EXPECT_EQ(found.count("tau_1_Nm"), 0u);
  }
  EXPECT_GT(unreachable, 5);
  for (const char* what : {"inverse", "validate"}) {
    SweepPlan negative =
        planOf(what, "design = \"grid\"\nsamples = 5\n" + vary("platform.mass", "values = [-5, 500, -5]"));
    for (const std::int64_t i : {0, 2}) {  // the first point is treated as any other
      const SweepPoint point = workOn(negative)(i);
      EXPECT_EQ(point.verdict, "error");
      EXPECT_THAT(point.error, testing::HasSubstr("manipulator.platform.mass: -5, expected > 0"));
      EXPECT_THAT(point.error, testing::StartsWith("point " + std::to_string(i) + " of sweep.toml:"));
      EXPECT_TRUE(point.values.empty());
    }
    EXPECT_EQ(workOn(negative)(1).verdict, "pass");
  }
}

/// The numbers are those of validate() on the point's own scenario, to the last bit.
TEST(SweepWorker, validatesAsTheProgramDoes) {
  SweepPlan whole = planOf("validate", "design = \"random\"\ncount = 3\nsamples = 11\n" +
                                           vary("platform.mass", "uniform = [400.0, 600.0]") +
                                           vary("trajectory.duration", "values = [0.3]"));
  const SweepPoint point = workOn(whole)(2);
  const ValidationResult result = validate(parseScenario(whole.text(2), "point.toml"));
  const auto found = valuesOf(point);
  EXPECT_EQ(point.verdict, name(result.verdict));
  int compared = 0;
  for (const Check& check : result.checks)
    if (check.verdict != Verdict::not_applicable) {
      ++compared;
      EXPECT_EQ(found.at(check.name).value, check.value) << check.name;
      EXPECT_EQ(found.at(check.name).limit, check.limit) << check.name;
      EXPECT_EQ(found.at(check.name).verdict, name(check.verdict)) << check.name;
    }
  EXPECT_GT(compared, 20);
}

TEST(SweepWorker, pointwiseHasTheValuesOfTheWholeAndFailsWrongMachines) {
  const std::string rest = "design = \"random\"\ncount = 3\nsamples = 11\npointwise = true\n" +
                           vary("platform.mass", "uniform = [400.0, 600.0]");
  SweepPlan plan = planOf("validate", rest);
  const SweepPoint point = workOn(plan)(1);
  EXPECT_EQ(point.verdict, "pass");
  const auto found = valuesOf(point);
  const ValidationResult result = validate(parseScenario(plan.text(1), "point.toml"));
  for (const char* name : {"torque.pointwise", "kinematics.joint_angles", "kinematics.joint_rates"}) {
    const auto whole = std::find_if(result.checks.begin(), result.checks.end(),
                                    [name](const Check& check) { return check.name == name; });
    ASSERT_NE(whole, result.checks.end());
    EXPECT_EQ(found.at(name).verdict, "pass");
    EXPECT_LE(found.at(name).value, found.at(name).limit);
    EXPECT_GT(found.at(name).limit, 0);
  }
  EXPECT_EQ(found.count("replay.position"), 0u);
  // A user's limit far below rounding fails.
  SweepFile strict = parseSweepFile(sweepText("validate", rest), "sweep.toml");
  const TemporaryFolder folder;
  strict.scenario =
      folder.write("strict.toml", TemporaryFolder::read(helix_file) + "\n[acceptance]\n\"torque.pointwise\" = 1e-30\n");
  SweepPlan never(strict);
  EXPECT_EQ(workOn(never)(1).verdict, "fail");
}

std::string rowsOf(const std::filesystem::path& file) {
  Sqlite database(file, Sqlite::Access::read);
  std::string out;
  Statement points(database, "SELECT id, parameters, verdict, coalesce(error, '-') FROM point");
  while (points.step()) out += points.text(0) + points.text(1) + points.text(2) + points.text(3) + "\n";
  Statement results(database, "SELECT point, name, hex(value), hex(\"limit\"), coalesce(verdict, '-') FROM result");
  while (results.step())
    for (int k = 0; k < 5; ++k) out += results.text(k) + "|";
  return out;
}

TEST(SweepRun, rowsAreTheSameForAnyJobsShardsAndStops) {
  const TemporaryFolder folder;
  SweepPlan plan = planOf("inverse", around);
  const auto run = [&](const std::string& name, int jobs, Shard shard, int stop_after) {
    int seen = 0;
    SweepRunOptions options{jobs, shard, false, [&] { return stop_after > 0 && seen >= stop_after; }};
    options.progress = [&](std::int64_t, std::int64_t) { ++seen; };
    return runSweep(plan, folder.path() / name, options);
  };
  const SweepRunResult whole = run("one.db", 1, {}, 0);
  EXPECT_EQ(whole.done, 60);
  EXPECT_EQ(whole.new_ones, 60);
  const std::string rows = rowsOf(folder.path() / "one.db");
  EXPECT_GT(rows.size(), 10000u);

  run("two.db", 2, {}, 0);
  EXPECT_EQ(rowsOf(folder.path() / "two.db"), rows);

  EXPECT_TRUE(run("stopped.db", 2, {}, 7).stopped);
  const SweepRunResult rest = run("stopped.db", 1, {}, 0);
  EXPECT_FALSE(rest.stopped);
  EXPECT_LT(rest.new_ones, 60);
  EXPECT_EQ(rest.done, 60);
  EXPECT_EQ(rowsOf(folder.path() / "stopped.db"), rows);
  EXPECT_EQ(run("stopped.db", 2, {}, 0).new_ones, 0);

  std::vector<std::filesystem::path> parts;
  for (int k = 1; k <= 7; ++k) {
    run("part" + std::to_string(k) + ".db", 1 + k % 2, {k, 7}, 0);
    parts.push_back(folder.path() / ("part" + std::to_string(k) + ".db"));
  }
  EXPECT_TRUE(mergeSweeps(parts, folder.path() / "merged.db").missing.empty());
  EXPECT_EQ(rowsOf(folder.path() / "merged.db"), rows);
}

TEST(SweepRun, makesErrorsAgainWhereItIsAsked) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "s.db";
  SweepPlan plan =
      planOf("inverse", "design = \"grid\"\nsamples = 5\n" + vary("platform.mass", "values = [400, 500, -5]"));
  const auto done = [&](bool retry) { return runSweep(plan, file, {1, {}, retry, [] { return false; }}).new_ones; };
  EXPECT_EQ(done(false), 3);
  EXPECT_EQ(done(false), 0);
  EXPECT_EQ(done(true), 1);
  Sqlite(file, Sqlite::Access::write).run("DELETE FROM point WHERE id = 0");  // removed manually, without its results
  EXPECT_EQ(done(false), 1);
  Sqlite database(file, Sqlite::Access::read);
  EXPECT_EQ(database.number("SELECT count(*) FROM point"), 3);
  EXPECT_EQ(database.number("SELECT count(*) FROM result WHERE point = 0"), 14);
}

/// Each kind has its own names of margins.
TEST(SweepWorker, namesTheMarginsOfEveryKind) {
  for (const auto& [file, name] : {std::pair{"paper-helix", "sin_theta"},
                                   {"hexaglide", "cos_theta"},
                                   {"hexa", "sin_psi"},
                                   {"flight-simulator", ""}}) {
    const std::string scenario = std::string(URSULA_SCENARIOS "/") + file + ".toml";
    SweepPlan plan(parseSweepFile("scenario = \"" + scenario +
                                      "\"\nwhat = \"inverse\"\ndesign = \"random\"\ncount = 1\nsamples = 5\n" +
                                      vary("platform.mass", "relative = 0.1"),
                                  "sweep.toml"));
    const auto found = valuesOf(workOn(plan)(0));
    ASSERT_EQ(found.count("kappa_B"), 1u) << file;
    for (const char* each : {"sin_theta", "cos_theta", "sin_psi", "leg_margin"})
      EXPECT_EQ(found.count(each), each == std::string(name) ? 1u : 0u) << file << each;
  }
}

TEST(Shard, partsAreWholeAndMeet) {
  for (const std::int64_t points : {0, 1, 6, 7, 100})
    for (const int of : {1, 3, 7}) {
      std::int64_t at = 0;
      for (int k = 1; k <= of; ++k) {
        EXPECT_EQ((Shard{k, of}.first(points)), at);
        at = Shard{k, of}.end(points);
      }
      EXPECT_EQ(at, points);
    }
}

}  // namespace
}  // namespace ursula
