#include "report/page/heat_map.h"

#include <cmath>
#include <limits>

#include "report/text/quantity.h"
#include "tests/support/matchers.h"

namespace ursula::report {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

TEST(HeatScale, GoesFromTheLeastToTheLargest) {
  const HeatScale scale({1, 100, 10, infinite, std::nanf("")}, true);
  EXPECT_EQ(scale.colourOf(1), 0);
  EXPECT_LT(scale.colourOf(1), scale.colourOf(3));
  EXPECT_EQ(scale.colourOf(infinite), scale.colourOf(1e9));
  EXPECT_NEAR(scale.at(0), 1, 1e-12);
  EXPECT_TRUE(HeatScale({infinite}, false).empty());
}

TEST(HeatMap, DrawsWhatIsNotThereInGrey) {
  HeatMap map{"a < b", {"x", {0, 1}}, {"y", {0, 5}}, {1, 2, 3, 4}};
  const HeatScale scale(map.values, false);
  EXPECT_THAT(heatMapPanel(map, scale, 0, 0), Not(HasSubstr(heat_map_nothing)));
  EXPECT_THAT(heatMapPanel(map, scale, 0, 0), HasSubstr("a &lt; b"));
  map.values[2] = std::nanf("");
  EXPECT_THAT(heatMapPanel(map, scale, 0, 0), HasSubstr(heat_map_nothing));
}

TEST(HeatMap, SaysItsNumbersInTheUnitThatSuitsTheLargest) {
  HeatMap map{"torque", {"x", {0, 1}}, {"y", {0, 5}}, {2740, 11900, 51300, 962000}, {}, "N m"};
  const std::string svg = heatMapPanel(map, HeatScale(map.values, true), 0, 0);
  EXPECT_THAT(svg, HasSubstr(">torque, kN·m<"));
  EXPECT_THAT(svg, HasSubstr(">2.74<"));
  EXPECT_THAT(svg, Not(HasSubstr("10⁵")));
  map.unit = "";
  EXPECT_THAT(heatMapPanel(map, HeatScale(map.values, true), 0, 0), HasSubstr(">torque<"));
}

TEST(HeatMap, ShowsWhatIsNothingBesideItsRangeAsZero) {
  HeatMap map{"margin", {"x", {0, 1}}, {"y", {0, 5}}, {3.3e-5F, 0.1F, 0.2F, 0.42F}, {}, "m"};
  EXPECT_THAT(heatMapPanel(map, HeatScale(map.values, false), 0, 0), HasSubstr(">0<"));
  EXPECT_THAT(heatMapPanel(map, HeatScale(map.values, true), 0, 0), HasSubstr(">0.033<")) << "but not over decades";
}

TEST(Digits, TellNarrowRangesApart) {
  EXPECT_EQ(digitsToTell(400, 600), 4);
  EXPECT_EQ(plainNumber(1.0002, digitsToTell(0.9998, 1.0003)), "1.0002");
  EXPECT_EQ(plainNumber(1.0002, 4), "1");
  EXPECT_EQ(digitsToTell(3, 3), 4);
  EXPECT_EQ(digitsToTell(0, 0), 4);
}

}  // namespace
}  // namespace ursula::report
