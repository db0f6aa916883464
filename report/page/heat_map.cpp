#include "report/page/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report/page/plots.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula::report {
namespace {

constexpr double panel = 230, left = 70, top = 62;  // px
constexpr double overlap = 0.3;                     // px: prevents hairlines between cells
constexpr int colours = 24;
constexpr std::size_t most_labelled = 6;  // up to this many cells, each has a label

/// Returns round numbers within [low, high], about `count` of them.
std::vector<double> roundTicks(double low, double high, int count) {
  std::vector<double> out;
  if (!(high > low)) return out;
  const double rough = (high - low) / count, power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  const double step = power * (lead > 5 ? 10 : lead > 2 ? 5 : lead > 1 ? 2 : 1);
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) out.push_back(k * step);
  return out;
}

/// A colour of viridis, which keeps its order in grey and for colour-blind readers.
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

/// A label and its position as a share of the axis.
struct Label {
  double share;
  std::string text;
};

/// Returns the place of a value as a share of the axis. Cells surround their values; between two cells it is
/// interpolated.
double shareOf(const std::vector<double>& values, double value) {
  const bool falls = values.back() < values.front();
  const auto after = std::find_if(values.begin() + 1, values.end() - 1,
                                  [falls, value](double v) { return falls ? v <= value : v >= value; });
  const auto k = static_cast<double>(after - values.begin());
  return (k + (value - *after) / (*after - *(after - 1)) + 0.5) / static_cast<double>(values.size());
}

std::vector<Label> labelsOf(const HeatAxis& axis) {
  std::vector<Label> out;
  const auto [low, high] = std::minmax_element(axis.values.begin(), axis.values.end());
  const bool each = axis.values.size() <= most_labelled;
  for (const double value : each ? axis.values : roundTicks(*low, *high, 6))
    out.push_back({axis.values.size() < 2 ? 0.5 : shareOf(axis.values, value),
                   plainNumber(std::abs(value) < 1e-9 * (*high - *low) ? 0 : value, digitsToTell(*low, *high))});
  return out;
}

class Panel {
 public:
  Panel(const HeatMap& map, const HeatScale& scale, double x, double y)
      : map_(map),
        scale_(scale),
        unit_(prefixed(scale.empty() ? 0 : scale.at(1), map.unit)),
        x_(x + left),
        y_(y + top) {}

