#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/instants.h"
#include "parts/map/pose_map.h"
#include "report/page/heat_map.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula {
namespace {

constexpr double heading = 30;  // px
constexpr int most_slices = 6;

struct ShownValues {
  std::string title, unit;
  std::vector<float> values;  ///< NaN means out of reach
  report::HeatScale scale;
};

/// Replaces the missing number of a singular pose by infinity, which has the last colour.
ShownValues shown(const std::string& title, const std::string& unit, const DrawnMap& drawn,
                  const std::vector<float>& values, bool log) {
  ShownValues out{title, unit, values, {values, log}};
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::isnan(values[k]) && !std::isnan(drawn.kappa[k])) out.values[k] = std::numeric_limits<float>::infinity();
  return out;
}

report::HeatAxis axisOf(const PoseGrid& grid, std::size_t k) {
  const std::size_t which = grid.varying()[k];
  const GridAxis& axis = grid.axis(which);
  report::HeatAxis out;
  out.label = fmt::format("{} in {}", grid_axis_names[which], which < 3 ? "m" : "degrees");
  for (int i = 0; i < axis.count; ++i) out.values.push_back(axis.value(i));
  return out;
}

/// The commanded motion over the first two axes.
std::vector<std::pair<double, double>> pathOver(const Scenario& scenario, const PoseGrid& grid) {
  std::vector<std::pair<double, double>> out;
  for (const double t : equallySpaced(scenario.trajectory->duration(), 201)) {
    const std::array<double, grid_axes> at = PoseGrid::coordinatesOf(scenario.trajectory->at(t));
    out.emplace_back(at[grid.varying()[0]], at[grid.varying()[1]]);
  }
  return out;
}

report::HeatMap sliceOf(const PoseGrid& grid, const ShownValues& shown, int slice) {
  report::HeatMap out{shown.title, axisOf(grid, 0), axisOf(grid, 1), {}};
  const auto cells = static_cast<std::ptrdiff_t>(out.x.values.size() * out.y.values.size());
  out.values.assign(shown.values.begin() + slice * cells, shown.values.begin() + (slice + 1) * cells);
  return out;
}

/// Evenly chosen values of the third axis.
std::vector<int> slices(const PoseGrid& grid) {
  if (grid.varying().size() < 3) return {0};
  const int count = grid.axis(grid.varying()[2]).count, shown = std::min(count, most_slices);
  std::vector<int> out;
  for (int k = 0; k < shown; ++k) out.push_back(k * (count - 1) / (shown - 1));
  return out;
}

/// Returns the constant coordinates of a row: "z = 2.2 m, roll = 0°".
std::string standing(const PoseGrid& grid, int slice) {
  std::string out;
  for (std::size_t i = 0; i < grid_axes; ++i) {
    const auto& varying = grid.varying();
    const bool third = varying.size() == 3 && i == varying[2];
    if (grid.axis(i).varies() && !third) continue;
    const double value = grid.axis(i).value(third ? slice : 0);
    out += fmt::format("{}{} = {}{}", out.empty() ? "" : ", ", grid_axis_names[i],
                       report::plainNumber(std::abs(value) < 1e-9 ? 0 : value, 4), i < 3 ? " m" : "°");
  }
  return out;
}

constexpr const char* style = R"(<style>
text { font: 12px sans-serif; fill: #333 } .title { font-size: 13px } .name { font-size: 16px }
.frame { fill: none; stroke: #444 } .path { fill: none; stroke: #d1242f; stroke-width: 2.5; stroke-linejoin: round }
</style>
)";

}  // namespace

std::string mapPicture(const Scenario& scenario, const PoseGrid& grid, const DrawnMap& drawn) {
  const std::array<ShownValues, 3> all = {
      {shown("condition number κ(B)", "", drawn, drawn.kappa, true),
       isTelescopic(scenario)
           ? shown("smallest distance from an end of a stroke", "m", drawn, drawn.margin, false)
           : shown("smallest margin of the legs: 0 stretched, 1 far from it", "", drawn, drawn.margin, false),
       shown("largest static effort", drawn.effort_unit, drawn, drawn.effort, true)}};
  const std::vector<int> rows = slices(grid);
  const std::vector<std::pair<double, double>> path = pathOver(scenario, grid);
  std::string out;
  double y = heading + 6;
  for (const int slice : rows) {
    out += fmt::format("<text x=\"20\" y=\"{:.0f}\">{}</text>\n", y + 22, standing(grid, slice));
    for (std::size_t k = 0; k < all.size(); ++k) {
      report::HeatMap map = sliceOf(grid, all[k], slice);
      map.path = path;
      map.unit = all[k].unit;
      out += report::heatMapPanel(map, all[k].scale, report::heat_map_width * static_cast<double>(k), y);
    }
    y += report::heat_map_height;
  }
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\">\n{}<rect width=\"100%\" "
             "height=\"100%\" fill=\"#fff\"/>\n<text x=\"20\" y=\"24\" class=\"name\">{}</text>\n<rect x=\"{:.0f}\" "
             "y=\"12\" width=\"14\" height=\"14\" fill=\"{}\"/>\n<text x=\"{:.0f}\" y=\"24\">out of reach</text>\n"
             "<path class=\"path\" d=\"M{:.0f} 19h24\"/><text x=\"{:.0f}\" y=\"24\">commanded path{}</text>\n",
             3 * report::heat_map_width, y, style, report::escaped(scenario.name), 3 * report::heat_map_width - 130,
             report::heat_map_nothing, 3 * report::heat_map_width - 110, 3 * report::heat_map_width - 330,
             3 * report::heat_map_width - 300,
             grid.varying().size() == 3 ? fmt::format(", at any {}", grid_axis_names[grid.varying()[2]]) : "") +
         out + "</svg>\n";
}

}  // namespace ursula
