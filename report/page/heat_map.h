#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ursula::report {

/// Maps numbers to the colours of heat maps. The highest hundredth shares one colour, so unbounded values leave enough
/// colours for the others.
class HeatScale {
 public:
  /// Covers the finite `values`. With `log` it is logarithmic and covers only the positive ones.
  HeatScale(std::vector<float> values, bool log);

  bool empty() const { return !(high_ > low_); }
  bool isLog() const { return log_; }
  /// Index from 0; the last one for infinite values.
  int colourOf(double value) const;
  /// Returns the number at a share of the scale from 0 to 1.
  double at(double share) const;

 private:
  double drawn(double value) const;

  bool log_;
  double low_, high_;
};

/// One coordinate of a heat map's cells: their values, ascending or descending.
struct HeatAxis {
  std::string label;  ///< plain text
  std::vector<double> values;
};

/// A heat map over two coordinates, cells in the order of their values.
struct HeatMap {
  std::string title;  ///< plain text
  HeatAxis x, y;
  std::vector<float> values;                         ///< x varies fastest; NaN cells are grey
  std::vector<std::pair<double, double>> path = {};  ///< drawn over the cells as far as it is within them
  std::string unit = {};                             ///< of the values; follows the title with a prefix
};

/// Size of a heat map, px.
constexpr double heat_map_width = 424, heat_map_height = 348;

constexpr const char* heat_map_nothing = "#bbb";  ///< the colour of cells without a value

/// Returns SVG for a drawing, with its corner at (x, y). Texts have the class "title", the frame "frame", a path
/// "path"; the drawing or the page defines their style.
std::string heatMapPanel(const HeatMap& map, const HeatScale& scale, double x, double y);

}  // namespace ursula::report
