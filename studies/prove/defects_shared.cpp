// What all formulations share, so that none of them can see it: the commanded motion, the load, the numbers as read.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "model/exact_trajectory.h"
#include "model/trajectories.h"
#include "studies/prove/defect_helpers.h"
#include "validation/checks/file_as_written.h"

namespace ursula {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// `wrong`, which is still held against the file where `right` is.
Scenario asRead(const Scenario& right, Scenario wrong) {
  if (right.isAsRead()) wrong.markAsRead();
  return wrong;
}

using ChangeAt = std::function<void(Motion<double>& motion, const Trajectory& right)>;

/// Wrong in doubles; the 50-digit pose stays right.
class FaultyTrajectory final : public ExactTrajectory {
 public:
  FaultyTrajectory(std::shared_ptr<const Trajectory> right, ChangeAt change)
      : right_(std::move(right)), change_(std::move(change)) {}
  std::string kind() const override { return right_->kind(); }
  double duration() const override { return right_->duration(); }
  Motion<double> at(double t) const override {
    Motion<double> motion = right_->at(t);
    change_(motion, *right_);
    return motion;
  }
  Motion<Real50> at(const Real50& t) const override { return right_->at(t); }
  std::unique_ptr<Trajectory> relativeTo(const Vector3d& origin) const override {
    std::shared_ptr<const Trajectory> moved = right_->relativeTo(origin);
    return moved ? std::make_unique<FaultyTrajectory>(std::move(moved), change_) : nullptr;
  }
  const std::vector<double>& knots() const override { return right_->knots(); }

 private:
  std::shared_ptr<const Trajectory> right_;
  ChangeAt change_;
};

Defect shared(const std::string& name, const std::string& group, const InjectedFault::Seen& scenario) {
  Defect out{name, group};
  out.scenario = scenario;
  out.engines = 1;
  return out;
}

Defect sharedMotion(const char* name, const ChangeAt& change) {
  return shared(name, "shared motion", [change](const Scenario& s) {
    Scenario wrong = s;
    wrong.trajectory = std::make_shared<const FaultyTrajectory>(s.trajectory, change);
    return asRead(s, wrong);
  });
}

Defect sharedLoad(const char* name, const std::function<void(Load&, const Scenario&)>& change) {
  return shared(name, "shared load", [change](const Scenario& s) {
    if (!s.load) return s;
    const auto load = std::make_shared<Load>(*s.load);
    change(*load, s);
    Scenario wrong = s;
    wrong.load = load;
    return asRead(s, wrong);
  });
}

using ChangeRows = std::function<std::vector<TimedWrench>(std::vector<TimedWrench>, const Scenario&)>;

/// Other rows; where the load is constant it stays.
Defect sharedRows(const char* name, const ChangeRows& change) {
  return sharedLoad(name, [change](Load& load, const Scenario& s) {
    if (load.history) load.history = std::make_shared<const LoadHistory>(change(load.history->rows(), s));
  });
}

Wrench<double> between(const TimedWrench& a, const TimedWrench& b, double share) {
  return {(1 - share) * a.wrench.force + share * b.wrench.force,
          (1 - share) * a.wrench.moment + share * b.wrench.moment};
}

std::vector<TimedWrench> interpolatedLinearly(const std::vector<TimedWrench>& rows, const Scenario&) {
  constexpr int pieces = 20;
  std::vector<TimedWrench> out;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    for (int k = 0; k < pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      out.push_back({rows[i].time + share * (rows[i + 1].time - rows[i].time), between(rows[i], rows[i + 1], share)});
    }
  out.push_back(rows.back());
  return out;
}

/// Each row changed.
ChangeRows eachRow(const std::function<void(TimedWrench&, const Scenario&)>& change) {
  return [change](std::vector<TimedWrench> rows, const Scenario& s) {
    for (TimedWrench& row : rows) change(row, s);
    return rows;
  };
}

Defect misread(const std::string& name, const ChangeMachine& change) {
  return shared(name, "reading", [change](const Scenario& s) {
    Scenario wrong = s;
    wrong.manipulator = std::make_shared<const Manipulator>(changedMachine(*s.manipulator, change));
    return asRead(s, wrong);
  });
}

/// Other poses, where the motion goes through some.
Defect misreadPoses(const char* name, const std::function<void(std::vector<TimedPose>&)>& change) {
  return shared(name, "reading", [change](const Scenario& s) {
    std::optional<FileAsWritten> file = asWritten(s);
    if (!file || file->trajectory.kind != "waypoints") return s;
    change(file->trajectory.poses);
    Scenario wrong = s;
    wrong.trajectory = makeWaypoints(file->trajectory.poses);
    return asRead(s, wrong);
  });
}

void swapProducts(Matrix3d& inertia, int a, int b, int c, int d) {
  std::swap(inertia(a, b), inertia(c, d));
  std::swap(inertia(b, a), inertia(d, c));
}

}  // namespace

