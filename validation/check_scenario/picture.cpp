#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "nocsolver/errors.h"
#include "nocsolver/solver.h"
#include "validation/check_scenario/check_scenario.h"

namespace ursula {
namespace {

constexpr double panel = 460, margin = 50, title = 40;  // px

/// Points of the machine at one instant, m, in B.
struct Pose {
  Vector3d P;
  std::array<Vector3d, leg_count> A, B;
  std::optional<std::array<Vector3d, leg_count>> R;  ///< none where the legs cannot take the pose
};

std::optional<std::array<Vector3d, leg_count>> knees(const Scenario& scenario, const Motion<double>& motion) {
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  BodyMotions<double> bodies;
  try {
    solver.inverseKinematics(motion, work);
    solver.bodyMotions(motion, work, bodies);
  } catch (const PoseError&) {
    return std::nullopt;
  }
  std::array<Vector3d, leg_count> R;
  for (std::size_t i = 0; i < leg_count; ++i) {
    const Leg& leg = scenario.manipulator->leg(static_cast<int>(i));
    R[i] = leg.base_point + leg.proximal.length * bodies[i].R.col(2);
  }
  return R;
}

Pose poseAtStart(const Scenario& scenario) {
  const Motion<double> motion = scenario.trajectory->at(0);
  Pose pose{motion.p, {}, {}, knees(scenario, motion)};
  for (std::size_t i = 0; i < leg_count; ++i) {
    const Leg& leg = scenario.manipulator->leg(static_cast<int>(i));
    pose.A[i] = leg.base_point;
    pose.B[i] = motion.p + motion.Q * leg.platform_point;
  }
  return pose;
}

/// One view: two axes of B on the page, `across` to the right and `up` upwards.
class View {
 public:
  View(const Pose& pose, int across, int up, double left, double scale, const Vector3d& middle)
      : pose_(pose), across_(across), up_(up), left_(left), scale_(scale), middle_(middle) {}

  std::string drawing(const std::string& caption) const {
    std::string out = fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"caption\">{}</text>\n", left_ + panel / 2,
                                  title + panel + 30, caption);
    out += polygon(pose_.A, "base") + polygon(pose_.B, "platform");
    for (std::size_t i = 0; i < leg_count; ++i) {
      if (pose_.R) {
        out += line(pose_.A[i], (*pose_.R)[i], "proximal") + line((*pose_.R)[i], pose_.B[i], "distal");
        out += dot((*pose_.R)[i], "knee");
      } else {
        out += line(pose_.A[i], pose_.B[i], "unreached");
      }
      out += dot(pose_.A[i], "joint") + dot(pose_.B[i], "joint") + number(i);
    }
    return out + dot(pose_.P, "origin");
  }

 private:
  double x(const Vector3d& p) const { return left_ + panel / 2 + scale_ * (p(across_) - middle_(across_)); }
  double y(const Vector3d& p) const { return title + panel / 2 - scale_ * (p(up_) - middle_(up_)); }

  std::string line(const Vector3d& from, const Vector3d& to, const char* kind) const {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x(from),
                       y(from), x(to), y(to), kind);
  }
  std::string dot(const Vector3d& at, const char* kind) const {
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" class=\"{}\"/>\n", x(at), y(at), kind);
  }
  std::string number(std::size_t i) const {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x(pose_.A[i]) + 6, y(pose_.A[i]) + 14, i + 1);
  }
  std::string polygon(const std::array<Vector3d, leg_count>& corners, const char* kind) const {
    std::string points;
    for (const Vector3d& corner : corners) points += fmt::format("{:.1f},{:.1f} ", x(corner), y(corner));
    return fmt::format("<polygon points=\"{}\" class=\"{}\"/>\n", points, kind);
  }

  const Pose& pose_;
  int across_, up_;
  double left_, scale_;
  Vector3d middle_;
};

constexpr const char* style = R"(<style>
text { font: 13px sans-serif; fill: #444 } .caption { text-anchor: middle; font-size: 14px }
line, polygon { fill: none; stroke-width: 2 } .base { stroke: #666; fill: #6661 } .platform { stroke: #06c; fill: #06c2 }
.proximal { stroke: #c50 } .distal { stroke: #181 } .unreached { stroke: #d00; stroke-dasharray: 6 5 }
.joint { fill: #444 } .knee { fill: #fff; stroke: #444; stroke-width: 1.5 } .origin { fill: #06c }
</style>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return out;
}

/// A round length, 1, 2 or 5 times a power of ten, of a quarter to a half of the panel.
std::string scaleBar(double scale) {
  const double most = panel / 2.5 / scale, power = std::pow(10, std::floor(std::log10(most)));
  const double length = most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
  return fmt::format(
      "<line x1=\"{0}\" y1=\"{1}\" x2=\"{2:.1f}\" y2=\"{1}\" stroke=\"#444\"/>\n<text x=\"{0}\" "
      "y=\"{3}\">{4:g} m</text>\n",
      margin, title + panel + 45, margin + scale * length, title + panel + 62, length);
}

}  // namespace

std::string picture(const Scenario& scenario) {
  const Pose pose = poseAtStart(scenario);
  Eigen::AlignedBox3d box(pose.P);
  for (std::size_t i = 0; i < leg_count; ++i) {
    box.extend(pose.A[i]).extend(pose.B[i]);
    if (pose.R) box.extend((*pose.R)[i]);
  }
  const double scale = (panel - 2 * margin) / std::max(box.sizes().maxCoeff(), 1e-300);
  const Vector3d middle = box.center();
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\">\n{}<rect width=\"100%\" "
             "height=\"100%\" fill=\"#fff\"/>\n<text x=\"{}\" y=\"26\" style=\"font-size:16px\">{}, t = 0{}"
             "</text>\n",
             2 * panel, title + panel + 75, style, margin, escaped(scenario.name),
             pose.R ? "" : ": the legs cannot take this pose") +
         View(pose, 0, 2, 0, scale, middle).drawing("from the front: x to the right, z up") +
         View(pose, 0, 1, panel, scale, middle).drawing("from above: x to the right, y up") + scaleBar(scale) +
         "</svg>\n";
}

}  // namespace ursula
