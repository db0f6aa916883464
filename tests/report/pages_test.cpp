// The pages of compare and prove, and a suite's files: their texts, their size, and that no text becomes markup.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "parts/compare/compare_page.h"
#include "report/files/written_files.h"
#include "report/page/picture.h"
#include "report/page/plots.h"
#include "report/page/singular.h"
#include "tests/base/temporary_folder.h"
#include "tests/report/page_samples.h"
#include "tests/report/report_samples.h"
#include "tests/report/text_parts.h"

namespace ursula {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The comparison of the two sample histories, with its page.
struct Compared {
  std::vector<ChannelCharts> charts;
  Comparison comparison;
  std::string html;

  explicit Compared(const TimeSeries& test, const CompareOptions& options = {}) {
    const TimeSeries reference = test::passedSample().timeseries;
    comparison =
        compare(reference, test, options, [this](const ChannelComparison& channel, const ChannelCurves& curves) {
          charts.push_back(channelCharts(channel, curves, 1));
        });
    html = comparisonHtml(comparison, charts, {"reference", "test"});
  }
};

TEST(ComparePage, leadsWithTheVerdictAndTheWorstChannel) {
  const Compared compared(test::comparedSample());
  EXPECT_TRUE(has(compared.html, "FAIL"));
  EXPECT_TRUE(has(comparisonSentence(compared.comparison), "The test differs from the reference in 1 of "));
  EXPECT_TRUE(has(comparisonSentence(compared.comparison), ". The torque of motor 3 is off by "))
      << comparisonSentence(compared.comparison);
  EXPECT_FALSE(has(comparisonSentence(compared.comparison), "tau_3_Nm"));
  EXPECT_LT(compared.html.find("<span class=\"title\">torque of motor 3<"),
            compared.html.find("<span class=\"title\">torque of motor 1<"));
  EXPECT_EQ(countOf(compared.html, "<details class=\"group "), compared.comparison.channels.size());
  EXPECT_TRUE(has(compared.html, "<code>another_m_s</code>")) << "what only one side has";
  EXPECT_TRUE(has(compared.html, "<code>closure_v_m_s</code>"));
}

TEST(ComparePage, drawsBothCurvesTheDifferenceAndTheTube) {
  const Compared compared(test::comparedSample());
  const auto channel = std::find_if(compared.comparison.channels.begin(), compared.comparison.channels.end(),
                                    [](const ChannelComparison& each) { return each.name == "tau_3_Nm"; });
  ASSERT_NE(channel, compared.comparison.channels.end());
  const ChannelCharts& charts =
      compared.charts.at(static_cast<std::size_t>(channel - compared.comparison.channels.begin()));
  ASSERT_EQ(charts.curves.lines.size(), 4u);
  ASSERT_EQ(charts.difference.lines.size(), 3u);
  EXPECT_TRUE(charts.curves.tube && charts.difference.tube);
  double largest = 0;
  for (std::size_t k = 0; k < charts.curves.x.size(); ++k) {
    const double reference = charts.curves.lines[2].values[k], test = charts.curves.lines[3].values[k];
    EXPECT_NEAR(charts.difference.lines[2].values[k], test - reference, 1e-12);
    EXPECT_NEAR(charts.difference.lines[0].values[k], channel->tolerance, 1e-3 * channel->tolerance);
    largest = std::max(largest, std::abs(test - reference));
  }
  EXPECT_DOUBLE_EQ(largest, channel->max_error);
  EXPECT_GT(largest, 1);
}

TEST(ComparePage, ofTheSameIsAPass) {
  const Compared same(test::passedSample().timeseries);
  EXPECT_EQ(same.comparison.verdict, Verdict::pass);
  EXPECT_TRUE(has(same.html, "The test is the same as the reference in "));
  EXPECT_FALSE(has(same.html, "FAIL"));
}

/// The tube of a tolerance in time is wider while the reference changes.
TEST(ComparePage, drawsTheToleranceInTime) {
  CompareOptions options;
  options.time_tolerance = 0.05;
  options.columns = {"tau_1_Nm"};
  const Compared compared(test::passedSample().timeseries, options);
  ASSERT_EQ(compared.charts.size(), 1u);
  double widest = 0;
  const report::Plot& plot = compared.charts[0].curves;
  for (std::size_t k = 0; k < plot.x.size(); ++k)
    widest = std::max(widest, plot.lines[0].values[k] - plot.lines[1].values[k]);
  EXPECT_GT(widest, 20);
}

/// The histories have sixty seconds at a kilohertz in a hundred channels.
TEST(ComparePage, ofMuchDataStaysSmall) {
  TimeSeries series;
  std::vector<double> t(60001);
  for (std::size_t k = 0; k < t.size(); ++k) t[k] = 1e-3 * static_cast<double>(k);
  series.add("t_s", t);
  for (int channel = 0; channel < 100; ++channel) {
    std::vector<double> values(t.size());
    for (std::size_t k = 0; k < t.size(); ++k) values[k] = std::sin(t[k] + channel) * 1234.5678;
    series.add("channel" + std::to_string(channel) + "_Nm", values);
  }
  const TemporaryFolder folder;
  writeComparison(series, series, {}, {"a", "b"}, folder.path());
  EXPECT_LT(std::filesystem::file_size(folder.path() / "compare.html"), 3'000'000u);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "junit.xml"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "compare.csv"));
}