std::vector<Defect> sharedMotionDefects(const Manipulator&) {
  using M = Motion<double>;
  using T = Trajectory;
  return {sharedMotion("commanded P off by 1e-12 m", [](M& m, const T&) { m.p.x() += 1e-12; }),
          sharedMotion("commanded orientation off by 1e-12",
                       [](M& m, const T&) { m.Q = (Eigen::AngleAxisd(1e-12, Vector3d::UnitY()) * m.Q).eval(); }),
          sharedMotion("commanded orientation longer than 1 by 1e-12", [](M& m, const T&) { m.Q *= 1 + 1e-12; }),
          sharedMotion("v off by 1e-9 of itself", [](M& m, const T&) { m.p_dot *= 1 + 1e-9; }),
          sharedMotion("omega off by 1e-9 of itself", [](M& m, const T&) { m.omega *= 1 + 1e-9; }),
          sharedMotion("v late by 1e-9 s", [](M& m, const T& right) { m.p_dot = right.at(m.t - 1e-9).p_dot; }),
          sharedMotion("a off by 1e-9 of itself", [](M& m, const T&) { m.p_ddot *= 1 + 1e-9; }),
          sharedMotion("alpha off by 1e-9 of itself", [](M& m, const T&) { m.omega_dot *= 1 + 1e-9; }),
          sharedMotion("omega in the platform's axes",
                       [](M& m, const T&) { m.omega = (m.Q.transpose() * m.omega).eval(); }),
          sharedMotion("alpha in the platform's axes",
                       [](M& m, const T&) { m.omega_dot = (m.Q.transpose() * m.omega_dot).eval(); }),
          sharedMotion("alpha without 1e-8 of what is along omega",
                       [](M& m, const T&) { m.omega_dot -= 1e-8 * m.omega_dot.dot(m.omega) * m.omega; }),
          sharedMotion("a with 1e-9 of omega x v", [](M& m, const T&) { m.p_ddot += 1e-9 * m.omega.cross(m.p_dot); })};
}

std::vector<Defect> sharedLoadDefects(const Manipulator&) {
  return {
      sharedRows("load between its rows by straight lines", interpolatedLinearly),
      sharedRows("load's rows late by 1e-6 s", eachRow([](TimedWrench& row, const Scenario&) { row.time += 1e-6; })),
      sharedRows("load's moment about the mass centre", eachRow([](TimedWrench& row, const Scenario& s) {
                   row.wrench.moment += s.manipulator->platform().center_of_mass.cross(row.wrench.force);
                 })),
      sharedRows("load's force and moment exchanged",
                 eachRow([](TimedWrench& row, const Scenario&) { std::swap(row.wrench.force, row.wrench.moment); })),
      sharedRows("second row of the load off by 1e-15 of itself",
                 [](std::vector<TimedWrench> rows, const Scenario&) {
                   rows[1].wrench.force.z() *= 1 + 4 * eps;
                   return rows;
                 }),
      sharedLoad("load read in the other frame",
                 [](Load& load, const Scenario&) {
                   load.frame = load.frame == Load::Frame::base ? Load::Frame::platform : Load::Frame::base;
                 }),
      sharedLoad("load's point not read", [](Load& load, const Scenario&) { load.point.setZero(); })};
}

std::vector<Defect> readingDefects(const Manipulator& machine) {
  const std::size_t first = legOf(machine, 1), second = legOf(machine, 2), fourth = legOf(machine, 4),
                    sixth = legOf(machine, 6);
  const Coordinate last = coordinatesOf(machine, first)[2];
  using P = ManipulatorParameters;
  using Poses = std::vector<TimedPose>;
  return {misread("xz and yz exchanged in the platform's tensor",
                  [](P& m) { swapProducts(m.platform.inertia, 0, 2, 1, 2); }),
          misread("xy and xz exchanged in leg 2's tensors",
                  [=](P& m) {
                    swapProducts(m.legs[second].proximal.inertia, 0, 1, 0, 2);
                    swapProducts(m.legs[second].distal.inertia, 0, 1, 0, 2);
                  }),
          misread("one number off by 1e-15 of itself", [=](P& m) { m.legs[fourth].base_point.y() *= 1 + 4 * eps; }),
          misread("one number off in its last bit", [=](P& m) { m.legs[first].coulomb.on(last) *= 1 + eps; }),
          misread("axes normalised on reading",
                  [](P& m) {
                    for (Leg& leg : m.legs) leg.base_axis.normalize();
                  }),
          misread(fmt::format("smoothing speed of leg {} not read", sixth + 1),
                  [=](P& m) {
                    m.legs[sixth].coulomb.smoothing_speed = CoulombFriction{}.smoothing_speed;
                    m.legs[sixth].coulomb.sliding_speed = CoulombFriction{}.sliding_speed;
                  }),
          misread("numbers in single precision",
                  [](P& m) { m.platform.mass = static_cast<double>(static_cast<float>(m.platform.mass)); }),
          misreadPoses("quaternions as x, y, z, w",
                       [](Poses& poses) {
                         for (TimedPose& pose : poses) {
                           const Eigen::Vector4d q = pose.orientation;
                           pose.orientation << q(3), q(0), q(1), q(2);
                         }
                       }),
          misreadPoses("quaternions the other way round",
                       [](Poses& poses) {
                         for (TimedPose& pose : poses) pose.orientation.tail<3>() *= -1;
                       }),
          control(misread("number as read: no fault", [](P&) {})),
          misreadPoses("a waypoint's time off by 1e-15 of itself", [](Poses& poses) { poses[1].time *= 1 + 4 * eps; })};
}

}  // namespace ursula
