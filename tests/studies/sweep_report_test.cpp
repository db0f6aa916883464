// A sweep's summary, page and table, from databases made here.

#include <algorithm>
#include <cmath>
#include <regex>

#include "parts/sweep/report/sweep_outputs.h"
#include "parts/sweep/report/sweep_summary.h"
#include "tests/model/refusals.h"
#include "tests/report/text_parts.h"
#include "tests/studies/sweep_databases.h"
#include "tests/support/matchers.h"
#include "tests/support/numbers.h"

namespace ursula {
namespace {

using test::Dice;
using test::MadeSweep;
using test::madeSweep;

SweepSummary summaryOf(const MadeSweep& sweep, const std::string& name) { return summarise(*sweep.written(name)); }

std::string csvOf(const MadeSweep& sweep, const std::string& name) {
  std::string out;
  writeSweepCsv(*sweep.written(name), [&out](std::string_view piece) { out += piece; });
  return out;
}

const SweepOutput& outputOf(const SweepSummary& summary, OutputKind kind) {
  return *std::find_if(summary.outputs.begin(), summary.outputs.end(),
                       [kind](const SweepOutput& each) { return each.kind == kind; });
}

/// A sweep whose efforts depend most on the mass, less on the length, and not on the last number.
MadeSweep inverseSweep(std::int64_t points) {
  MadeSweep sweep = madeSweep("inverse", "random", {"platform.mass", "leg.1.length", "idle"}, points);
  Dice dice(4);
  for (std::int64_t k = 0; k < points; ++k) {
    const double mass = dice.roll(), length = dice.roll(), idle = dice.roll();
    SweepPoint& point = sweep.add({mass, length, idle});
    for (int motor = 1; motor <= 6; ++motor) {
      MadeSweep::result(point, "tau_" + std::to_string(motor) + "_Nm", 1000 + 300 * mass + 100 * length + motor);
      MadeSweep::result(point, "tau_" + std::to_string(motor) + "_t_s", 0.5);
    }
    MadeSweep::result(point, "kappa_B", 14);
    MadeSweep::result(point, "sin_theta", 0.3 - 0.1 * length);
  }
  return sweep;
}

/// Expects no "nan" or "inf" outside scripts and styles.
void expectNoNumberless(const std::string& page) {
  const std::string body = page.substr(page.find("<body"));
  EXPECT_FALSE(std::regex_search(body, std::regex("\\b(nan|NaN|inf)\\b"))) << body.substr(0, 3000);
}

TEST(SweepSummary, SaysWhatDrivesTheLargestEffort) {
  const SweepSummary summary = summaryOf(inverseSweep(1000), "drives");
  ASSERT_LT(summary.primary, summary.outputs.size());
  const SweepOutput& largest = summary.outputs[summary.primary];
  EXPECT_EQ(largest.kind, OutputKind::largest_effort);
  EXPECT_EQ(largest.unit, "Nm");
  EXPECT_EQ(driver(largest), 0U);
  EXPECT_NEAR(largest.relations[0].first_order, 0.9, 0.03);  // 9 : 1
  EXPECT_NEAR(largest.relations[1].first_order, 0.1, 0.06);
  EXPECT_TRUE(largest.relations[0].correlates && largest.relations[0].acts);
  EXPECT_FALSE(largest.relations[2].correlates || largest.relations[2].acts);
  EXPECT_EQ(summary.worst.front().id, largest.worst_point);
  EXPECT_EQ(summary.outputs[summary.worst.front().because].motor, 5);
  EXPECT_EQ(summary.worst.size(), most_worst);
  EXPECT_TRUE(std::is_sorted(summary.worst.rbegin(), summary.worst.rend(),
                             [](const WorstPoint& a, const WorstPoint& b) { return a.score < b.score; }));
}

TEST(SweepSummary, OfASineTakesTheSmallest) {
  const SweepSummary summary = summaryOf(inverseSweep(300), "sine");
  const SweepOutput& sine = outputOf(summary, OutputKind::sine);
  MadeSweep sweep = inverseSweep(300);
  const auto& values = sweep.points.at(static_cast<std::size_t>(sine.worst_point)).values;
  EXPECT_EQ(values.back().value, sine.spread.min);
}

TEST(SweepSummary, RelatesNothingToConstants) {
  const SweepOutput kappa = outputOf(summaryOf(inverseSweep(300), "constant"), OutputKind::kappa);
  EXPECT_TRUE(kappa.spread.constant);
  EXPECT_EQ(kappa.no_index, NoIndex::constant);
  for (const Relation& each : kappa.relations) EXPECT_FALSE(each.correlates || each.acts);
  EXPECT_EQ(driver(kappa), 3U);
}

TEST(SweepSummary, HasNoIndicesOfTooFewPoints) {
  const SweepSummary few = summaryOf(inverseSweep(199), "few"), enough = summaryOf(inverseSweep(200), "enough");
  EXPECT_EQ(few.outputs[few.primary].no_index, NoIndex::too_few);
  EXPECT_TRUE(std::isnan(few.outputs[few.primary].relations[0].first_order));
  EXPECT_EQ(driver(few.outputs[few.primary]), 0U);
  EXPECT_EQ(enough.outputs[enough.primary].no_index, NoIndex::none);
  EXPECT_THAT(sweepPage(few), HasSubstr("fewer than 200 points have a value"));
}

/// `missing` points of a 5 × 4 grid are out of reach.
MadeSweep gridSweep(int missing) {
  MadeSweep sweep = madeSweep("inverse", "grid", {"x", "y"}, 20);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 5; ++i) {
      const bool reached = j * 5 + i >= missing;
      SweepPoint& point = sweep.add({i - 2.0, j - 1.5}, reached ? "pass" : "out_of_reach", reached ? "" : "leg 3");
      if (reached) {
        MadeSweep::result(point, "tau_1_N", 100 + 3 * i + j);
      } else {
        MadeSweep::result(point, "refused_leg", 3);
        MadeSweep::result(point, "refused_t_s", 0);
      }
    }
  return sweep;
}

TEST(SweepSummary, OfACompleteGridIsExact) {
  const SweepSummary summary = summaryOf(gridSweep(0), "grid");
  const SweepOutput& force = summary.outputs[summary.primary];
  EXPECT_EQ(force.unit, "N");
  EXPECT_NEAR(force.relations[0].first_order, 18 / 19.25, 1e-12);  // Var of 3i over 5: 18; of j over 4: 1.25
  EXPECT_NEAR(force.relations[1].first_order, 1.25 / 19.25, 1e-12);
  EXPECT_TRUE(force.relations[1].acts);
  ASSERT_EQ(summary.maps.size(), 1U);
  EXPECT_EQ(summary.maps[0].values[1 * 5 + 2], 100 + 3 * 2 + 1);
  EXPECT_THAT(sweepPage(summary), HasSubstr("exact main effects"));
}

TEST(SweepSummary, OfAGridWithGapsHasNoIndices) {
  const SweepSummary summary = summaryOf(gridSweep(3), "gaps");
  EXPECT_EQ(summary.outputs[summary.primary].no_index, NoIndex::grid_not_complete);
  EXPECT_EQ(summary.refused_by_leg[2], 3);
  EXPECT_TRUE(std::isnan(summary.maps.at(0).values[0]));
  EXPECT_EQ(outputOf(summary, OutputKind::not_passed).spread.mean, 3 / 20.0);
  EXPECT_THAT(sweepPage(summary), HasSubstr("17 computed, 3 out of reach"));
  MadeSweep half = gridSweep(0);
  half.points.resize(10);  // the sweep has not ended, although these points form a grid
  EXPECT_EQ(summaryOf(half, "half").outputs.front().no_index, NoIndex::grid_not_complete);
}

MadeSweep validateSweep() {
  MadeSweep sweep = madeSweep("validate", "random", {"a", "b"}, 300);
  Dice dice(8);
  for (int k = 0; k < 300; ++k) {
    const double a = dice.roll(), b = dice.roll();
    if (k % 100 == 7) {
      sweep.add({a, b}, "error", k == 7 ? "line 1: \"a\", <b>\nbad" : "other");
      continue;
    }
    SweepPoint& point = sweep.add({a, b}, a > 0.9 ? "fail" : "pass");
    MadeSweep::check(point, "replay.position", 1e-6 * (0.2 + a), 1e-6 * 1.1, a > 0.9 ? "fail" : "pass");
    MadeSweep::check(point, "torque.pointwise", 1e-9 * b, 1e-8, "pass");
    MadeSweep::check(point, "torque.twin", nan, nan, "not_applicable");
  }
  return sweep;
}

TEST(SweepSummary, NamesTheCheckNearestToItsLimit) {
  const SweepSummary summary = summaryOf(validateSweep(), "validate");
  const SweepOutput& nearest = summary.outputs[summary.primary];
  EXPECT_EQ(nearest.name, "replay.position");
  EXPECT_NEAR(nearest.spread.max, 1.2 / 1.1, 0.02);
  EXPECT_EQ(driver(nearest), 0U);
  for (const SweepOutput& each : summary.outputs) EXPECT_NE(each.name, "torque.twin");
  EXPECT_EQ(summary.verdicts.at("error"), 3);
  ASSERT_EQ(summary.worst.size(), most_worst);
  EXPECT_EQ(summary.worst[0].verdict, "error");
  EXPECT_EQ(summary.worst[1].error, "other");
  EXPECT_EQ(summary.worst[2].verdict, "fail");  // equal texts appear once
  EXPECT_EQ(summary.worst[2].id, nearest.worst_point);
}

TEST(SweepPage, LeadsWithCountsAndDriver) {
  const std::string page = sweepPage(summaryOf(validateSweep(), "leads"));
  const std::string header = page.substr(page.find("<header"), page.find("</header>") - page.find("<header"));
  EXPECT_THAT(header, HasSubstr("300 points: "));
  EXPECT_THAT(header, HasSubstr("3 ended in an error"));
  EXPECT_THAT(header, HasSubstr("driven by a, which alone makes &gt; 99\u00a0% of its variance"));
  EXPECT_THAT(header, HasSubstr("class=\"fail\""));
  EXPECT_THAT(page, HasSubstr("ursula sweep show sweeps/made.toml 7 &gt; point-7.toml"));
  expectNoNumberless(page);
}

TEST(SweepPage, EscapesWhatOthersWrote) {
  const std::string page = sweepPage(summaryOf(validateSweep(), "escapes"));
  EXPECT_THAT(page, HasSubstr("made &lt;b&gt;by hand&lt;/b&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("made <b>by")));
  EXPECT_THAT(page, HasSubstr("line 1: &quot;a&quot;, &lt;b&gt;"));
  EXPECT_EQ(countOf(page, "<script"), 2u) << "its charts and what draws them";
}

TEST(SweepRows, RefusesNamesThatNoSweepWrites) {
  for (const char* name : {"a\x1b[31m", "a,b", "a\nb", "ψ"}) {
    MadeSweep sweep = validateSweep();
    sweep.points.front().values.front().name = name;
    EXPECT_THAT(refusal<DatabaseError>([&] { csvOf(sweep, "names"); }),
                AllOf(HasSubstr("is not a name of a result: the database is damaged"), Not(HasSubstr("\x1b"))))
        << name;
  }
}

TEST(SweepPage, QuotesAPathForTheShell) {
  MadeSweep sweep = validateSweep();
  sweep.identity.file = "my sweeps/o'neil.toml";
  EXPECT_THAT(sweepPage(summaryOf(sweep, "quotes")),
              HasSubstr("ursula sweep show &#39;my sweeps/o&#39;\\&#39;&#39;neil.toml&#39; 7"));
}

TEST(SweepPage, SaysThatPointsAreMissing) {
  MadeSweep sweep = inverseSweep(300);
  EXPECT_THAT(sweepPage(summaryOf(sweep, "whole")), Not(HasSubstr("Only 3")));
  sweep.identity.points = 1200;
  EXPECT_THAT(sweepPage(summaryOf(sweep, "missing")), HasSubstr("Only 300 of 1,200 points are there"));
  sweep.identity.shards = 4;
  EXPECT_THAT(sweepPage(summaryOf(sweep, "shard")), HasSubstr("This is shard 1 of 4 alone, 300 of 1,200 points"));
}

TEST(SweepPage, OfNothingSaysSo) {
  const SweepSummary empty = summaryOf(madeSweep("inverse", "random", {"x"}, 10), "empty");
  EXPECT_EQ(empty.primary, empty.outputs.size());
  EXPECT_THAT(sweepPage(empty), HasSubstr("holds no point yet"));
  expectNoNumberless(sweepPage(empty));
  MadeSweep refused = gridSweep(20), one = gridSweep(0), errors = madeSweep("validate", "sobol", {"x"}, 1);
  one.points.resize(1);
  errors.add({1}, "error", "all bad");
  for (const MadeSweep& each : {refused, one, errors}) expectNoNumberless(sweepPage(summaryOf(each, "little")));
  EXPECT_THAT(sweepPage(summaryOf(refused, "refused")),
              HasSubstr("20 points, all out of reach. No point has a result."));
}

TEST(SweepPage, OfManyNumbersShowsTheStrongest) {
  std::vector<std::string> keys;
  for (int k = 0; k < 60; ++k) keys.push_back("number." + std::to_string(k));
  MadeSweep sweep = madeSweep("inverse", "random", keys, 400);
  Dice dice(1);
  for (int k = 0; k < 400; ++k) {
    std::vector<double> x;
    for (int p = 0; p < 60; ++p) x.push_back(dice.roll());
    MadeSweep::result(sweep.add(x), "tau_1_Nm", 5 * x[41] + x[17]);
  }
  const std::string page = sweepPage(summaryOf(sweep, "many"));
  const std::size_t table = page.find("id=\"correlations\"");
  const std::string correlations = page.substr(table, page.find("</section>", table) - table);
  EXPECT_THAT(correlations, HasSubstr("40 numbers with the weakest relations are left out"));
  EXPECT_LT(correlations.find(">number 41<"), correlations.find(">number 17<"));
}

TEST(SweepPage, IsTheSameTwice) {
  const MadeSweep sweep = inverseSweep(2500);
  const SweepSummary summary = summaryOf(sweep, "twice");
  const std::string page = sweepPage(summary);
  EXPECT_EQ(page, sweepPage(summaryOf(sweep, "twice")));
  ASSERT_FALSE(summary.scatters.empty());
  EXPECT_THAT(page, HasSubstr("<section id=\"scatter\">"));
  EXPECT_EQ(countOf(page, "data-plot="), summary.scatters.size());
  for (const Scatter& each : summary.scatters) EXPECT_EQ(each.x.size(), most_scattered);
}

TEST(SweepCsv, HasARowForEachPoint) {
  MadeSweep sweep = madeSweep("inverse", "random", {"x,1", "y"}, 2);
  MadeSweep::result(sweep.add({0.1, 1e300}), "tau_1_Nm", 1.0 / 3);
  sweep.add({2, -0.5}, "error", "said \"no\",\nthen ended");
  EXPECT_EQ(csvOf(sweep, "csv"),
            "id,verdict,\"x,1\",y,tau_1_Nm,error\n"
            "0,pass,0.1,1e+300,0.3333333333333333,\n"
            "1,error,2,-0.5,,\"said \"\"no\"\",\nthen ended\"\n");
}

TEST(SweepCsv, HasLimitsAndVerdictsOfChecks) {
  MadeSweep sweep = madeSweep("validate", "random", {"x"}, 2);
  SweepPoint& point = sweep.add({1}, "fail");
  MadeSweep::check(point, "replay.position", nan, nan, "not_applicable");
  MadeSweep::check(point, "torque.twin", 2, 1, "fail");
  MadeSweep::check(sweep.add({3}), "torque.twin", 0.5, 1, "pass");
  EXPECT_EQ(csvOf(sweep, "csv_checks"),
            "id,verdict,x,replay.position,replay.position.limit,replay.position.verdict,torque.twin,torque.twin.limit,"
            "torque.twin.verdict,error\n"
            "0,fail,1,,,not_applicable,2,1,fail,\n"
            "1,pass,3,,,,0.5,1,pass,\n");
}

TEST(SweepCsv, LeavesOutTimesOfComputing) {
  MadeSweep sweep = inverseSweep(50);
  const std::string before = csvOf(sweep, "times");
  for (SweepPoint& point : sweep.points) point.seconds = 3;
  EXPECT_EQ(csvOf(sweep, "times"), before);
  sweep.points[20].values[3].value += 1e-9;
  EXPECT_NE(csvOf(sweep, "times"), before);
}

}  // namespace
}  // namespace ursula
