// Reads the files of a result back with other parsers: nlohmann::json, Boost's XML reader and the project's CSV reader.
// report_browser_test.mjs tests the HTML in a browser.

#include "report/files/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/csv.h"
#include "report/files/written_files.h"
#include "report/page/html_template.h"
#include "report/page/plots.h"
#include "report/text/quantity.h"
#include "report/text/result_facts.h"
#include "report/text/text.h"
#include "tests/report/report_samples.h"
#include "tests/report/text_parts.h"
#include "tests/support/numbers.h"

namespace ursula {
namespace {

using boost::property_tree::ptree;

std::string contentOf(const std::filesystem::path& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

class ReportFiles : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(dir_); }
  void TearDown() override { std::filesystem::remove_all(dir_); }
  std::filesystem::path dir_ = std::filesystem::path(testing::TempDir()) /
                               (std::string("ursula_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(ReportFiles, areFourAndRepeatable) {
  writeResults(test::passedSample(), dir_ / "a");
  writeResults(test::passedSample(), dir_ / "b");
  for (const char* file : {"summary.json", "timeseries.csv", "junit.xml", "report.html"}) {
    EXPECT_FALSE(contentOf(dir_ / "a" / file).empty()) << file;
    EXPECT_EQ(contentOf(dir_ / "a" / file), contentOf(dir_ / "b" / file)) << file;
  }
  const CsvTable table = readCsv(dir_ / "a" / "timeseries.csv");
  EXPECT_EQ(table.names, test::passedSample().timeseries.names);
  EXPECT_EQ(table.at("error_p_m"), *test::passedSample().timeseries.find("error_p_m"));
}

TEST_F(ReportFiles, areTheOldOnesWhereWritingFailed) {
  writeResults(test::passedSample(), dir_);
  const std::string old = contentOf(dir_ / "summary.json");
  std::filesystem::remove(dir_ / "report.html");
  std::filesystem::create_directories(dir_ / "report.html" / "in the way");
  EXPECT_THROW(writeResults(test::failedSample(), dir_), std::exception);
  EXPECT_EQ(contentOf(dir_ / "summary.json"), old);
}

TEST_F(ReportFiles, ofASuiteAreIndexAndJunit) {
  const ValidationResult passed = test::passedSample();
  test::writeSuiteIndex({suiteEntry(passed, "sub folder/ä&b")}, dir_);
  const std::string index = contentOf(dir_ / "index.html");
  EXPECT_NE(index.find("href=\"sub%20folder/%C3%A4%26b/report.html\""), std::string::npos);
  EXPECT_NE(index.find("1 of 1 scenario passed"), std::string::npos);
  EXPECT_NE(index.find("Position along the motion"), std::string::npos);  // the check closest to its limit
  EXPECT_NE(index.find("<td data-label=\"Dominant error\">amplification</td>"),
            std::string::npos);  // the dominant error
  const ptree suite = parsedXml(contentOf(dir_ / "junit.xml")).get_child("testsuites.testsuite.<xmlattr>");
  EXPECT_EQ(suite.get<std::string>("name"), "paper-helix");
  EXPECT_EQ(suite.count("time"), 0u) << "nobody measured it";
}

TEST(Summary, holdsTheContract) {
  const auto json = nlohmann::json::parse(report::summaryJson(test::failedSample()));
  EXPECT_EQ(json["scenario"], "torques of another solver");
  EXPECT_EQ(json["verdict"], "fail");
  EXPECT_EQ(json["checks"].size(), 9u);
  EXPECT_EQ(json["checks"][0]["value"], 41.3);
  for (const char* key : {"name", "value", "limit", "unit", "verdict", "basis", "why"}) {
    EXPECT_TRUE(json["checks"][0].contains(key)) << key;
  }
  EXPECT_EQ(json["provenance"]["commit"], "478470f");
}

TEST(Summary, writesNullForWhatIsNotFinite) {
  const auto json = nlohmann::json::parse(report::summaryJson(test::failedSample()));
  EXPECT_TRUE(json["checks"][8]["value"].is_null());
  EXPECT_TRUE(json["checks"][8]["limit"].is_null());
  EXPECT_EQ(json["checks"][8]["why"], "the torques end at t = 2.1 s, the motion at t = 3 s");
}

TEST(Summary, keepsBothTextsOfARepeatedKey) {
  ValidationResult result;
  result.findings = {{"steps", "3"}, {"steps", "4"}};
  EXPECT_EQ(nlohmann::json::parse(report::summaryJson(result))["findings"]["steps"], "3; 4");
}

TEST(Reason, namesTheWorstCheckAndHowFarItIs) {
  const auto sentence = [](const ValidationResult& result) { return reason(result.verdict, result.checks); };
  EXPECT_EQ(sentence(test::passedSample()),
            "8 of 8 checks held; the closest to its limit, replay.position, is at 81 % of its limit.");
  EXPECT_EQ(sentence(test::failedSample()),
            "3 of 9 checks failed, the worst torque.pointwise, which is at 1.01e+11 times its limit.");
  EXPECT_EQ(sentence(test::inconclusiveSample()),
            "Nothing failed, but 1 of 8 checks cannot be judged here: replay.orientation.");
  EXPECT_EQ(reason(Verdict::fail, {}), "No check was made.");
}

TEST(LimitShare, isDefinedOnlyWhereItMeansSomething) {
  const auto share = [](double value, double limit) { return limitShare(judged("", value, limit, "", "", "")); };
  EXPECT_EQ(share(1, 4), 0.25);
  EXPECT_EQ(share(0, 0), 0);
  EXPECT_EQ(share(-1, 4), 0);
  EXPECT_TRUE(std::isinf(share(1, 0)));
  EXPECT_TRUE(std::isnan(share(nan, 1)));
  EXPECT_EQ(share(std::numeric_limits<double>::infinity(), 1), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(share(-2, -1)));
}

TEST(Standing, saysWhatNumbersCannot) {
  const auto words = [](double value, double limit) { return standing(judged("", value, limit, "", "", "")); };
  EXPECT_EQ(words(nan, 1), "has no value");
  EXPECT_EQ(words(std::numeric_limits<double>::infinity(), 1), "is infinite");
  EXPECT_EQ(words(1, nan), "cannot be set against its limit");
  EXPECT_EQ(words(1, 0), "exceeds its limit of 0");
  EXPECT_EQ(words(1, 2), "is at 50 % of its limit");
  EXPECT_EQ(words(3, 2), "is at 1.5 times its limit");
}

TEST(Plots, areThoseWhoseColumnsAreThere) {
  const auto titles = [](const ValidationResult& result) {
    std::vector<std::string> found;
    for (const report::Plot& plot : report::plots(result)) found.push_back(plot.title);
    return found;
  };
  EXPECT_EQ(titles(test::passedSample()),
            (std::vector<std::string>{
                "Sources of the replay's error", "Efforts against Simbody's, each motor",
                "Replay: simulated against commanded pose", "Closure of the loops", "Efforts of the motors",
                "Motor 1: effort less expected", "Motor 2: effort less expected", "Motor 3: effort less expected",
                "Motor 4: effort less expected", "Motor 5: effort less expected", "Motor 6: effort less expected",
                "Position of P", "Orientation of the platform", "Work against precision", "Amplification"}));
  EXPECT_EQ(titles(test::failedSample()), std::vector<std::string>{"Efforts of the motors"});
  EXPECT_TRUE(titles({}).empty());
}

TEST(Plots, chooseLogarithmicAxesByTheData) {
  const std::vector<report::Plot> plots = report::plots(test::passedSample());
  const auto plot = [&plots](const std::string& title) {
    return *std::find_if(plots.begin(), plots.end(), [&title](const auto& each) { return each.title == title; });
  };
  EXPECT_FALSE(plot("Efforts of the motors").log_y);
  EXPECT_TRUE(plot("Closure of the loops").log_y);
  EXPECT_TRUE(plot("Work against precision").log_x && plot("Work against precision").log_y);  // logarithmic in both
  EXPECT_TRUE(!plot("Amplification").log_x && plot("Amplification").log_y);                   // over time
  ValidationResult narrow;
  narrow.curves = {{Curve::About::numerics, "", "n", false, {1, 2}, {{"error", "", {5, 6}}}}};
  EXPECT_FALSE(report::plots(narrow)[0].log_x || report::plots(narrow)[0].log_y);
}

/// The limit lines in the charts of the motors' deviations.
std::vector<report::Line> effortLimits(const ValidationResult& result) {
  std::vector<report::Line> out;
  for (const report::Plot& plot : report::plots(result))
    if (plot.title == "Efforts against Simbody's, each motor" ||
        plot.title.find("effort less expected") != std::string::npos)
      for (const report::Line& line : plot.lines)
        if (line.stroke == report::Stroke::limit) out.push_back(line);
  return out;
}

TEST(Plots, holdEffortsAgainstTheToleranceThatDecides) {
  ValidationResult result = test::passedSample();
  result.deviation = EffortDeviation{};
  for (const report::Line& line : effortLimits(result)) EXPECT_THAT(line.label, testing::AnyOf("limit", "− limit"));
  result.deviation->allowed = 251;
  const std::vector<report::Line> limits = effortLimits(result);
  ASSERT_GE(limits.size(), 3u);
  for (const report::Line& line : limits) {
    EXPECT_THAT(line.label, testing::HasSubstr("your tolerance"));
    EXPECT_EQ(std::abs(line.values.front()), 251);
  }
}

TEST(Plots, ascendInXAndDropWhatHasNone) {
  const std::vector<report::Plot> plots = report::plots(test::hostileSample());
  ASSERT_EQ(plots.size(), 3u);
  EXPECT_EQ(plots[2].x, (std::vector<double>{1, 3}));
  EXPECT_EQ(plots[2].lines[0].values[1], 1);
  EXPECT_EQ(report::inWords(plots[0]), "Nothing to draw: every value is zero or not finite.");
}

TEST(Html, holdsVerdictAndChecksWithoutScript) {
  const std::string html = report::reportHtml(test::failedSample());
  EXPECT_NE(html.find("FAIL"), std::string::npos);
  EXPECT_EQ(countOf(html, "<details class=\"check "), 9u);
  EXPECT_EQ(countOf(html, "<details class=\"check fail\" open"), 3u);
  EXPECT_LT(html.find("<details class=\"check fail\""), html.find("<details class=\"check pass\""));
  EXPECT_EQ(countOf(html, "<noscript>A script draws this chart."), countOf(html, "<div class=\"chart\""));
}

TEST(Html, leadsToWhereTheEffortsDeviateMostOfAllEngines) {
  ValidationResult result = test::passedSample();
  EXPECT_EQ(countOf(report::reportHtml(result), "largest effort deviation, "), 0u) << "no effort was compared";
  EffortDeviation& worst = result.deviation.emplace();
  worst.largest = 2e-10, worst.t = 2.5, worst.where = "leg 3", worst.largest_effort = 25000;
  const std::string event = R"({"t":2.5,"what":"largest effort deviation, )" + report::quantity(2e-10, "N m") + "\"}";
  EXPECT_EQ(countOf(report::reportHtml(result), event), 1u) << event;
}

TEST(Html, neverLetsTextBecomeMarkup) {
  const std::string html = report::reportHtml(test::hostileSample());
  EXPECT_EQ(countOf(html, "<script>alert"), 0u);
  EXPECT_EQ(countOf(html, "</script>"), 2u);
  EXPECT_EQ(countOf(html, "<!--"), 0u);
}

TEST(Plots, areThinnedForTheEyeWithoutLosingAPeak) {
  report::Plot plot;
  plot.lines.emplace_back();
  for (int i = 0; i < 60000; ++i) {
    plot.x.push_back(i);
    plot.lines[0].values.push_back(i == 34567 ? 1e3 : i == 45678 ? nan : std::sin(i));
  }
  const report::Plot thin = report::thinned(plot, 500);
  ASSERT_EQ(thin.x.size(), 1000u);
  EXPECT_EQ(thin.x.front(), 0);
  EXPECT_EQ(thin.x.back(), 59999);
  EXPECT_EQ(*std::max_element(thin.lines[0].values.begin(), thin.lines[0].values.end()), 1e3);
  EXPECT_TRUE(std::is_sorted(thin.x.begin(), thin.x.end()));
  EXPECT_EQ(report::thinned(plot, 30000).x.size(), 60000u);
}

/// The text with plain spaces instead of the no-break spaces between numbers and units.
std::string plain(std::string text) {
  const std::string joined = "\u00A0";
  for (auto at = text.find(joined); at != std::string::npos; at = text.find(joined))
    text.replace(at, joined.size(), " ");
  return text;
}

TEST(Quantity, hasOneUnitForWhatIsReadSideBySide) {
  const auto texts = [](const std::vector<double>& values, const char* unit, int digits) {
    const report::SideBySide all = report::sideBySide(values, unit, digits);
    std::vector<std::string> out;
    for (std::size_t k = 0; k < values.size(); ++k) out.push_back(plain(all.text(k)));
    return out;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(texts({-0.1829, 72.02}, "N m", 4), (Texts{"-0.18 N·m", "72.02 N·m"}));
  EXPECT_EQ(texts({7.8e-16, 60.44}, "N m", 4), (Texts{"0 N·m", "60.44 N·m"})) << "rounding beside a torque";
  EXPECT_EQ(texts({-4.0968, -4.0797}, "N m", 4), (Texts{"-4.097 N·m", "-4.080 N·m"})) << "the same decimals";
  EXPECT_EQ(texts({1131.2, 1105.7}, "N", 4), (Texts{"1.131 kN", "1.106 kN"}));
  EXPECT_EQ(texts({999.6, 3}, "N", 3), (Texts{"1 kN", "0 kN"})) << "as rounded";
  EXPECT_EQ(texts({2, 3}, "N", 4), (Texts{"2 N", "3 N"}));
  EXPECT_EQ(texts({nan, 3}, "", 4), (Texts{"none", "3"}));
  EXPECT_EQ(texts({0, 0}, "N", 4), (Texts{"0 N", "0 N"}));
}

TEST(Plots, areDescribedWithAPrefix) {
  report::Plot plot;
  plot.x_label = "t (s)";
  plot.over_time = true;
  plot.x = {0, 0.5};
  plot.lines = {{"τ", "N·m", 0, report::Stroke::line, {0, 31990}}};
  EXPECT_EQ(plain(report::inWords(plot)), "Largest: τ = 31.99 kN·m at t = 0.5 s.");
  plot.lines = {{"error", "m", 0, report::Stroke::line, {-1.523e-11, 0}}};
  EXPECT_EQ(plain(report::inWords(plot)), "Largest: error = −15.23 pm at t = 0 s.");
  plot.lines[0].unit = "1";
  EXPECT_EQ(plain(report::inWords(plot)), "Largest: error = −1.523 × 10⁻¹¹ at t = 0 s.");
}

TEST(Quantity, takesAPrefixAndSaysWhatIsNoNumber) {
  const auto quantity = [](double value, const char* unit) { return plain(report::quantity(value, unit)); };
  EXPECT_EQ(quantity(7.7e-12, "m"), "7.7 pm");
  EXPECT_EQ(quantity(0.0163, "N m"), "16.3 mN·m");
  EXPECT_EQ(quantity(2306, "N m"), "2.31 kN·m");
  EXPECT_EQ(quantity(999.96, "N"), "1 kN");
  EXPECT_EQ(quantity(60, "s"), "60 s");
  EXPECT_EQ(quantity(3600, "s"), "3600 s");
  EXPECT_EQ(quantity(1e-20, "m"), "10⁻²⁰ m");
  EXPECT_EQ(quantity(3.2e-15, ""), "3.2 × 10⁻¹⁵");
  EXPECT_EQ(quantity(0, "m/s^2"), "0 m/s²");
  EXPECT_EQ(quantity(nan, "m"), "none");
}

TEST(Sentence, saysWhatWasFound) {
  EXPECT_EQ(plain(report::sentence(test::passedSample())),
            "The NOC's efforts drive Simbody's loop along the helix to 2.9 nm in 3 s; Simbody's own inverse dynamics "
            "agree to 1.3 × 10⁻¹⁵ of the largest effort.");
  ValidationResult wrong = test::failedSample();
  EXPECT_EQ(plain(report::sentence(wrong)),
            "The NOC's efforts do not hold. Efforts against Simbody: off by 41.3 N·m, where 410 pN·m is the limit.");
  wrong.cause_words = {"", "a factor of 1.001 on leg 3"};
  EXPECT_EQ(plain(report::sentence(wrong)), "The NOC's efforts are wrong. Likely cause: a factor of 1.001 on leg 3.");
  EXPECT_EQ(plain(report::sentence(test::inconclusiveSample())),
            "Nothing failed, but one check cannot be judged here: amplification 3.1 × 10¹⁴ leaves no digit of a double "
            "to judge by.");
}

TEST(HtmlTemplate, isFilledOnceAndCompletely) {
  EXPECT_EQ(report::rendered("a{{b}}c", {{"b", "{{d}}"}}), "a{{d}}c");
  EXPECT_THROW(report::rendered("{{b}}", {{"c", ""}}), std::logic_error);
  EXPECT_THROW(report::rendered("{{b", {{"b", ""}}), std::logic_error);
  EXPECT_THROW(report::rendered("{{#b}}", {{"b", true}}), std::logic_error);
}

TEST(HtmlTemplate, escapesAsTheRestOfThePagesDoes) {
  const std::string odd = "<a b='\"&>\n\x01\xff/=`";
  EXPECT_EQ(report::rendered("{{b}}", {{"b", odd}}), report::escaped(odd));
  EXPECT_EQ(report::rendered("{{{b}}}", {{"b", odd}}), odd);
}

TEST(HtmlTemplate, repeatsListsAndLeavesOutWhatDoesNotHold) {
  const auto row = [](int n) {
    return report::HtmlValue{{"n", n}, {"odd", n % 2 == 1}, {"word", n == 2 ? "two" : ""}};
  };
  EXPECT_EQ(report::rendered("{{#rows}}<{{n}}{{#odd}} odd{{/odd}}{{^word}} no word{{/word}}{{word}}>{{/rows}}",
                             {{"rows", report::listOf(std::vector<int>{0, 1, 2}, row)}}),
            "<0 no word><1 odd no word><2two>");
  EXPECT_EQ(report::rendered("a{{#rows}}<{{n}}>{{/rows}}", {{"rows", std::vector<report::HtmlValue>()}}), "a");
}

TEST(Text, escapesMarkup) { EXPECT_EQ(report::escaped("<a b='\"&>\n"), "&lt;a b=&#39;&quot;&amp;&gt;\n"); }

}  // namespace
}  // namespace ursula
