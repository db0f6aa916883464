#include "parts/poses/direct_kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <tuple>

#include "model/quaternions.h"
#include "parts/poses/direct_kinematics_parts.h"
#include "parts/poses/tracking.h"

namespace ursula {
namespace {

using direct::PlacedPlatform;
using direct::Planes;

constexpr double eps = Eigen::NumTraits<double>::epsilon();

/// Returns the quadrics' error bound: some 16 roundings from φ on, amplified by both eliminations.
double quadricRounding(const direct::Elimination& elimination) {
  return 16 * eps / (elimination.normals * elimination.independence);
}

/// At this ratio a double root spreads over the radius of one cluster, (16 eps/ratio)^½ = eps^⅛.
const double smallest_ratio = 16 * std::pow(eps, 0.75);

std::string describe(const std::string& what, double measure, double bound) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  text << what << ": " << measure << ", expected > " << bound;
  return text.str();
}

void require(double measure, const char* what) {
  if (!(measure > smallest_ratio)) throw UndeterminedPose(what, measure, smallest_ratio);
}

double widened(double worst, double error) { return error <= worst ? worst : error; }  // keeps a NaN

/// Sets one leg of the pose. Returns the largest mismatch in its three equations, m.
double readLeg(const LegModel<double>& leg, const Vector3d& AB, const Vector3d& x, const Vector3d& z, LegAtPose& out) {
  const double k_x = x.dot(AB), k_y = leg.u.dot(AB), r = z.dot(AB);  // second member of (13)
  const double q2 = AB.squaredNorm(), sum = leg.l + leg.s, difference = leg.l - leg.s, two_ls = 2 * leg.l * leg.s;
  out.distance = std::sqrt(q2);
  out.front = r > 0;
  const double one_minus = (q2 - difference * difference) / two_ls, one_plus = (sum * sum - q2) / two_ls;
  out.in_reach = one_minus >= 0 && one_plus >= 0;
  if (!out.in_reach) {
    out.psi = out.theta = std::numeric_limits<double>::quiet_NaN();
    return std::abs(k_x);
  }
  const double sine = leg.knee * std::sqrt(one_minus * one_plus), cosine = (one_plus - one_minus) / 2;
  out.theta = std::atan2(sine, cosine);                                                      // (paper, eq. 4a)
  out.psi = std::atan2(leg.s * sine, leg.l - leg.s * cosine) + std::atan2(r, k_y);           // (paper, eq. 14b)
  const double law = leg.l * leg.l + leg.s * leg.s - two_ls * std::cos(out.theta) - q2;      // (paper, eq. 27)
  const double y = leg.l * std::cos(out.psi) - leg.s * std::cos(out.psi + out.theta) - k_y;  // (paper, eq. 13)
  const double third = leg.l * std::sin(out.psi) - leg.s * std::sin(out.psi + out.theta) - r;
  double worst = std::abs(k_x);
  for (const double error : {law / sum, y, third}) worst = widened(worst, std::abs(error));
  return worst;
}

PlatformPose makePose(const MachineParameters<double>& model, const Planes& planes, const PlacedPlatform& placed) {
  PlatformPose pose;
  pose.p = placed.p;
  pose.q = withPositiveW(placed.q);
  pose.Q = direct::rotation(pose.q);
  pose.assembles = pose.front = true;
  for (int i = 0; i < leg_count; ++i) {
    const LegModel<double>& leg = model.legs[i];
    LegAtPose& out = pose.legs[i];
    const Vector3d AB = pose.p + pose.Q * leg.b - leg.a;
    pose.residual = widened(pose.residual, readLeg(leg, AB, planes.x(i), planes.z(i), out));
    pose.assembles = pose.assembles && out.in_reach;
    pose.front = pose.front && out.front;
  }
  return pose;
}

/// Applies Newton's method while it reduces the mismatch.
void polish(const Planes& planes, PlacedPlatform& pose) {
  Vector6d mismatch = planes.mismatch(pose);
  for (int i = 0; i < 3 && !(mismatch.cwiseAbs().maxCoeff() <= planes.rounding(pose)); ++i) {
    PlacedPlatform next = pose;
    int orientation = 0;
    planes.newtonStep(mismatch, next, orientation);
    const Vector6d left = planes.mismatch(next);
    if (!(left.norm() < mismatch.norm())) return;
    pose = next;
    mismatch = left;
  }
}

bool listedBefore(const PlatformPose& a, const PlatformPose& b) {
  const auto key = [](const PlatformPose& pose) {
    return std::tuple(!pose.assembles, !pose.front, -pose.q(0), -pose.q(1), -pose.q(2), -pose.q(3));
  };
  return key(a) < key(b);
}

}  // namespace

