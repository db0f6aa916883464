#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "validation/map/pose_map.h"
#include "validation/report/quantity.h"
#include "validation/report/svg_plot.h"
#include "validation/report/text.h"

namespace ursula {
namespace {

constexpr double panel = 230, left = 70, top = 62, right = 96, below = 56, heading = 30;  // px
constexpr double wide = left + panel + right, high = top + panel + below;
constexpr int colours = 24, most_slices = 6;
constexpr const char* out_of_reach = "#bbb";

/// Of the map named viridis, which keeps its order in grey and for the colour-blind.
std::string colour(int k) {
  constexpr std::array<std::array<int, 3>, 5> anchors = {
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = 4.0 * k / (colours - 1);
  const auto low = static_cast<std::size_t>(std::min(3.0, std::floor(at)));
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i)
    rgb[i] = static_cast<int>(
        std::lround(anchors[low][i] + (at - static_cast<double>(low)) * (anchors[low + 1][i] - anchors[low][i])));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

/// From colours to numbers.
struct Scale {
  bool log;
  double low = std::numeric_limits<double>::infinity(), high = -low;

  double drawn(double value) const { return log ? std::log10(std::max(value, 1e-30)) : value; }
  Scale(const std::vector<float>& values, bool is_log) : log(is_log) {
    std::vector<float> finite;
    std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](float v) { return std::isfinite(v); });
    if (finite.empty()) return;
    std::sort(finite.begin(), finite.end());
    low = drawn(finite.front());
    high = drawn(finite[(finite.size() - 1) * 99 / 100]);  // what grows without bound takes no colours from the rest
    if (!(high > low)) high = low + 1e-6;
  }
  int colourOf(double value) const {
    const double share = (drawn(value) - low) / (high - low);
    return std::clamp(static_cast<int>(share * colours), 0, colours - 1);
  }
};

struct Shown {
  std::string title;
  const std::vector<float>& values;
  Scale scale;
};

class Panel {
 public:
  Panel(const PoseGrid& grid, const DrawnMap& drawn, const Shown& shown, int slice, double x, double y)
      : grid_(grid), drawn_(drawn), shown_(shown), slice_(slice), x_(x + left), y_(y + top) {}

  std::string drawing() const {
    return fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" class=\"title\">{}</text>\n", x_, y_ - 12, shown_.title) +
           cells() + frame() + legend();
  }

 private:
  const GridAxis& axis(std::size_t k) const { return grid_.axis(grid_.varying()[k]); }

  /// Runs of one colour in a row of cells, all of one colour in one path.
  std::string cells() const {
    std::array<std::string, colours + 1> paths;
    const int across = axis(0).count, up = axis(1).count;
    const double w = panel / across, h = panel / up;
    for (int j = 0; j < up; ++j)
      for (int i = 0, end = 0; i < across; i = end) {
        const int c = colourAt(i, j);
        for (end = i + 1; end < across && colourAt(end, j) == c;) ++end;
        paths[static_cast<std::size_t>(c)] += fmt::format("M{:.2f} {:.2f}h{:.2f}v{:.2f}h{:.2f}z", x_ + w * i,
                                                          y_ + panel - h * (j + 1), w * (end - i), h, -w * (end - i));
      }
    std::string out;
    for (int c = 0; c <= colours; ++c)
      if (const std::string& path = paths[static_cast<std::size_t>(c)]; !path.empty())
        out += fmt::format("<path fill=\"{}\" shape-rendering=\"crispEdges\" d=\"{}\"/>\n",
                           c == colours ? out_of_reach : colour(c), path);
    return out;
  }

  int colourAt(int i, int j) const {
    const auto across = static_cast<std::size_t>(axis(0).count), up = static_cast<std::size_t>(axis(1).count);
    const std::size_t k =
        (static_cast<std::size_t>(slice_) * up + static_cast<std::size_t>(j)) * across + static_cast<std::size_t>(i);
    if (std::isnan(drawn_.kappa[k])) return colours;
    return std::isnan(shown_.values[k]) ? colours - 1 : shown_.scale.colourOf(shown_.values[k]);
  }

  std::string label(std::size_t k) const {
    const std::size_t which = grid_.varying()[k];
    return fmt::format("{} in {}", grid_axis_names[which], which < 3 ? "m" : "degrees");
  }

