#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "parts/causes/mechanism_tried.h"

namespace ursula::mechanisms {
namespace {

/// The numbers of one body in its own axes, which move with it.
struct BodyNumbers {
  double mass;
  Vector3d center;
  Matrix3d inertia;
};

BodyNumbers numbersOf(const MechanismBody& body) {
  const Matrix3d& F = body.frame.linear();
  return {body.mass, body.frame.inverse() * body.center_of_mass, F.transpose() * body.inertia * F};
}

/// A body's efforts with other numbers, by (37).
VectorXd effortsWith(const Mechanism& mechanism, const Instant& at, std::size_t b, const BodyNumbers& numbers) {
  const MechanismBody& body = mechanism.bodies()[b];
  const BodyState& state = at.work.bodies[b];
  const PointState center = pointOf(state, body.frame * numbers.center);
  const Matrix3d F = state.displacement.linear() * body.frame.linear();
  const Matrix3d I = F * numbers.inertia * F.transpose();
  const Vector3d omega = state.twist.head<3>(), alpha = state.twist_rate.head<3>();
  const Vector3d g = body.weightless ? Vector3d(Vector3d::Zero()) : mechanism.gravity();
  const Vector3d force = numbers.mass * (center.a - g);
  Vector6d w;
  w << Vector3d(I * alpha + omega.cross(I * omega)) + (center.x - state.center).cross(force), force;
  return at.work.T[b].transpose() * w;
}

using Change = std::function<void(const VectorXd& x, BodyNumbers& numbers)>;

Tried triedNumbers(const EffortResidual& data, std::size_t b, const Change& change, const VectorXd& steps) {
  Tried out;
  const BodyNumbers right = numbersOf(data.mechanism->bodies()[b]);
  const VectorXd before = data.each([&](const Instant& at) { return effortsWith(*data.mechanism, at, b, right); });
  out.change = [b, change, right, before](const EffortResidual& of, const VectorXd& x) -> VectorXd {
    BodyNumbers wrong = right;
    change(x, wrong);
    return of.each([&](const Instant& at) { return effortsWith(*of.mechanism, at, b, wrong); }) - before;
  };
  out.machine = [b, change](MechanismParameters& machine, const VectorXd& x) {
    MechanismBody& body = machine.bodies[b];
    BodyNumbers numbers = numbersOf(body);
    change(x, numbers);
    const Matrix3d& F = body.frame.linear();
    body.mass = numbers.mass;
    body.center_of_mass = body.frame * numbers.center;
    body.inertia = F * numbers.inertia * F.transpose();
  };
  out.steps = steps;
  out.named = {CauseKind::parameter, "", data.mechanism->bodies()[b].name};
  return out;
}

/// Whether a body can have the tensor: moments of mass along three axes are not negative, to the file's rounding.
bool isTensor(const Matrix3d& I) {
  const Vector3d moments = Eigen::SelfAdjointEigenSolver<Matrix3d>(I).eigenvalues();
  return moments(0) + moments(1) - moments(2) >= -1e-3 * moments.cwiseAbs().maxCoeff();
}

Tried oneNumber(const EffortResidual& data, std::size_t b, const std::string& key, const char* unit, double expected,
                double step, const Change& change) {
  Tried out = triedNumbers(data, b, change, VectorXd::Constant(1, step));
  out.named.parameter = fmt::format("body.{}.{}", out.named.body, key);
  out.named.unit = unit;
  out.named.expected = expected;
  const BodyNumbers right = numbersOf(data.mechanism->bodies()[b]);
  const bool is_mass = key == "mass", was_tensor = isTensor(right.inertia);
  out.finish = [=](const VectorXd& x, const VectorXd& uncertainty, NamedCause& named) {
    named.found = expected + x(0);
    named.uncertainty = uncertainty(0);
    if (is_mass) return *named.found >= -uncertainty(0);
    BodyNumbers wrong = right;
    change(x, wrong);
    return !was_tensor || isTensor(wrong.inertia);
  };
  return out;
}

void addOneByOne(const EffortResidual& data, std::size_t b, double length, std::vector<Tried>& out) {
  const MechanismBody& body = data.mechanism->bodies()[b];
  const BodyNumbers right = numbersOf(body);
  const double step = 1e-3 * length, away = body.center_of_mass.norm() + body.frame.translation().norm();
  out.push_back(oneNumber(data, b, "mass", "kg", right.mass, std::max(right.mass, 1e-3),
                          [](const VectorXd& x, BodyNumbers& numbers) { numbers.mass += x(0); }));
  for (int k = 0; k < 3; ++k)
    out.push_back(oneNumber(data, b, fmt::format("center_of_mass.{}", k), "m", asWritten(right.center(k), away), step,
                            [k](const VectorXd& x, BodyNumbers& numbers) { numbers.center(k) += x(0); }));
  const double size = std::max(right.inertia.norm(), 1e-6 * length * length);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      out.push_back(oneNumber(data, b, fmt::format("inertia.{}{}", "xyz"[i], "xyz"[j]), "kg m^2",
                              asWritten(right.inertia(i, j), right.inertia.norm()), size,
                              [i, j](const VectorXd& x, BodyNumbers& numbers) {
                                numbers.inertia(i, j) += x(0);
                                if (i != j) numbers.inertia(j, i) += x(0);
                              }));
}

void setSymmetric(const VectorXd& x, int first, Matrix3d& I) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      I(i, j) += x(first);
      if (i != j) I(j, i) += x(first);
      ++first;
    }
}

