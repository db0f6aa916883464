#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report/plots.h"
#include "report/quantity.h"
#include "report/text.h"

namespace ursula::report {
namespace {

constexpr double width = 480, height = 260, left = 62, right = 12, top = 40, bottom = 38;
constexpr std::size_t buckets = 90;
constexpr double least_on_log = 1e-30;

struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool log = false;

  double drawn(double value) const { return log ? std::log10(value) : value; }
  bool takes(double value) const { return std::isfinite(value) && (!log || value > least_on_log); }
  void include(double value) {
    if (!takes(value)) return;
    low = std::min(low, drawn(value));
    high = std::max(high, drawn(value));
  }
  void widen() {
    if (log) low = std::floor(low + 1e-9), high = std::ceil(high - 1e-9);
    if (high > low) return;
    const double by = low == 0 || log ? 1 : 0.1 * std::abs(low);
    low -= by, high += by;
  }
  double share(double value) const { return (drawn(value) - low) / (high - low); }
};

struct Frame {
  Axis x, y;
  double px(double value) const { return left + (width - left - right) * x.share(value); }
  double py(double value) const { return height - bottom - (height - top - bottom) * y.share(value); }
};

Frame frameOf(const Plot& plot) {
  Frame frame;
  frame.x.log = plot.log_x;
  frame.y.log = plot.log_y;
  for (const double value : plot.x) frame.x.include(value);
  for (const Line& line : plot.lines)
    for (const double value : line.values) frame.y.include(value);
  if (!plot.log_x && frame.x.high > frame.x.low) {  // the axis spans the frame exactly
    frame.y.widen();
    return frame;
  }
  frame.x.widen();
  frame.y.widen();
  return frame;
}

std::vector<double> decades(const Axis& axis) {
  std::vector<double> out;
  const int step = std::max(1, static_cast<int>(std::ceil((axis.high - axis.low) / 6)));
  for (int k = static_cast<int>(std::ceil(axis.low - 1e-9)); k <= axis.high + 1e-9; ++k)
    if (k % step == 0) out.push_back(std::pow(10.0, k));
  return out;
}

std::vector<double> ticks(const Axis& axis, int count) {
  return axis.log ? decades(axis) : roundTicks(axis.low, axis.high, count);
}

std::string tickText(double value, const Axis& axis) {
  if (axis.log && (value < 1e-3 || value > 99999)) return plainNumber(value, 1);
  const double small = 1e-9 * std::max(std::abs(axis.low), std::abs(axis.high));
  return std::abs(value) < small && !axis.log ? "0"
                                              : plainNumber(value, axis.log ? 4 : digitsToTell(axis.low, axis.high));
}

std::string axes(const Plot& plot, const Frame& frame) {
  std::string out;
  for (const double value : ticks(frame.y, 4))
    out += fmt::format(
        "<path class=\"grid\" d=\"M{:.0f} {:.1f}H{:.0f}\"/><text x=\"{:.0f}\" y=\"{:.1f}\" "
        "text-anchor=\"end\">{}</text>",
        left, frame.py(value), width - right, left - 5, frame.py(value) + 3.5, tickText(value, frame.y));
  for (const double value : ticks(frame.x, 6))
    out += fmt::format(
        "<path class=\"grid\" d=\"M{:.1f} {:.0f}V{:.0f}\"/><text x=\"{:.1f}\" y=\"{:.0f}\" "
        "text-anchor=\"middle\">{}</text>",
        frame.px(value), top, height - bottom, frame.px(value), height - bottom + 14, tickText(value, frame.x));
  out += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>", (left + width - right) / 2,
                     height - 6, escaped(plot.x_label));
  out += fmt::format("<text transform=\"translate(11 {:.0f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
                     (top + height - bottom) / 2, escaped(plot.y_label));
  return out;
}

std::string classOf(const Line& line) {
  if (line.stroke == Stroke::limit) return "limit";
  if (line.stroke == Stroke::points) return "points";
  return fmt::format("{} c{}", line.stroke == Stroke::ghost ? "ghost" : "line", line.color % 7);
}

std::string path(const Plot& plot, const Line& line, const Frame& frame) {
  std::string d;
  const bool points = line.stroke == Stroke::points;
  bool pen_down = false;
  for (std::size_t k = 0; k < plot.x.size(); ++k) {
    const bool drawn = frame.x.takes(plot.x[k]) && frame.y.takes(line.values[k]);
    if (drawn) d += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", frame.px(plot.x[k]), frame.py(line.values[k]));
    if (drawn && points) d += "h0";
    pen_down = drawn && !points;
  }
  return d.empty() ? "" : fmt::format("<path class=\"{}\" d=\"{}\"/>", classOf(line), d);
}