  std::string frame() const {
    std::string out = fmt::format("<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{}\" height=\"{}\" class=\"frame\"/>\n", x_,
                                  y_, panel, panel);
    const auto ticks = [](const GridAxis& a) {
      return report::roundTicks(std::min(a.from, a.to), std::max(a.from, a.to), 6);
    };
    const auto share = [](const GridAxis& a, double value) {  // cells stand around their values
      return ((value - a.from) / (a.to - a.from) * (a.count - 1) + 0.5) / a.count;
    };
    const auto text = [](const GridAxis& a, double value) {
      return report::plainNumber(std::abs(value) < 1e-9 * std::abs(a.to - a.from) ? 0 : value, 4);
    };
    for (const double value : ticks(axis(0)))
      out += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n",
                         x_ + panel * share(axis(0), value), y_ + panel + 16, text(axis(0), value));
    for (const double value : ticks(axis(1)))
      out += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", x_ - 6,
                         y_ + panel * (1 - share(axis(1), value)) + 4, text(axis(1), value));
    out += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n", x_ + panel / 2,
                       y_ + panel + 36, label(0));
    return out +
           fmt::format("<text transform=\"translate({:.0f} {:.0f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                       x_ - 48, y_ + panel / 2, label(1));
  }

  std::string legend() const {
    const Scale& scale = shown_.scale;
    std::string out;
    const double at = x_ + panel + 12, step = panel / colours;
    if (!(scale.high > scale.low)) return out;
    for (int c = 0; c < colours; ++c)
      out += fmt::format("<rect x=\"{:.0f}\" y=\"{:.1f}\" width=\"14\" height=\"{:.1f}\" fill=\"{}\"/>\n", at,
                         y_ + panel - step * (c + 1), step + 0.3, colour(c));
    for (int k = 0; k <= 4; ++k) {
      const double value = scale.low + (scale.high - scale.low) * k / 4;
      out += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\">{}{}</text>\n", at + 19, y_ + panel * (1 - k / 4.0) + 4,
                         k == 4 ? "≥ " : "", report::plainNumber(scale.log ? std::pow(10, value) : value, 3));
    }
    return out;
  }

  const PoseGrid& grid_;
  const DrawnMap& drawn_;
  const Shown& shown_;
  int slice_;
  double x_, y_;
};

/// Evenly chosen among those of the third axis.
std::vector<int> slices(const PoseGrid& grid) {
  if (grid.varying().size() < 3) return {0};
  const int count = grid.axis(grid.varying()[2]).count, shown = std::min(count, most_slices);
  std::vector<int> out;
  for (int k = 0; k < shown; ++k) out.push_back(k * (count - 1) / (shown - 1));
  return out;
}

/// "z = 2.2 m, roll = 0°": what does not vary within a row.
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
.frame { fill: none; stroke: #444 }
</style>
)";

}  // namespace

std::string mapPicture(const Scenario& scenario, const PoseGrid& grid, const DrawnMap& drawn) {
  const std::array<Shown, 3> all = {
      {{"condition number κ(B)", drawn.kappa, {drawn.kappa, true}},
       {"smallest |sin θ| of the legs", drawn.sine, {drawn.sine, false}},
       {"largest static effort, " + drawn.effort_unit, drawn.effort, {drawn.effort, true}}}};
  const std::vector<int> rows = slices(grid);
  std::string out;
  double y = heading + 6;
  for (const int slice : rows) {
    out += fmt::format("<text x=\"20\" y=\"{:.0f}\">{}</text>\n", y + 22, standing(grid, slice));
    for (std::size_t k = 0; k < all.size(); ++k)
      out += Panel(grid, drawn, all[k], slice, wide * static_cast<double>(k), y).drawing();
    y += high;
  }
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\">\n{}<rect width=\"100%\" "
             "height=\"100%\" fill=\"#fff\"/>\n<text x=\"20\" y=\"24\" class=\"name\">{}</text>\n<rect x=\"{:.0f}\" "
             "y=\"12\" width=\"14\" height=\"14\" fill=\"{}\"/>\n<text x=\"{:.0f}\" y=\"24\">out of reach</text>\n",
             3 * wide, y, style, report::escaped(scenario.name), 3 * wide - 130, out_of_reach, 3 * wide - 110) +
         out + "</svg>\n";
}

}  // namespace ursula
