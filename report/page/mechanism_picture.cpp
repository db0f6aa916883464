#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/page/mechanism_drawing.h"
#include "report/page/scenario_picture.h"
#include "report/text/text.h"

namespace ursula {
namespace {

constexpr double side = 480, above = 44;  // px

constexpr const char* sheet_style = R"(<style>
text { font: 13px sans-serif; fill: #333 } .caption { text-anchor: middle; font-size: 14px } .motor { font-weight: bold; stroke: #fff; stroke-width: 4; paint-order: stroke }
path { fill: none; stroke-linecap: round; stroke-linejoin: round } .base { stroke: #666; stroke-width: 2; fill: #6662 } .base.thin { stroke-dasharray: 2 5; stroke-width: 4 }
.platform { stroke: #06c; stroke-width: 2; fill: #06c3 } .platform.thin { stroke-width: 7; fill: none } .link { stroke-width: 4 } .plate { fill-opacity: 0.15 } .rail { stroke: #999; stroke-width: 6; stroke-opacity: 0.6 }
.c0 { stroke: #c50 } .c1 { stroke: #181 } .c2 { stroke: #7a3fb0 } .c3 { stroke: #a67c00 } .c4 { stroke: #c2185b } .c5 { stroke: #0a8a8a } .c6 { stroke: #5b6b00 }
.joint { fill: #fff; stroke: #333; stroke-width: 1.5 } .driven { fill: #333 } .path { stroke: #333; stroke-width: 1.5; stroke-dasharray: 4 3 }
</style>
)";

/// A bar of round length, 1, 2 or 5 times a power of ten, below a panel.
std::string lengthBar(double left, double scale) {
  const double most = side / 2.5 / scale, power = std::pow(10, std::floor(std::log10(most)));
  const double length = most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
  const double y = above + side + 42;
  return fmt::format(
      "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{2:.1f}\" y2=\"{1}\" stroke=\"#333\"/>\n<text x=\"{0:.1f}\" "
      "y=\"{3}\">{4:g} m</text>\n",
      left + 40, y, left + 40 + scale * length, y + 17, length);
}

}  // namespace

std::string picture(const MechanismPicture& mechanism, const std::string& title) {
  struct View {
    Vector3d forward;
    const char* caption;
  };
  const View views[] = {{report::viewOf(mechanism), "at an angle, z up"},
                        {Vector3d::UnitY(), "from the front: x to the right, z up"},
                        {-Vector3d::UnitZ(), "from above: x to the right, y up"}};
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\">\n{}<rect width=\"100%\" height=\"100%\" "
      "fill=\"#fff\"/>\n<text x=\"40\" y=\"28\" style=\"font-size:16px\">{}</text>\n",
      3 * side, above + side + 75, sheet_style, report::escaped(title));
  double left = 0;
  for (const View& view : views) {
    const report::DrawingArea area{left, above, side, side};
    out += report::drawn(mechanism, view.forward, area);
    out += fmt::format("<text class=\"caption\" x=\"{:.1f}\" y=\"{}\">{}</text>\n", left + side / 2, above + side + 20,
                       view.caption);
    out += lengthBar(left, report::scaleOf(mechanism, view.forward, area));
    left += side;
  }
  return out + "</svg>\n";
}

}  // namespace ursula