UndeterminedPose::UndeterminedPose(const std::string& what, double measure, double bound)
    : std::runtime_error(describe(what, measure, bound)), measure_(measure), bound_(bound) {}

const MachineParameters<double>& DirectKinematics::paper() const {
  if (!of_the_paper_)
    throw std::domain_error("all poses at once are known for six URS legs with a motor on each phi only");
  return solver_.machine();
}

PlatformPoses DirectKinematics::poses(const Vector6d& phi) const {
  if (!phi.allFinite()) throw std::invalid_argument("actuated angles must be finite");
  const Planes planes(paper(), phi);
  const direct::Elimination elimination = planes.eliminateP();
  require(elimination.normals, "the planes of the legs leave the platform free to move along a line, pivot ratio");
  require(elimination.independence * elimination.normals,
          "the planes of the legs leave the platform free to turn, pivot ratio");
  const direct::Roots roots = direct::findRoots(elimination.quadrics, quadricRounding(elimination));
  require(roots.pivot, "the planes of the legs leave the platform free to turn on a curve, pivot ratio");

  PlatformPoses out;
  out.counted = roots.counted;
  for (int i = 0; i < roots.size; ++i) {
    const direct::Root& root = roots.list[i];
    if (!root.real) continue;
    const Eigen::Vector4d q = root.q.real().normalized();
    PlacedPlatform placed{planes.p(q), q};
    polish(planes, placed);
    PlatformPose& pose = out.list[out.size++];
    pose = makePose(paper(), planes, placed);
    pose.multiplicity = root.multiplicity;
  }
  std::sort(out.list.begin(), out.list.begin() + out.size, listedBefore);
  return out;
}

/// Under Kantorovich's conditions each Newton step is at most half of the previous one. The sign of det B (23) changes
/// where poses merge, so a pose with the other sign is on another branch.
std::optional<PlatformPose> DirectKinematics::track(const Vector6d& phi, const PlatformPose& from) const {
  if (!phi.allFinite()) return std::nullopt;
  if (!of_the_paper_) return poses::track(solver_.noc(), phi, from);
  const Planes planes(paper(), phi);
  PlacedPlatform pose{from.p, from.q};
  double previous = std::numeric_limits<double>::infinity();
  int first_sign = 0, sign = 0;
  // Halving from a machine's length to its rounding takes at most as many steps as a double has bits.
  for (int i = 0; i < std::numeric_limits<double>::digits; ++i) {
    const Vector6d mismatch = planes.mismatch(pose);
    if (mismatch.cwiseAbs().maxCoeff() <= planes.rounding(pose)) return makePose(paper(), planes, pose);
    const double step = planes.newtonStep(mismatch, pose, sign);
    if (i == 0) first_sign = sign;
    if (!(step <= previous / 2) || sign != first_sign) return std::nullopt;
    previous = step;
  }
  return std::nullopt;
}

Motion<double> DirectKinematics::motion(const PlatformPose& pose, const Vector6d& phi_dot, const Vector6d& phi_ddot,
                                        Workspace<double>& work) const {
  Motion<double> motion;
  motion.p = pose.p;
  motion.Q = pose.Q;
  solver_.displacements(motion, work);
  solver_.jacobians(motion, work);
  const Matrix6d T = solver_.T(work);
  const Vector6d twist = T * phi_dot;  // (paper, eq. 24)
  motion.omega = twist.head<3>();
  motion.p_dot = twist.tail<3>();
  solver_.inverseKinematics(motion, work);  // Ṫ needs the rates of all joints
  const Vector6d twist_rate = T * phi_ddot + solver_.TRate(motion, work) * phi_dot;  // (paper, eq. 25)
  motion.omega_dot = twist_rate.head<3>();
  motion.p_ddot = twist_rate.tail<3>();
  return motion;
}

}  // namespace ursula
