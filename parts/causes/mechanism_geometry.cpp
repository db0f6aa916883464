#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "parts/causes/mechanism_tried.h"

namespace ursula::mechanisms {
namespace {

/// What a wrong number moves: a joint's point on the body nearer to the ground, on the other one or on both; the whole
/// rest of the tree, with closures where they then are; or its axis, on both bodies.
enum class Way { near_point, far_point, point, rest, axis };
constexpr Way ways[] = {Way::near_point, Way::far_point, Way::point, Way::rest, Way::axis};

struct Place {
  std::size_t joint = 0;
  Way way = Way::point;
};

/// Moves a place of a machine by a vector in the world of the reference pose.
class Mover {
 public:
  explicit Mover(const Mechanism& mechanism) : mechanism_(mechanism), tree_(mechanism) {}

  const Mechanism& mechanism() const { return mechanism_; }
  bool isPossible(const Place& place) const {
    const MechanismJoint& joint = jointOf(place);
    if (joint.kind == JointKind::free) return false;
    if (place.way == Way::axis) return !joint.axis[0].isZero(0) && joint.kind != JointKind::universal;
    if (place.way == Way::point) return joint.kind != JointKind::fixed && !joint.slides();
    return tree_.isWhole() && (place.way != Way::rest || (tree_.holds(place.joint) && isTied(place)));
  }
  /// The body on which the place is; its joint's child if it is on both.
  std::size_t bodyOf(const Place& place) const {
    const MechanismJoint& joint = jointOf(place);
    const bool cut = !tree_.holds(place.joint), reversed = tree_.isReversed(place.joint);
    if (place.way == Way::point || place.way == Way::axis) return cut ? joint.parent : joint.child;
    return (place.way == Way::far_point) != reversed ? joint.child : joint.parent;
  }
  Vector3d at(const Place& place) const {
    const MechanismJoint& joint = jointOf(place);
    if (place.way == Way::axis) return joint.axis[0];
    return bodyOf(place) == joint.parent ? joint.centre : joint.centre_of_child;
  }
  void move(const Place& place, const Vector3d& by, MechanismParameters& machine) const {
    MechanismJoint& own = machine.joints[place.joint];
    const bool is_far = place.way == Way::far_point;
    if (place.way == Way::axis)
      own.axis[0] = (own.axis[0] + by).normalized();
    else if (place.way == Way::point)
      own.centre += by, own.centre_of_child += by;
    else if (!tree_.holds(place.joint))
      (is_far ? own.centre_of_child : own.centre) += by;
    else
      moveRest(place, is_far ? Vector3d(-by) : by, machine);
  }

 private:
  const MechanismJoint& jointOf(const Place& place) const { return mechanism_.joints()[place.joint]; }
  bool isBeyond(const Place& place, std::size_t body) const { return tree_.isBefore(place.joint, body); }

  /// Whether a closure ties what lies beyond the joint to something else.
  bool isTied(const Place& place) const {
    const auto& joints = mechanism_.joints();
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (!tree_.holds(j) && !joints[j].isOpen() &&
          isBeyond(place, joints[j].parent) != isBeyond(place, joints[j].child))
        return true;
    return false;
  }

  /// Moves all bodies beyond a joint, which stays closed.
  void moveRest(const Place& place, const Vector3d& by, MechanismParameters& machine) const {
    for (std::size_t b = 0; b < machine.bodies.size(); ++b)
      if (isBeyond(place, b)) machine.bodies[b].frame.translation() += by, machine.bodies[b].center_of_mass += by;
    for (std::size_t j = 0; j < machine.joints.size(); ++j) {
      MechanismJoint& joint = machine.joints[j];
      const bool is_own = j == place.joint, stays_closed = place.way == Way::rest && !joint.isOpen();
      const bool moves = !is_own || place.way != Way::far_point;
      if (moves && (is_own || isBeyond(place, joint.parent))) joint.centre += by;
      if (moves && (is_own || isBeyond(place, joint.child))) joint.centre_of_child += by;
      if (stays_closed) joint.centre_of_child = joint.centre;
    }
  }