/// Several numbers at once, without their values. Where some make no difference, any body can have the others.
void addGroups(const EffortResidual& data, std::size_t b, double length, std::vector<Tried>& out) {
  const BodyNumbers right = numbersOf(data.mechanism->bodies()[b]);
  const double size = std::max(right.inertia.norm(), 1e-6 * length * length);
  const auto add = [&](const char* key, const Change& change, const VectorXd& steps) {
    Tried tried = triedNumbers(data, b, change, steps);
    tried.named.parameter = fmt::format("body.{}", tried.named.body) + key;
    out.push_back(tried);
  };
  add(
      ".center_of_mass", [](const VectorXd& x, BodyNumbers& numbers) { numbers.center += x; },
      VectorXd::Constant(3, 1e-3 * length));
  add(
      ".inertia", [](const VectorXd& x, BodyNumbers& numbers) { setSymmetric(x, 0, numbers.inertia); },
      VectorXd::Constant(6, size));
}

/// Mass and inertia by one factor, as of another density.
void addDensity(const EffortResidual& data, std::size_t b, std::vector<Tried>& out) {
  const auto change = [](const VectorXd& x, BodyNumbers& numbers) {
    numbers.mass *= 1 + x(0);
    numbers.inertia *= 1 + x(0);
  };
  Tried tried = triedNumbers(data, b, change, VectorXd::Ones(1));
  tried.named.kind = CauseKind::scale;
  tried.named.term = "inertia";
  tried.named.expected = 1;
  tried.detail = "mass and inertia";
  tried.finish = [](const VectorXd& x, const VectorXd& uncertainty, NamedCause& named) {
    named.found = 1 + x(0);
    named.uncertainty = uncertainty(0);
    return *named.found > 0;
  };
  out.push_back(tried);
}

/// The mass centre at the body's own origin.
void addNoCenter(const EffortResidual& data, std::size_t b, std::vector<Tried>& out) {
  const Tried tried = triedNumbers(
      data, b, [](const VectorXd&, BodyNumbers& numbers) { numbers.center.setZero(); }, VectorXd());
  addFixed(out, {CauseKind::reference_point, "", tried.named.body}, tried.change(data, VectorXd()),
           "the mass centre at the body's origin");
  out.back().machine = tried.machine;
}

void addGravity(const EffortResidual& data, std::vector<Tried>& out) {
  const Mechanism& mechanism = *data.mechanism;
  const Vector3d right = mechanism.gravity();
  MatrixXd columns(data.noc.size(), 3);
  for (int k = 0; k < 3; ++k)
    columns.col(k) = data.each([&](const Instant& at) -> VectorXd {
      VectorXd sum = VectorXd::Zero(data.motors);
      for (std::size_t b = 0; b < mechanism.bodies().size(); ++b)
        if (!mechanism.bodies()[b].weightless) sum -= mechanism.bodies()[b].mass * at.work.T[b].row(3 + k).transpose();
      return sum;
    });
  const auto add = [&](const std::string& key, const MatrixXd& ways, double expected) {
    const MatrixXd of = columns * ways;
    Tried tried{{CauseKind::parameter, "gravity", "all", key, "m/s^2", expected},
                [of](const EffortResidual&, const VectorXd& x) { return VectorXd(of * x); },
                VectorXd::Ones(of.cols())};
    tried.machine = [ways](MechanismParameters& machine, const VectorXd& x) { machine.gravity += ways * x; };
    if (of.cols() > 1) tried.named.expected.reset();
    tried.finish = [expected](const VectorXd& x, const VectorXd& uncertainty, NamedCause& named) {
      if (x.size() > 1) return true;
      named.found = expected + x(0);
      named.uncertainty = uncertainty(0);
      return true;
    };
    out.push_back(tried);
  };
  Eigen::Index down = 0;
  const bool is_along_axis = right.norm() > 0 && right.cwiseAbs().maxCoeff(&down) > 0.999999 * right.norm();
  if (is_along_axis) add(fmt::format("gravity.{}", down), Vector3d::Unit(down), right(down));
  if (right.norm() > 0 && !is_along_axis) add("gravity", right.normalized(), right.norm());
  for (Eigen::Index k = 0; k < 3; ++k)
    if (!is_along_axis || k != down) add(fmt::format("gravity.{}", k), Vector3d::Unit(k), right(k));
  add("gravity", Matrix3d::Identity(), 0);
}

}  // namespace

double asWritten(double value, double size) {
  constexpr int digits = 12, most_places = 22;  // ten to the power of 22 is a double
  constexpr double roundings = 64;
  if (!(size > 0)) return value;
  const double unit = std::pow(10.0, std::min(digits - static_cast<int>(std::ceil(std::log10(size))), most_places));
  const double near = std::round(value * unit) / unit;
  return std::abs(near - value) <= roundings * rounding * size ? near + 0.0 : value;
}

VectorXd effortsOf(const Mechanism& mechanism, const Instant& at) {
  const VectorXd loads = loadsOf(mechanism, at);
  VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(mechanism.motorCount()));
  for (std::size_t b = 0; b < mechanism.bodies().size(); ++b)
    out += effortsWith(mechanism, at, b, numbersOf(mechanism.bodies()[b]));
  for (std::size_t c = 0; c < at.coordinates.size(); ++c)
    out += at.coordinates[c].row.transpose() * loads(static_cast<Eigen::Index>(c));
  return out;
}

void addBodyNumbers(const EffortResidual& data, std::vector<Tried>& out) {
  const Mechanism& mechanism = *data.mechanism;
  for (std::size_t b = 0; b < mechanism.bodies().size(); ++b) {
    if (mechanism.bodies()[b].fixed || data.instants.front().work.T[b].isZero(0)) continue;
    addOneByOne(data, b, mechanism.length(), out);
    addGroups(data, b, mechanism.length(), out);
    if (mechanism.bodies()[b].mass == 0) continue;
    addDensity(data, b, out);
    addNoCenter(data, b, out);
  }
  addGravity(data, out);
}

}  // namespace ursula::mechanisms
