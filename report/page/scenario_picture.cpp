#include "report/page/scenario_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "nocsolver/errors.h"
#include "nocsolver/noc/noc.h"
#include "report/text/text.h"
#include "validation/subject/leg_points.h"

namespace ursula {
namespace {

constexpr double panel = 460, margin = 50, title = 40;  // px

/// Points of the machine at one instant, m, in B.
struct Pose {
  Vector3d P;
  std::vector<LegPoints> legs;
  std::vector<std::optional<RailSection>> rails;
  std::vector<LegKind> kinds;
  bool reached;  ///< false if the legs cannot take the pose; R and S are then meaningless
};

Pose poseAtStart(const Scenario& scenario) {
  const Manipulator& machine = *scenario.manipulator;
  const Motion<double> motion = scenario.trajectory->at(0);
  Pose pose{motion.p, {}, rails(scenario), {}, true};
  for (const Leg& leg : machine.parameters().legs) pose.kinds.push_back(leg.kind);
  const Noc<double> solver(machine);
  NocWorkspace<double> work;
  try {
    solver.displacements(motion, work);
    pose.legs = legPoints(machine, work);
  } catch (const PoseError&) {
    pose.reached = false;
    for (const Leg& leg : machine.parameters().legs)
      pose.legs.push_back({leg.base_point, {}, {}, motion.p + motion.Q * leg.platform_point, {}});
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
    out += polygon(&LegPoints::A, "base") + polygon(&LegPoints::B, "platform");
    for (std::size_t i = 0; i < pose_.legs.size(); ++i) out += leg(i);
    return out + dot(pose_.P, "origin");
  }

 private:
  std::string leg(std::size_t i) const {
    const LegPoints& leg = pose_.legs[i];
    const bool slides = rowOf(pose_.kinds[i]).isTelescopic();
    std::string out;
    if (pose_.rails[i]) out += line(pose_.rails[i]->from, pose_.rails[i]->to, "rail");
    if (!pose_.reached) {
      out += line(leg.A, leg.B, "unreached");
    } else {
      out += line(leg.A, leg.R, slides ? "proximal cylinder" : "proximal") + line(leg.S, leg.B, "distal");
      if (!slides) out += dot(leg.R, pose_.rails[i] ? "carriage" : "knee");
    }
    return out + dot(leg.A, "joint") + dot(leg.B, "joint") + number(i);
  }

  double x(const Vector3d& p) const { return left_ + panel / 2 + scale_ * (p(across_) - middle_(across_)); }
  double y(const Vector3d& p) const { return title + panel / 2 - scale_ * (p(up_) - middle_(up_)); }

  std::string line(const Vector3d& from, const Vector3d& to, const char* kind) const {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x(from),
                       y(from), x(to), y(to), kind);
  }
  std::string dot(const Vector3d& at, const char* kind) const {
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" class=\"{}\"/>\n", x(at), y(at), kind);
  }
  /// Legs that start at one place of the page share a label.
  std::string number(std::size_t i) const {
    constexpr double near = 12;  // px
    std::string all;
    for (std::size_t k = 0; k < pose_.legs.size(); ++k) {
      const Vector3d &of_k = pose_.legs[k].A, &of_i = pose_.legs[i].A;
      if (std::abs(x(of_k) - x(of_i)) > near || std::abs(y(of_k) - y(of_i)) > near) continue;
      if (k < i) return "";
      all += fmt::format("{}{}", all.empty() ? "" : ", ", k + 1);
    }
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x(pose_.legs[i].A) + 6, y(pose_.legs[i].A) + 14,
                       all);
  }
  std::string polygon(Vector3d LegPoints::*corner, const char* kind) const {
    std::string points;
    for (const LegPoints& leg : pose_.legs) points += fmt::format("{:.1f},{:.1f} ", x(leg.*corner), y(leg.*corner));
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
.cylinder { stroke-width: 6; stroke-opacity: 0.45 } .rail { stroke: #999; stroke-width: 4; stroke-opacity: 0.6 }
.joint { fill: #444 } .carriage { fill: #c50; stroke: #444; stroke-width: 1.5 } .knee { fill: #fff; stroke: #444; stroke-width: 1.5 } .origin { fill: #06c }
</style>
)";

/// A bar of round length, 1, 2 or 5 times a power of ten, a quarter to a half of the panel.
std::string scaleBar(double scale) {
  const double most = panel / 2.5 / scale, power = std::pow(10, std::floor(std::log10(most)));
  const double length = most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
  return fmt::format(
      "<line x1=\"{0}\" y1=\"{1}\" x2=\"{2:.1f}\" y2=\"{1}\" stroke=\"#444\"/>\n<text x=\"{0}\" y=\"{3}\">{4:g} "
      "m</text>\n",
      margin, title + panel + 45, margin + scale * length, title + panel + 62, length);
}

}  // namespace

std::string picture(const Scenario& scenario) {
  const Pose pose = poseAtStart(scenario);
  Eigen::AlignedBox3d box(pose.P);
  for (std::size_t i = 0; i < pose.legs.size(); ++i) {
    const LegPoints& leg = pose.legs[i];
    box.extend(leg.A).extend(leg.B);
    if (pose.reached) box.extend(leg.R).extend(leg.S);
    if (pose.rails[i]) box.extend(pose.rails[i]->from).extend(pose.rails[i]->to);
  }
  const double scale = (panel - 2 * margin) / std::max(box.sizes().maxCoeff(), 1e-300);
  const Vector3d middle = box.center();
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\">\n{}<rect width=\"100%\" height=\"100%\" "
             "fill=\"#fff\"/>\n<text x=\"{}\" y=\"26\" style=\"font-size:16px\">{}, t = 0{}</text>\n",
             2 * panel, title + panel + 75, style, margin, report::escaped(scenario.name),
             pose.reached ? "" : ": the legs cannot take this pose") +
         View(pose, 0, 2, 0, scale, middle).drawing("from the front: x to the right, z up") +
         View(pose, 0, 1, panel, scale, middle).drawing("from above: x to the right, y up") + scaleBar(scale) +
         "</svg>\n";
}

}  // namespace ursula