  const Mechanism& mechanism_;
  const FileTree tree_;
};

/// The right efforts of a machine with other places of its joints; no numbers if its loops do not close.
VectorXd effortsOfMoved(const MechanismParameters& parameters, const EffortResidual& of) {
  VectorXd out = VectorXd::Constant(of.noc.size(), NAN);
  try {
    const Mechanism mechanism(parameters);
    const LoopSolver solver(mechanism);
    loops::LoopPose pose = solver.assembled();
    solver.moveTo(of.motion->trajectory().at(0).q, pose);
    LoopWork work;
    for (std::size_t i = 0; i < of.instants.size(); ++i) {
      const Instant& at = of.instants[i];
      solver.moveTo(at.motion.q, pose);
      const VectorXd efforts = solver.inverseDynamics(at.motion, pose, work);
      constexpr double closed = 1e-10;
      if (work.closing > std::max(closed, 10 * at.work.closing)) return VectorXd::Constant(of.noc.size(), NAN);
      out.segment(static_cast<Eigen::Index>(i) * of.motors, of.motors) = efforts;
    }
  } catch (const std::runtime_error&) {  // it cannot follow the motors
  } catch (const std::invalid_argument&) {
  }
  return out;
}

/// The plane in which the joint's bodies turn, as far as a hinge tells it, and the line across it, the third column.
Matrix3d planeOf(const Mechanism& mechanism, std::size_t j) {
  const MechanismJoint& joint = mechanism.joints()[j];
  Vector3d normal = joint.kind == JointKind::revolute ? joint.axis[0] : Vector3d(Vector3d::Zero());
  for (const MechanismJoint& other : mechanism.joints())
    for (const std::size_t body : {other.parent, other.child})
      if (normal.isZero(0) && other.kind == JointKind::revolute && (body == joint.parent || body == joint.child))
        normal = other.axis[0];
  if (normal.isZero(0)) normal = Vector3d::UnitZ();
  Matrix3d out;
  out << normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal()), normal;
  return out;
}

/// A place that is wrong along some directions, one number each.
Tried along(const Mover& mover, const Place& place, const MatrixXd& directions, const std::string& key) {
  const Mechanism& mechanism = mover.mechanism();
  const std::string& joint = mechanism.joints()[place.joint].name;
  Tried out;
  out.named.kind = CauseKind::parameter;
  out.named.joint = joint;
  if (place.way != Way::point && place.way != Way::axis) out.named.body = mechanism.bodies()[mover.bodyOf(place)].name;
  out.named.parameter = "joint." + joint + (place.way == Way::axis ? ".axis" : ".position") + key;
  if (place.way != Way::axis) out.named.unit = "m";
  if (place.way == Way::rest) out.detail = "with all that hangs on it";
  constexpr double step = 1e-5;
  const double size = place.way == Way::axis ? 1 : mechanism.length();
  out.steps = VectorXd::Constant(directions.cols(), step * size);
  out.change = [&mover, place, directions](const EffortResidual& of, const VectorXd& x) -> VectorXd {
    if (x.isZero(0)) return VectorXd::Zero(of.noc.size());
    MechanismParameters machine = of.mechanism->parameters();
    mover.move(place, directions * x, machine);
    return effortsOfMoved(machine, of) - of.noc;
  };
  return out;
}

void setOneNumber(double expected, Tried& tried) {
  tried.named.expected = expected;
  tried.finish = [expected](const VectorXd& x, const VectorXd& uncertainty, NamedCause& named) {
    named.found = expected + x(0);
    named.uncertainty = uncertainty(0);
    return true;
  };
}

/// Each entry in the body's own axes.
void addEntries(const Mover& mover, const Place& place, std::vector<Tried>& out) {
  const Eigen::Isometry3d& frame = mover.mechanism().bodies()[mover.bodyOf(place)].frame;
  const bool is_axis = place.way == Way::axis;
  const Vector3d own =
      is_axis ? Vector3d(frame.linear().transpose() * mover.at(place)) : frame.inverse() * mover.at(place);
  for (int k = 0; k < 3; ++k) {
    if (is_axis && std::abs(own(k)) > 0.99) continue;
    out.push_back(along(mover, place, frame.linear().col(k), fmt::format(".{}", k)));
    setOneNumber(asWritten(own(k), is_axis ? 1 : mover.mechanism().length()), out.back());
    if (!is_axis) continue;
    out.back().finish = [own, k](const VectorXd& x, const VectorXd& uncertainty, NamedCause& named) {
      named.found = (own + x(0) * Vector3d::Unit(k)).normalized()(k);
      named.uncertainty = uncertainty(0);
      return true;
    };
  }
}

/// The length of a moving body with two joints, of which one is at the wrong place.
void addLength(const Mover& mover, const Place& place, std::vector<Tried>& out) {
  const Mechanism& mechanism = mover.mechanism();
  const std::size_t b = mover.bodyOf(place);
  if ((place.way != Way::near_point && place.way != Way::far_point) || mechanism.bodies()[b].fixed) return;
  std::vector<Vector3d> others;
  for (std::size_t j = 0; j < mechanism.joints().size(); ++j) {
    const MechanismJoint& joint = mechanism.joints()[j];
    if (j == place.joint || joint.kind == JointKind::free) continue;
    if (joint.parent == b) others.push_back(joint.centre);
    if (joint.child == b) others.push_back(joint.centre_of_child);
  }
  if (others.size() != 1) return;
  const MechanismJoint& own = mechanism.joints()[place.joint];
  Vector3d line = mover.at(place) - others.front();
  if (own.kind == JointKind::revolute) line -= own.axis[0] * own.axis[0].dot(line);
  if (line.norm() < 1e-6 * mechanism.length()) return;
  Tried tried = along(mover, place, line.normalized(), "");
  tried.detail = "at joint '" + own.name + "'";
  tried.named.joint.clear();
  tried.named.parameter = "body." + tried.named.body + ".length";
  setOneNumber(asWritten(line.norm(), mechanism.length()), tried);
  out.push_back(std::move(tried));
}

constexpr std::size_t screened_instants = 14, most_likely = 10;
/// A place whose numbers leave more of the deviation, to first order, is not tried; effects of large errors bend.
constexpr double may_bend = 0.4;

struct LikelyPlace {
  Place place;
  MatrixXd directions;  ///< along which the loops close
  double unexplained = 1;
};

/// How much of the deviation a place explains to first order, along directions in which the loops close.
LikelyPlace toFirstOrder(const Mover& mover, const Place& place, const EffortResidual& few) {
  LikelyPlace out{place, MatrixXd(3, 0)};
  MatrixXd columns(few.noc.size(), 0);
  const Matrix3d plane = planeOf(mover.mechanism(), place.joint);
  for (int k = 0; k < 3; ++k) {
    if (place.way == Way::axis && std::abs(plane.col(k).dot(mover.at(place))) > 0.99) continue;
    const Tried one = along(mover, place, plane.col(k), "");
    const VectorXd effect = one.change(few, one.steps);
    if (!effect.allFinite() || !(effect.norm() > 1e-9 * few.noc.norm())) continue;
    for (MatrixXd* each : {&out.directions, &columns}) each->conservativeResize(Eigen::NoChange, each->cols() + 1);
    out.directions.rightCols<1>() = plane.col(k);
    columns.rightCols<1>() = effect.normalized();
  }
  if (columns.cols() == 0) return out;
  const VectorXd residual = few.residual();
  const VectorXd left = residual - columns * columns.colPivHouseholderQr().solve(residual);
  out.unexplained = left.norm() / residual.norm();
  return out;
}

}  // namespace

