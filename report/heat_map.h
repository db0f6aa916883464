#pragma once

#include <string>
#include <vector>

namespace ursula::report {

/// From numbers to the colours of heat maps. What grows without bound takes no colours from the rest: the highest
/// hundredth has one colour.
class HeatScale {
 public:
  /// Of the finite ones among `values`; logarithmic where `log`, of the positive ones alone.
  HeatScale(std::vector<float> values, bool log);

  bool empty() const { return !(high_ > low_); }
  /// From 0; the last of what is infinite.
  int colourOf(double value) const;
  /// The number at a share of the scale from 0 to 1.
  double at(double share) const;

 private:
  double drawn(double value) const;

  bool log_;
  double low_, high_;
};

/// One coordinate of a heat map's cells: their values, rising or falling.
struct HeatAxis {
  std::string label;  ///< plain text
  std::vector<double> values;
};

/// A heat map over two coordinates, cells in the order of their values.
struct HeatMap {
  std::string title;  ///< plain text
  HeatAxis x, y;
  std::vector<float> values;  ///< x the fastest; NaN where there is none: grey
};

/// Room that a heat map takes, px.
constexpr double heat_map_width = 424, heat_map_height = 348;

constexpr const char* heat_map_nothing = "#bbb";  ///< the colour of cells without a value

/// SVG within a drawing, its corner at (x, y). Texts have the class "title", its frame "frame", which the drawing or
/// the page gives their looks.
std::string heatMapPanel(const HeatMap& map, const HeatScale& scale, double x, double y);

}  // namespace ursula::report
