#include "report/page/picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>

#include "validation/subject/leg_points.h"

namespace ursula {
namespace {

/// Tracks of a leg's points and axes, and the names of its joints.
class LegTracks {
 public:
  LegTracks(const Leg& leg, const std::optional<RailSection>& rail, const Vector3d& origin)
      : leg_(leg), origin_(origin), rail_(rail) {}

  void add(const LegPoints& points) {
    A_.push_back(points.A - origin_);
    R_.push_back(points.R - origin_);
    S_.push_back(points.S - origin_);
    B_.push_back(points.B - origin_);
    for (std::size_t j = 0; j < 3; ++j) axes_[j].push_back(-points.axes[j]);
  }

  Picture::Leg leg() const {
    Picture::Leg out{rowOf(leg_.kind).name, {{A_, R_}, {S_, B_}}, joints(), {}};
    if (rail_) {
      const std::size_t instants = A_.size();
      out.rails.push_back(
          {Picture::Track(instants, rail_->from - origin_), Picture::Track(instants, rail_->to - origin_)});
    }
    return out;
  }

 private:
  /// Joints of coordinates that share a point: those before the first link, and those after it.
  std::vector<Picture::Joint> joints() const {
    const LegKindRow& row = rowOf(leg_.kind);
    std::vector<Picture::Joint> out;
    const std::size_t first = row.joints_of_proximal;
    addJoint(0, first, row.hasCarriage() ? R_ : A_, out);
    addJoint(first, 3, R_, out);
    out.push_back({"ball", B_, {}, false, false});
    return out;
  }

  /// Adds one joint for the coordinates from `begin` to `end`, or one per coordinate if two motors drive it.
  void addJoint(std::size_t begin, std::size_t end, const Picture::Track& at, std::vector<Picture::Joint>& out) const {
    const auto driven = std::count(leg_.actuated.begin() + static_cast<std::ptrdiff_t>(begin),
                                   leg_.actuated.begin() + static_cast<std::ptrdiff_t>(end), true);
    if (driven > 1) {
      for (std::size_t j = begin; j < end; ++j) addJoint(j, j + 1, at, out);
      return;
    }
    const bool slides = ursula::slides(rowOf(leg_.kind).coordinates[begin]);
    Picture::Joint joint{end - begin == 2 ? "universal joint" : slides ? "slide" : "pin", at, {}, driven == 1, slides};
    for (std::size_t j = begin; j < end; ++j)
      joint.axes.insert(leg_.actuated[j] ? joint.axes.begin() : joint.axes.end(), axes_[j]);
    out.push_back(std::move(joint));
  }

  const Leg& leg_;
  Vector3d origin_;
  std::optional<RailSection> rail_;
  Picture::Track A_, R_, S_, B_;
  std::array<Picture::Track, 3> axes_;  ///< reversed, so that the paper's u is u
};

Eigen::Vector4d quaternion(const Matrix3d& Q, const std::vector<Eigen::Vector4d>& before) {
  const Eigen::Quaterniond q(Q);
  const Eigen::Vector4d next(q.w(), q.x(), q.y(), q.z());
  return before.empty() || next.dot(before.back()) >= 0 ? next : Eigen::Vector4d(-next);
}

/// Picks instants evenly, including the last.
std::vector<double> atMost(std::size_t most, const std::vector<double>& t) {
  if (t.size() <= most) return t;
  std::vector<double> out;
  for (std::size_t i = 0; i < most; ++i) out.push_back(t[i * (t.size() - 1) / (most - 1)]);
  return out;
}

}  // namespace

std::shared_ptr<const Picture> makePicture(const Scenario& scenario, const std::vector<double>& instants) {
  auto picture = std::make_shared<Picture>();
  const Manipulator& machine = *scenario.manipulator;
  for (const Leg& leg : machine.parameters().legs) {
    picture->origin += leg.base_point / machine.legCount();
    picture->platform_points.push_back(leg.platform_point);
  }
  const std::vector<std::optional<RailSection>> on = rails(scenario);
  std::vector<LegTracks> legs;
  for (std::size_t k = 0; k < on.size(); ++k)
    legs.emplace_back(machine.leg(static_cast<int>(k)), on[k], picture->origin);
  const Noc<double> solver(machine);
  NocWorkspace<double> work;
  for (const double t : instants) {
    const Motion<double> motion = scenario.trajectory->at(t);
    solver.displacements(motion, work);
    picture->t.push_back(t);
    picture->p.push_back(motion.p - picture->origin);
    picture->q.push_back(quaternion(motion.Q, picture->q));
    const std::vector<LegPoints> points = legPoints(machine, work);
    for (std::size_t k = 0; k < legs.size(); ++k) legs[k].add(points[k]);
  }
  for (const LegTracks& leg : legs) picture->legs.push_back(leg.leg());
  picture->scenario = scenario;
  return picture;
}

std::shared_ptr<const Picture> pictureOf(const ValidationResult& result) {
  constexpr std::size_t smooth_to_the_eye = 601;
  const std::vector<double>* t = result.timeseries.find("t_s");
  if (result.asked == nullptr || t == nullptr || t->empty()) return nullptr;
  return makePicture(*result.asked, atMost(smooth_to_the_eye, *t));
}

}  // namespace ursula