  std::string drawing() const {
    const std::string unit = map_.unit.empty() ? "" : ", " + unit_.second;
    return fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" class=\"title\">{}</text>\n", x_, y_ - 12,
                       escaped(map_.title + unit)) +
           cells() + path() + frame() + legend();
  }

 private:
  /// Draws runs of equal colour per row of cells, one path per colour.
  std::string cells() const {
    std::array<std::string, colours + 1> paths;
    const std::size_t across = map_.x.values.size(), up = map_.y.values.size();
    const double w = panel / static_cast<double>(across), h = panel / static_cast<double>(up);
    for (std::size_t j = 0; j < up; ++j)
      for (std::size_t i = 0, end = 0; i < across; i = end) {
        const int c = colourAt(i, j);
        for (end = i + 1; end < across && colourAt(end, j) == c;) ++end;
        const double wide = w * static_cast<double>(end - i) + overlap;
        paths[c] += fmt::format("M{:.2f} {:.2f}h{:.2f}v{:.2f}h{:.2f}z", x_ + w * static_cast<double>(i),
                                y_ + panel - h * static_cast<double>(j + 1), wide, h, -wide);
      }
    std::string out;
    for (int c = 0; c <= colours; ++c)
      if (const std::string& path = paths[c]; !path.empty())
        out += fmt::format("<path style=\"fill:{}\" shape-rendering=\"crispEdges\" d=\"{}\"/>\n",
                           c == colours ? heat_map_nothing : colour(c), path);
    return out;
  }

  std::string path() const {
    std::string d;
    bool within = false;
    for (const auto& [x, y] : map_.path) {
      const double right = map_.x.values.size() < 2 ? 0.5 : shareOf(map_.x.values, x),
                   up = map_.y.values.size() < 2 ? 0.5 : shareOf(map_.y.values, y);
      const bool inside = right >= 0 && right <= 1 && up >= 0 && up <= 1;
      if (inside) d += fmt::format("{}{:.1f} {:.1f}", within ? 'L' : 'M', x_ + panel * right, y_ + panel * (1 - up));
      within = inside;
    }
    return d.empty() ? "" : "<path class=\"path\" d=\"" + d + "\"/>\n";
  }

  int colourAt(std::size_t i, std::size_t j) const {
    const float value = map_.values[j * map_.x.values.size() + i];
    return std::isnan(value) ? colours : scale_.colourOf(value);
  }

  std::string frame() const {
    std::string out = fmt::format("<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{}\" height=\"{}\" class=\"frame\"/>\n", x_,
                                  y_, panel, panel);
    for (const Label& label : labelsOf(map_.x))
      out += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n", x_ + panel * label.share,
                         y_ + panel + 16, label.text);
    for (const Label& label : labelsOf(map_.y))
      out += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", x_ - 6,
                         y_ + panel * (1 - label.share) + 4, label.text);
    out += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n", x_ + panel / 2,
                       y_ + panel + 36, escaped(map_.x.label));
    return out +
           fmt::format("<text transform=\"translate({:.0f} {:.0f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                       x_ - 48, y_ + panel / 2, escaped(map_.y.label));
  }

  std::string legend() const {
    std::string out;
    const double at = x_ + panel + 12, step = panel / colours;
    if (scale_.empty()) return out;
    for (int c = 0; c < colours; ++c)
      out += fmt::format("<rect x=\"{:.0f}\" y=\"{:.1f}\" width=\"14\" height=\"{:.1f}\" style=\"fill:{}\"/>\n", at,
                         y_ + panel - step * (c + 1), step + 0.3, colour(c));
    for (int k = 0; k <= 4; ++k)
      out += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\">{}{}</text>\n", at + 19, y_ + panel * (1 - k / 4.0) + 4,
                         k == 4 ? "≥ " : "", labelAt(k / 4.0));
    return out;
  }

  /// What is nothing beside a linear scale's range is 0.
  std::string labelAt(double share) const {
    const double low = scale_.at(0), high = scale_.at(1), value = scale_.at(share);
    const bool is_nothing = !scale_.isLog() && std::abs(value) < 1e-3 * (high - low);
    return plainNumber(is_nothing ? 0 : value / unit_.first, digitsToTell(low, high) - 1);
  }

  const HeatMap& map_;
  const HeatScale& scale_;
  std::pair<double, std::string> unit_;  ///< with the prefix that suits the largest value
  double x_, y_;
};

}  // namespace

HeatScale::HeatScale(std::vector<float> values, bool log)
    : log_(log), low_(std::numeric_limits<double>::infinity()), high_(-low_) {
  const auto out = [log](float v) { return !std::isfinite(v) || (log && v <= 0); };
  values.erase(std::remove_if(values.begin(), values.end(), out), values.end());
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  low_ = drawn(values.front());
  high_ = drawn(values[(values.size() - 1) * 99 / 100]);
  if (!(high_ > low_)) high_ = low_ + 1e-6;
}

double HeatScale::drawn(double value) const { return log_ ? std::log10(std::max(value, 1e-30)) : value; }

int HeatScale::colourOf(double value) const {
  const double share = (drawn(value) - low_) / (high_ - low_);
  return static_cast<int>(std::clamp(share * colours, 0.0, colours - 1.0));
}

double HeatScale::at(double share) const {
  const double value = low_ + (high_ - low_) * share;
  return log_ ? std::pow(10, value) : value;
}

std::string heatMapPanel(const HeatMap& map, const HeatScale& scale, double x, double y) {
  return Panel(map, scale, x, y).drawing();
}

}  // namespace ursula::report