TEST(ProvePage, saysWhichCheckCatchesWhatBySignsToo) {
  const std::string html = proveHtml(test::proveSample(false));
  EXPECT_TRUE(has(html, "Each of 3 defects was caught, and each of 2 checks is needed for that."));
  EXPECT_EQ(countOf(html, "<td class=\"reason\">Efforts against Simbody"), 2u);
  EXPECT_EQ(countOf(html, "<summary>and 1 more</summary>Maximal coordinates"), 1u);
  EXPECT_FALSE(has(html, "upright\"")) << "no head stands upright";
  EXPECT_FALSE(has(html, "FAIL"));
  EXPECT_FALSE(has(html, "1.001 <b>")) << "a name became markup";
  EXPECT_TRUE(has(html, "does not show"));
}

TEST(ComparePage, saysColumnsInWords) {
  for (const auto& [column, words] : {std::pair("tau_3_N", "force of motor 3"),
                                      {"tau_3_Nm", "torque of motor 3"},
                                      {"simbody_tau_1_N", "Simbody's force of motor 1"},
                                      {"limit_tau_Nm", "limit of the torque of motors"},
                                      {"sim_p_x_m", "simulated position of P, x"},
                                      {"q_w", "orientation, w"},
                                      {"q_2_rad", "coordinate of motor 2"},
                                      {"qddot_1_rad_s2", "acceleration of motor 1"},
                                      {"d_1_m", "displacement of leg 1"},
                                      {"reaction_fA_x_1_N", "force at the base of leg 1, x"},
                                      {"error_acceleration_m_s2", "error of Simbody's acceleration"},
                                      {"front_pitch_a_rad", "front pitch a"}})
    EXPECT_EQ(channelWords(column), words);
  EXPECT_TRUE(isDerived("error_p_m") && isDerived("simbody_tau_1_N"));
  EXPECT_FALSE(isDerived("p_x_m") || isDerived("tau_1_N") || isDerived("q_w"));
}

TEST(ProvePage, ofADefectThatTooFewCatchFails) {
  const ProveResult weak = test::proveSample(true);
  EXPECT_FALSE(isProved(weak));
  const std::string html = proveHtml(weak);
  EXPECT_TRUE(has(html, "1 of 3 defects were caught on fewer formulations than they must."));
  EXPECT_TRUE(has(html, "FAIL"));
}

TEST(ProvePage, needsNoScenarioOfTheProgramToFail) {
  ProveResult random = test::proveSample(false);
  random.proof.reset();
  EXPECT_TRUE(isProved(random));
  random.random.failed = {"seed 9: torque.pointwise"};
  EXPECT_FALSE(isProved(random));
  EXPECT_TRUE(has(proveHtml(random), "false alarm: seed 9"));
}

TEST(SuiteFiles, haveCountsAndWallTimes) {
  const auto json =
      nlohmann::json::parse(report::suiteJson({suiteEntry(test::passedSample(), "a", {1.25, ""}),
                                               suiteEntry(test::failedSample(), "b", {2.5, ""}),
                                               {"bad", Verdict::fail, "", {}, "no such luck", {}, "", {}, {}}}));
  EXPECT_EQ(json["verdict"], "fail");
  EXPECT_EQ(json["counts"],
            (nlohmann::json{{"scenarios", 3}, {"pass", 1}, {"fail", 1}, {"inconclusive", 0}, {"error", 1}}));
  EXPECT_EQ(json["seconds"], 3.75);
  EXPECT_EQ(json["scenarios"][0]["seconds"], 1.25);
  EXPECT_EQ(json["scenarios"][0]["checks"]["pass"], 8);
  EXPECT_EQ(json["scenarios"][1]["decided_by"], "torque.pointwise");
  EXPECT_EQ(json["scenarios"][2]["error"], "no such luck");
  EXPECT_EQ(nlohmann::json::parse(report::suiteJson({}))["verdict"], "fail") << "nothing validated is no success";
}