std::vector<Fitted> fittedGeometry(const EffortResidual& data) {
  const Mover mover(*data.mechanism);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0, n = std::min(screened_instants, data.t.size()); i < n; ++i)
    rows.push_back(i * (data.t.size() - 1) / std::max<std::size_t>(1, n - 1));
  const EffortResidual few = picked(data, rows, 0);
  std::vector<LikelyPlace> likely;
  for (std::size_t j = 0; j < data.mechanism->joints().size(); ++j)
    for (const Way way : ways)
      if (mover.isPossible({j, way})) likely.push_back(toFirstOrder(mover, {j, way}, few));
  std::stable_sort(likely.begin(), likely.end(),
                   [](const LikelyPlace& a, const LikelyPlace& b) { return a.unexplained < b.unexplained; });
  std::vector<Tried> tried, good;
  for (std::size_t i = 0; i < std::min(most_likely, likely.size()) && likely[i].unexplained < may_bend; ++i) {
    addEntries(mover, likely[i].place, tried);
    addLength(mover, likely[i].place, tried);
    if (likely[i].directions.cols() > 1) tried.push_back(along(mover, likely[i].place, likely[i].directions, ""));
  }
  for (const Tried& one : tried) {
    constexpr double may_be_good = 20;
    const std::vector<Fitted> fitted = fitAll({one}, few);
    if (!fitted.empty() && fitted.front().beyond <= may_be_good) good.push_back(one);
  }
  std::vector<Fitted> out = fitAll(good, data);
  std::stable_sort(out.begin(), out.end(), [](const Fitted& a, const Fitted& b) { return a.numbers < b.numbers; });
  return out;
}

}  // namespace ursula::mechanisms