/// The tube between the first two lines, where both have values.
std::string tube(const Plot& plot, const Frame& frame) {
  if (!plot.tube || plot.lines.size() < 2) return "";
  const std::vector<double>&high = plot.lines[0].values, &low = plot.lines[1].values;
  std::string above, below;
  for (std::size_t k = 0; k < plot.x.size(); ++k) {
    if (!frame.x.takes(plot.x[k]) || !frame.y.takes(high[k]) || !frame.y.takes(low[k])) continue;
    above += fmt::format("{}{:.1f} {:.1f}", above.empty() ? "M" : "L", frame.px(plot.x[k]), frame.py(high[k]));
    below = fmt::format("L{:.1f} {:.1f}", frame.px(plot.x[k]), frame.py(low[k])) + below;
  }
  return above.empty() ? "" : fmt::format("<path class=\"tube\" d=\"{}{}Z\"/>", above, below);
}

/// One entry per drawn line; entries that do not fit are omitted.
std::string legend(const Plot& plot) {
  std::string out;
  double x = left;
  double y = 14;
  for (const Line& line : plot.lines) {
    if (!isDrawable(plot, line) || line.stroke == Stroke::points) continue;
    std::size_t letters = 0;
    for (const char c : line.label)
      letters += (static_cast<unsigned char>(c) & 0xC0) != 0x80;  // counts UTF-8 characters
    const double wide = 34 + 6.2 * static_cast<double>(letters);
    if (x + wide > width && x > left) x = left, y += 15;
    if (y > 30) break;
    out += fmt::format("<path class=\"{}\" d=\"M{:.0f} {:.0f}h20\"/><text x=\"{:.0f}\" y=\"{:.0f}\">{}</text>",
                       classOf(line), x, y - 4, x + 24, y, escaped(line.label));
    x += wide;
  }
  return out;
}

}  // namespace

std::vector<double> roundTicks(double low, double high, int count) {
  std::vector<double> out;
  if (!(high > low)) return out;
  const double rough = (high - low) / count, power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  const double step = power * (lead > 5 ? 10 : lead > 2 ? 5 : lead > 1 ? 2 : 1);
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) out.push_back(k * step);
  return out;
}

std::string svgPlot(const Plot& full) {
  const bool scattered =
      std::any_of(full.lines.begin(), full.lines.end(), [](const Line& line) { return line.stroke == Stroke::points; });
  const Plot plot = scattered ? full : thinned(full, buckets);
  const bool drawable =
      std::any_of(plot.lines.begin(), plot.lines.end(), [&plot](const Line& line) { return isDrawable(plot, line); });
  if (!drawable) return "";
  const Frame frame = frameOf(plot);
  std::string lines = tube(plot, frame);
  const auto order = plot.tube ? std::array{Stroke::limit, Stroke::ghost, Stroke::line, Stroke::points}
                               : std::array{Stroke::ghost, Stroke::points, Stroke::line, Stroke::limit};
  for (const Stroke stroke : order)
    for (const Line& line : plot.lines)
      if (line.stroke == stroke) lines += path(plot, line, frame);
  return fmt::format(
      "<svg class=\"static\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
      "aria-label=\"{}\">{}{}{}</svg>",
      width, height, escaped(full.title + ". " + inWords(full)), axes(plot, frame), lines, legend(plot));
}

namespace {

constexpr std::size_t steps = 40;
constexpr double line_width = 100, line_height = 22;

/// Whether the line shows a value: an error starts at zero, which has no decade.
bool takes(double value) { return std::isfinite(value) && value > 0; }

}  // namespace

std::vector<double> trendOf(const TimeSeries& series) {
  const std::vector<double>* errors = series.find("error_p_m");
  if (errors == nullptr || errors->empty()) return {};
  const std::size_t rows = errors->size(), count = std::min(rows, steps);
  std::vector<double> trend;
  for (std::size_t k = 0; k < count; ++k) {
    double most = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = k * rows / count; i < (k + 1) * rows / count; ++i)
      if (std::isfinite((*errors)[i])) most = std::fmax(most, std::abs((*errors)[i]));
    trend.push_back(most);
  }
  return trend;
}

std::string sparkline(const std::vector<double>& trend) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const double value : trend)
    if (takes(value)) low = std::min(low, value), high = std::max(high, value);
  if (high == 0) return "";
  // The height is at least a decade, so small changes do not look large.
  const double bottom = std::min(std::log10(low), std::log10(high) - 1), span = std::log10(high) - bottom;
  std::string d;
  bool pen_down = false;
  for (std::size_t k = 0; k < trend.size(); ++k) {
    if (takes(trend[k]))
      d += fmt::format(
          "{}{:.1f} {:.1f}", pen_down ? "L" : "M",
          line_width * static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(trend.size() - 1, 1)),
          line_height - 2 - (line_height - 4) * (std::log10(trend[k]) - bottom) / span);
    pen_down = takes(trend[k]);
  }
  return fmt::format(
      "<svg class=\"spark\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"Replay error along the motion, "
      "from {} to {}\"><path d=\"{}\"/></svg>",
      line_width, line_height, escaped(quantity(low, "m")), escaped(quantity(high, "m")), d);
}

}  // namespace ursula::report
