#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "report/page/mechanism_drawing.h"
#include "report/page/sections.h"
#include "report/text/text.h"

namespace ursula::report {
namespace {

/// A parallel projection into an area of the sheet, which the machine and its path fill.
class Projection {
 public:
  Projection(const MechanismPicture& picture, const Vector3d& forward, const DrawingArea& area) : area_(area) {
    const Vector3d up = std::abs(forward.z()) > 0.999 ? Vector3d::UnitY() : Vector3d::UnitZ();
    across_ = forward.cross(up).normalized();
    down_ = forward.cross(across_);
    for (const MechanismPicture::Body& body : picture.bodies)
      for (const Vector3d& point : body.points) include(placed(body, point, 0));
    for (const Vector3d& point : pathOf(picture)) include(point);
    if (!(low_.x() <= high_.x())) low_ = high_ = Eigen::Vector2d::Zero();
    const Eigen::Vector2d size = (high_ - low_).cwiseMax(Eigen::Vector2d::Constant(1e-12));
    scale_ = std::min((area.width - 2 * margin) / size.x(), (area.height - 2 * margin) / size.y());
  }

  double scale() const { return scale_; }
  Eigen::Vector2d at(const Vector3d& v) const {
    return Eigen::Vector2d(area_.left + area_.width / 2, area_.top + area_.height / 2) +
           scale_ * (flat(v) - (low_ + high_) / 2);
  }

  static std::vector<Vector3d> pathOf(const MechanismPicture& picture) {
    std::vector<Vector3d> out;
    const MechanismPicture::Body& body = picture.bodies[picture.output];
    for (std::size_t k = 0; k < body.p.size(); ++k) out.push_back(placed(body, picture.output_point, k));
    return out;
  }

 private:
  Eigen::Vector2d flat(const Vector3d& v) const { return {across_.dot(v), down_.dot(v)}; }
  void include(const Vector3d& v) {
    low_ = low_.cwiseMin(flat(v));
    high_ = high_.cwiseMax(flat(v));
  }

  static constexpr double margin = 48;
  DrawingArea area_;
  Vector3d across_, down_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
  double scale_ = 1;
};

std::string lineThrough(const std::string& style, const std::vector<Vector3d>& points, const Projection& on,
                        bool closed) {
  std::string d;
  for (const Vector3d& point : points) {
    const Eigen::Vector2d at = on.at(point);
    d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : "L", at.x(), at.y());
  }
  return fmt::format("<path class=\"{}\" d=\"{}{}\"/>", style, d, closed ? "Z" : "");
}

std::string bodyDrawn(const MechanismPicture::Body& body, const std::string& style, const Projection& on) {
  const BodyShape shape = shapeOf(body);
  std::vector<Vector3d> points;
  for (const std::size_t k : shape.points) points.push_back(placed(body, body.points[k], 0));
  if (points.size() < 2) return "";
  return lineThrough(style + (shape.plate ? " plate" : " thin"), points, on, shape.plate);
}

std::string jointDrawn(const MechanismPicture& picture, const MechanismPicture::Joint& joint, const Projection& on) {
  if (joint.kind == JointKind::fixed || joint.kind == JointKind::free) return "";
  const Vector3d there = placed(picture.bodies[joint.child], joint.at_child, 0);
  std::string out;
  if (joint.kind == JointKind::prismatic)
    out += lineThrough("rail", {placed(picture.bodies[joint.parent], joint.at_parent, 0), there}, on, false);
  const Eigen::Vector2d at = on.at(there);
  return out + fmt::format("<circle class=\"joint{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>",
                           joint.motor >= 0 ? " driven" : "", at.x(), at.y(), joint.motor >= 0 ? 6 : 4);
}

/// The motors' names below their joints; one that would cover another moves down.
std::string motorsNamed(const MechanismPicture& picture, const std::vector<bool>& wrong, const Projection& on) {
  constexpr double line = 15, letter = 7.5, slack = 1e-6;  // a rounded sum must not count as covered for ever
  std::vector<Eigen::Vector2d> taken;
  std::vector<std::size_t> widths;
  std::string out;
  for (const MechanismPicture::Joint& joint : picture.joints) {
    if (joint.motor < 0) continue;
    const std::size_t k = joint.motor;
    const bool is_wrong = k < wrong.size() && wrong[k];
    const std::string text = (is_wrong ? "✗ " : "") + joint.name;
    Eigen::Vector2d at = on.at(placed(picture.bodies[joint.child], joint.at_child, 0)) + Eigen::Vector2d(0, 21);
    for (std::size_t i = 0; i < taken.size(); ++i)
      if (std::abs(taken[i].y() - at.y()) < line - slack &&
          std::abs(taken[i].x() - at.x()) < letter * static_cast<double>(widths[i] + columnsOf(text)) / 2)
        at.y() = taken[i].y() + line, i = static_cast<std::size_t>(-1);
    taken.push_back(at);
    widths.push_back(columnsOf(text));
    out += fmt::format("<text class=\"motor{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
                       is_wrong ? " wrong" : "", at.x(), at.y(), escaped(text));
  }
  return out;
}

}  // namespace

std::string drawn(const MechanismPicture& picture, const Vector3d& forward, const DrawingArea& area,
                  const std::vector<bool>& wrong) {
  const Projection on(picture, forward, area);
  std::string out;
  for (const MechanismPicture::Body& body : picture.bodies)
    if (body.fixed) out += bodyDrawn(body, "base", on);
  std::size_t moving = 0;
  for (std::size_t b = 0; b < picture.bodies.size(); ++b) {
    if (picture.bodies[b].fixed) continue;
    const std::size_t color = moving++ % 7;
    out += bodyDrawn(picture.bodies[b], b == picture.output ? "platform" : fmt::format("link c{}", color), on);
  }
  for (const MechanismPicture::Joint& joint : picture.joints) out += jointDrawn(picture, joint, on);
  const std::vector<Vector3d> path = Projection::pathOf(picture);
  if (path.size() > 1) out += lineThrough("path", path, on, false);
  return out + motorsNamed(picture, wrong, on);
}

double scaleOf(const MechanismPicture& picture, const Vector3d& forward, const DrawingArea& area) {
  return Projection(picture, forward, area).scale();
}

std::string svgMachine(const MechanismPicture& picture, const std::vector<int>& wrong) {
  std::vector<bool> marked(picture.motors.size(), false);
  for (const int motor : wrong)
    if (const auto k = static_cast<std::size_t>(motor); k < marked.size()) marked[k] = true;
  const DrawingArea area{0, 0, 640, 420};
  return fmt::format(
      "<svg class=\"machine\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
      "aria-label=\"The machine at the start of its motion, with the path of {}\">{}</svg>",
      area.width, area.height, escaped(picture.bodies[picture.output].name),
      drawn(picture, viewOf(picture), area, marked));
}

}  // namespace ursula::report
