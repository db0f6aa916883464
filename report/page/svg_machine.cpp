#include "report/page/sections.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "report/text/text.h"

namespace ursula::report {
namespace {

using Point = Eigen::Vector2d;

constexpr double frame_width = 640, frame_height = 420, frame_margin = 30;

/// A parallel projection from above and to the side.
Point projected(const Vector3d& v) {
  const double azimuth = -0.6, elevation = 0.38;
  const double x = std::cos(azimuth) * v.x() - std::sin(azimuth) * v.y();
  const double y = std::sin(azimuth) * v.x() + std::cos(azimuth) * v.y();
  return {x, -(std::cos(elevation) * v.z() + std::sin(elevation) * y)};
}

/// Maps the drawing to the sheet.
class Sheet {
 public:
  void include(const Vector3d& v) {
    low_ = low_.cwiseMin(projected(v));
    high_ = high_.cwiseMax(projected(v));
  }
  Point at(const Vector3d& v) const {
    const Point size = (high_ - low_).cwiseMax(Point::Constant(1e-12));
    const double scale =
        std::min((frame_width - 2 * frame_margin) / size.x(), (frame_height - 2 * frame_margin) / size.y());
    return Point(frame_width / 2, frame_height / 2) + scale * (projected(v) - (low_ + high_) / 2);
  }

 private:
  Point low_ = Point::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
};

std::string polygon(const char* style, const std::vector<Vector3d>& points, const Sheet& sheet, bool closed) {
  std::string d;
  for (const Vector3d& point : points) {
    const Point at = sheet.at(point);
    d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : "L", at.x(), at.y());
  }
  return fmt::format("<path class=\"{}\" d=\"{}{}\"/>", style, d, closed ? "Z" : "");
}

/// The convex outline in the projection.
std::vector<Vector3d> outline(std::vector<Vector3d> points) {
  const auto turn = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Point u = projected(b) - projected(a), v = projected(c) - projected(b);
    return u.x() * v.y() - u.y() * v.x();
  };
  std::sort(points.begin(), points.end(),
            [](const Vector3d& a, const Vector3d& b) { return projected(a).x() < projected(b).x(); });
  std::vector<Vector3d> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const Vector3d& point : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0) hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::string leg(const Picture::Leg& leg, int color, const Sheet& sheet) {
  std::string out;
  for (const Picture::Link& rail : leg.rails)
    out += polygon("rail", {rail.from.front(), rail.to.front()}, sheet, false);
  for (const Picture::Link& link : leg.links)
    out += polygon(fmt::format("link c{}", color).c_str(), {link.from.front(), link.to.front()}, sheet, false);
  for (const Picture::Joint& joint : leg.joints) {
    const Point at = sheet.at(joint.at.front());
    out += fmt::format("<circle class=\"joint{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>",
                       joint.driven ? " driven" : "", at.x(), at.y(), joint.driven ? 6 : 4);
  }
  return out;
}

/// The legs' numbers below their first joints.
std::string numbered(const Picture& picture, const std::vector<int>& wrong, const Sheet& sheet) {
  std::string out;
  for (std::size_t k = 0; k < picture.legs.size(); ++k) {
    const bool is_wrong = std::find(wrong.begin(), wrong.end(), static_cast<int>(k)) != wrong.end();
    const Point at = sheet.at(picture.legs[k].links.front().from.front());
    out += fmt::format("<text class=\"motor{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}{}</text>",
                       is_wrong ? " wrong" : "", at.x(), at.y() + 19, is_wrong ? "✗ leg " : "", k + 1);
  }
  return out;
}

}  // namespace

std::string svgMachine(const Picture& picture, const std::vector<int>& wrong) {
  if (picture.t.empty()) return "";
  Sheet sheet;
  std::vector<Vector3d> base, platform = {picture.p.front()};
  for (const Picture::Leg& each : picture.legs) {
    base.push_back(each.links.front().from.front());
    platform.push_back(each.links.back().to.front());
    for (const std::vector<Picture::Link>* links : {&each.links, &each.rails})
      for (const Picture::Link& link : *links) sheet.include(link.from.front()), sheet.include(link.to.front());
  }
  for (const Vector3d& p : picture.p) sheet.include(p);
  std::string out = polygon("base", outline(base), sheet, true);
  for (std::size_t k = 0; k < picture.legs.size(); ++k) out += leg(picture.legs[k], static_cast<int>(k % 7), sheet);
  out += polygon("platform", outline(platform), sheet, true) + polygon("path", picture.p, sheet, false) +
         numbered(picture, wrong, sheet);
  return fmt::format(
      "<svg class=\"machine\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
      "aria-label=\"The machine at the start of its motion, with the path of P\">{}</svg>",
      frame_width, frame_height, out);
}

}  // namespace ursula::report
