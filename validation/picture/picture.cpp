#include "validation/picture/picture.h"

#include <Eigen/Geometry>

#include "nocsolver/solver.h"

namespace ursula {
namespace {

/// The paper's leg: universal at A with the motor on its first axis, a pin at the knee R, a ball at B.
struct LegTracks {
  Picture::Track A, R, B, u, x;

  void add(const Leg& leg, const Matrix3d& proximal, const Matrix3d& distal, const Vector3d& origin) {
    const Vector3d knee = leg.base_point + leg.proximal.length * proximal.col(2);
    A.push_back(leg.base_point - origin);
    R.push_back(knee - origin);
    B.push_back(knee + leg.distal.length * distal.col(2) - origin);
    u.push_back(leg.base_axis.normalized());
    x.push_back(proximal.col(0));
  }

  Picture::Leg leg() const {
    return {"URS",
            {{A, R}, {R, B}},
            {{"universal joint", A, {u, x}, true}, {"pin", R, {x}, false}, {"ball", B, {}, false}}};
  }
};

Eigen::Vector4d quaternion(const Matrix3d& Q, const std::vector<Eigen::Vector4d>& before) {
  const Eigen::Quaterniond q(Q);
  const Eigen::Vector4d next(q.w(), q.x(), q.y(), q.z());
  return before.empty() || next.dot(before.back()) >= 0 ? next : Eigen::Vector4d(-next);
}

/// Evenly picked, the last among them.
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
  for (int i = 0; i < leg_count; ++i) {
    picture->origin += machine.leg(i).base_point / leg_count;
    picture->platform_points.push_back(machine.leg(i).platform_point);
  }
  const Solver<double> solver(machine);
  Workspace<double> work;
  BodyMotions<double> bodies;
  std::vector<LegTracks> legs(leg_count);
  for (const double t : instants) {
    const Motion<double> motion = scenario.trajectory->at(t);
    solver.inverseKinematics(motion, work);
    solver.bodyMotions(motion, work, bodies);
    picture->t.push_back(t);
    picture->p.push_back(motion.p - picture->origin);
    picture->q.push_back(quaternion(motion.Q, picture->q));
    for (std::size_t k = 0; k < legs.size(); ++k)
      legs[k].add(machine.leg(static_cast<int>(k)), bodies[k].R, bodies[leg_count + k].R, picture->origin);
  }
  for (const LegTracks& leg : legs) picture->legs.push_back(leg.leg());
  picture->scenario = scenario;
  return picture;
}

void addPicture(const Scenario& scenario, ValidationResult& result) {
  constexpr std::size_t smooth_to_the_eye = 601;
  const std::vector<double>* t = result.timeseries.find("t_s");
  if (t != nullptr && !t->empty()) result.picture = makePicture(scenario, atMost(smooth_to_the_eye, *t));
}

}  // namespace ursula