/// Rows come before the map, each with its cause; each machine has the words of its own kind.
TEST(SuiteFiles, indexHasTheCauseInTheRowAndNoLegsOfAMechanism) {
  SuiteEntry mechanism = suiteEntry(test::failedSample(), "m");
  mechanism.kind = "mechanism";
  mechanism.cause = "likely cause: gravity z 0 +- 2e-14 m/s^2 instead of -9.81";
  for (Check& check : mechanism.checks)
    if (check.name == "torque.pointwise") check.name = "torque.twin";
  const std::string html = report::indexHtml({mechanism});
  EXPECT_TRUE(has(html,
                  "<td class=\"reason\">likely cause: gravity z 0\u00a0±\u00a02\u00a0×\u00a010⁻¹⁴\u00a0m/s² instead of "
                  "−9.81</td>"));
  EXPECT_TRUE(has(html, "<th scope=\"row\">Simbody, another spanning tree</th>"));
  EXPECT_FALSE(has(html, "through leg"));
  EXPECT_LT(html.find("likely cause"), html.find("class=\"map\""));
  mechanism.kind = "manipulator";
  EXPECT_TRUE(has(report::indexHtml({mechanism}), "through leg")) << "where the words belong";
}

TEST(SuiteFiles, reportsLeadToTheIndexOnlyWhereThereIsOne) {
  EXPECT_FALSE(has(report::reportHtml(test::passedSample()), "../index.html"));
  EXPECT_TRUE(has(report::reportHtml(test::passedSample(), Place::in_suite), "href=\"../index.html\""));
}

TEST(LongMotion, makesASmallReportThatKeepsThePeaks) {
  const ValidationResult result = test::longSample();
  ASSERT_EQ(result.timeseries.rows(), 60001u);
  EXPECT_LT(report::reportHtml(result).size(), 3'000'000u);
}

/// Six legs of the paper's machine at the sample's true poses of base and platform.
TEST(Singular, directionsAreThoseThatTheMotorsResistLeast) {
  const ValidationResult result = test::passedSample();
  const std::shared_ptr<const Picture> picture = makePicture(*result.asked, {0.0, 1.5, 3.0});
  const auto weak = report::weakDirections(*picture);
  ASSERT_TRUE(weak.has_value());
  ASSERT_EQ(weak->size(), 3u);
  double size = 0;
  for (const Vector3d& point : picture->platform_points) size = std::max(size, point.norm());
  for (std::size_t k = 0; k < weak->size(); ++k) {
    const report::WeakDirections& at = (*weak)[k];
    EXPECT_NEAR(at.yielding.norm(), 1, 1e-12);
    EXPECT_NEAR(at.lost.norm(), 1, 1e-12);
    // This motion needs the smallest motor rates: here it is compared with each single axis.
    const auto resistance = [&](const Eigen::Matrix<double, 6, 1>& motion) {
      double sum = 0;
      for (const Picture::Leg& leg : picture->legs) {
        const Vector3d B = leg.links.back().to[k], x = leg.joints[0].axes[1][k];
        const Vector3d velocity = motion.tail<3>() + (motion.head<3>() / size).cross(B - picture->p[k]);
        sum += std::pow(x.dot(velocity), 2);
      }
      return std::sqrt(sum);
    };
    for (int axis = 0; axis < 6; ++axis)
      EXPECT_LT(resistance(at.yielding), resistance(Eigen::Matrix<double, 6, 1>::Unit(axis))) << k << " " << axis;
    // The lost direction is normal to the plane of its leg.
    EXPECT_NEAR(std::abs(at.lost.dot(picture->legs[at.leg].joints[0].axes[1][k])), 1, 1e-12);
  }
}

TEST(Singular, directionsOfOtherLegsAreNotGuessed) {
  EXPECT_FALSE(report::weakDirections(*pictureOf(test::externalSample())).has_value());
}

TEST(Sparkline, followsTheReplaysErrorAndLeavesGaps) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> trend = report::trendOf(test::passedSample().timeseries);
  ASSERT_EQ(trend.size(), 40u);
  EXPECT_GT(trend.back(), trend[20]);
  EXPECT_TRUE(has(report::sparkline(trend), "<path d=\"M"));
  EXPECT_EQ(countOf(report::sparkline({1, 2, nan, 3, 4}), "M"), 2u);
  EXPECT_EQ(report::sparkline({0, nan}), "");
  EXPECT_TRUE(report::trendOf(test::failedSample().timeseries).empty());
}

}  // namespace
}  // namespace ursula
