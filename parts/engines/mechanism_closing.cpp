#include "parts/engines/mechanism_closing.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/free_spins.h"

namespace ursula {
namespace {

/// With an error of 1e-9 before the last step, its square is below rounding after it.
constexpr double near_enough = 1e-9;

}  // namespace

Eigen::VectorXd SpeedsOfWelds::ownInverse(const Eigen::VectorXd&, bool) {
  throw std::domain_error("it has no inverse dynamics of closed loops");
}

void SpeedsOfWelds::startTime(const Rigidity&) { throw std::domain_error("it moves no loops in time"); }
Eigen::VectorXd SpeedsOfWelds::stepTime(const Eigen::VectorXd&) {
  throw std::domain_error("it moves no loops in time");
}

MechanismClosing::MechanismClosing(const Mechanism& mechanism, const WeldedMechanism& welded,
                                   const std::vector<std::size_t>& cut, SpeedsOfWelds& speeds)
    : mechanism_(mechanism), speeds_(speeds) {
  for (const std::size_t j : cut)
    for (const JointRow& row : rowsOf(mechanism, j, welded)) rows_.push_back(row);
  const auto& motors = mechanism.motors();
  for (const std::size_t j : motors) coordinates_.push_back(coordinatesOf(mechanism, j, welded).front());
  for (std::size_t j = 0; j < mechanism.joints().size(); ++j) {
    const MechanismJoint& joint = mechanism.joints()[j];
    if (!joint.isLoaded() || std::count(motors.begin(), motors.end(), j) > 0) continue;
    if (joint.stiffness != 0 && (joint.kind == JointKind::ball || joint.kind == JointKind::free))
      throw std::domain_error(fmt::format("no spring of a ball: {}", joint.name));
    for (const JointCoordinate& each : coordinatesOf(mechanism, j, welded)) coordinates_.push_back(each);
  }
  const double length = mechanism.length();
  row_scale_ = Eigen::VectorXd::Ones(rowCount() + motorCount());
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].kind == JointRow::Kind::point) row_scale_(static_cast<Eigen::Index>(i)) = length;
  for (Eigen::Index k = 0; k < motorCount(); ++k)
    if (mechanism.motor(k).slides()) row_scale_(rowCount() + k) = length;
  column_scale_ = Eigen::VectorXd::Ones(speeds.count());
  for (Eigen::Index i = 0; i < speeds.count(); ++i)
    if (speeds.isLinear(i)) column_scale_(i) = length;
  for (const JointCoordinate& each : coordinates_) near_.push_back(each.joint->position);
  if (!mechanism.start().empty()) goToStart(welded);
  close();
  holdSpins(welded);
}

void MechanismClosing::holdSpins(const WeldedMechanism& welded) {
  Eigen::MatrixXd Z = RankedFactors(allRows(motorCount())).kernel();
  const std::size_t joints = rows_.size();
  for (std::size_t w = 1; w < welded.welds.size() && Z.cols() > 0; ++w) {
    if (welded.welds[w].mass == 0 && welded.welds[w].inertia.isZero(0)) continue;
    Eigen::MatrixXd J(6, speeds_.count());
    for (int k = 0; k < 6; ++k) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(speeds_.count());
      speeds_.addRow(w, Vector6d::Unit(k) / (k < 3 ? 1 : mechanism_.length()), row);
      J.row(k) = row.cwiseProduct(column_scale_).transpose();
    }
    for (const Vector3d& line : takeSpins(J, Z)) {
      JointRow row;
      row.kind = JointRow::Kind::turn;
      row.b = w;
      row.along = speeds_.state(w).R.transpose() * line;
      row.is_on_b = true;
      rows_.push_back(row);
    }
  }
  // The motors' rows come last.
  const Eigen::VectorXd of_motors = row_scale_.tail(motorCount());
  row_scale_.conservativeResize(rowCount() + motorCount());
  row_scale_.segment(static_cast<Eigen::Index>(joints), rowCount() - static_cast<Eigen::Index>(joints)).setOnes();
  row_scale_.tail(motorCount()) = of_motors;
}

MechanismClosing::Form MechanismClosing::formOf(const JointRow& row, bool with_bias) const {
  const JointRowNow now = rowNow(row, speeds_.state(row.a), speeds_.state(row.b));
  Form out{Eigen::VectorXd::Zero(speeds_.count()), now.value, now.bias};
  speeds_.addRow(row.a, now.of_a, out.J);
  speeds_.addRow(row.b, now.of_b, out.J);
  if (with_bias) out.bias += now.of_a.dot(speeds_.bias(row.a)) + now.of_b.dot(speeds_.bias(row.b));
  return out;
}

MechanismClosing::Form MechanismClosing::formOf(std::size_t k, bool with_bias) const {
  const JointCoordinate& c = coordinates_[k];
  if (const auto own = speeds_.own(c.row.joint, c.index))
    return {own->sign * Eigen::VectorXd::Unit(speeds_.count(), own->speed), c.joint->position + own->value, 0};
  Form out = formOf(c.row, with_bias);
  if (c.joint->kind == JointKind::ball || c.joint->kind == JointKind::free) return out;
  out.value = near_[k] = valueOf(c, speeds_.state(c.row.a), speeds_.state(c.row.b), near_[k]);
  return out;
}

Eigen::MatrixXd MechanismClosing::allRows(Eigen::Index motors) const {
  Eigen::MatrixXd out(rowCount() + motors, speeds_.count());
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    const auto of_motor = static_cast<std::size_t>(std::max<Eigen::Index>(0, i - rowCount()));
    const Form form = i < rowCount() ? formOf(rows_[i], false) : formOf(of_motor, false);
    out.row(i) = form.J.cwiseProduct(column_scale_).transpose() / row_scale_(i);
  }
  return out;
}

Eigen::VectorXd MechanismClosing::motorValues() const {
  Eigen::VectorXd out(motorCount());
  for (Eigen::Index k = 0; k < out.size(); ++k) out(k) = formOf(k, false).value;
  return out;
}

Eigen::VectorXd MechanismClosing::errors(const Eigen::VectorXd* target) const {
  Eigen::VectorXd out(rowCount() + (target != nullptr ? target->size() : 0));
  for (Eigen::Index i = 0; i < rowCount(); ++i) {
    const JointRow& row = rows_[i];
    out(i) = rowNow(row, speeds_.state(row.a), speeds_.state(row.b)).value;
  }
  if (target != nullptr) out.tail(target->size()) = motorValues() - *target;
  return out.cwiseQuotient(row_scale_.head(out.size()));
}

const std::string& MechanismClosing::worstJoint() const {
  static const std::string none = "none";
  if (rows_.empty()) return none;
  Eigen::Index worst = 0;
  errors(nullptr).cwiseAbs().maxCoeff(&worst);
  return mechanism_.joints()[rows_[worst].joint].name;
}

bool MechanismClosing::newton(const Eigen::VectorXd& target) {
  constexpr double longest = 0.5, contraction = 0.25;
  double before = longest / contraction;
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd by = RankedFactors(allRows(motorCount())).solve(-errors(&target));
    const double size = by.norm();
    if (!(size <= contraction * before) && !(size <= near_enough)) return false;
    speeds_.step(column_scale_.cwiseProduct(by));
    before = size;
    if (size <= near_enough) return errors(&target).norm() <= near_enough;
  }
  return false;
}

void MechanismClosing::goToStart(const WeldedMechanism& welded) {
  constexpr int most = 100;
  const auto& start = mechanism_.start();
  std::vector<Eigen::Isometry3d> placed(welded.welds.size(), Eigen::Isometry3d::Identity());
  for (std::size_t b = 0; b < start.size(); ++b)
    if (welded.of_body[b] != 0) placed[welded.of_body[b]] = start[b];
  // Hinges and slides that are coordinates go there at once, the others by Newton's method on the welds' poses.
  Eigen::VectorXd by = Eigen::VectorXd::Zero(speeds_.count());
  for (std::size_t j = 0; j < mechanism_.joints().size(); ++j) {
    const MechanismJoint& joint = mechanism_.joints()[j];
    const auto own = freedomsOf(joint.kind) == 1 ? speeds_.own(j, 0) : std::nullopt;
    if (!own) continue;
    const Eigen::Isometry3d turn = placed[welded.parentOf(joint)].inverse() * placed[welded.childOf(joint)];
    const Vector3d &axis = joint.axis[0], across = axis.unitOrthogonal(), turned = turn.linear() * across;
    by(own->speed) = own->sign * (joint.slides() ? axis.dot(turn * joint.centre - joint.centre)
                                                 : std::atan2(axis.dot(across.cross(turned)), across.dot(turned)));
  }
  speeds_.step(by);
  for (int i = 0; i < most; ++i) {
    Eigen::MatrixXd rows(6 * (placed.size() - 1), speeds_.count());
    Eigen::VectorXd apart(rows.rows());
    for (std::size_t w = 1; w < placed.size(); ++w) {
      const WeldState& now = speeds_.state(w);
      const Eigen::AngleAxisd turn(Matrix3d(placed[w].linear() * now.R.transpose()));
      const auto first = static_cast<Eigen::Index>(6 * (w - 1));
      apart.segment<3>(first) = turn.angle() * turn.axis();
      apart.segment<3>(first + 3) =
          (placed[w] * welded.welds[w].center - welded.welds[0].center - now.c) / mechanism_.length();
      for (Eigen::Index k = 0; k < 6; ++k) {
        Eigen::VectorXd row = Eigen::VectorXd::Zero(speeds_.count());
        speeds_.addRow(w, Vector6d::Unit(k), row);
        rows.row(first + k) = row.cwiseProduct(column_scale_).transpose() / (k < 3 ? 1 : mechanism_.length());
      }
    }
    Eigen::VectorXd step = RankedFactors(rows).solve(apart);
    const double size = step.cwiseAbs().maxCoeff();
    if (!(size > near_enough)) return;
    if (size > 1) step /= size;
    speeds_.step(column_scale_.cwiseProduct(step));
  }
}

void MechanismClosing::close() {
  constexpr int most = 100;
  for (int i = 0; i < most && rowCount() > 0; ++i) {
    Eigen::VectorXd by = RankedFactors(allRows(0)).solve(-errors(nullptr));
    const double size = by.norm();
    if (size > 0.5) by *= 0.5 / size;
    speeds_.step(column_scale_.cwiseProduct(by));
    if (size <= near_enough && errors(nullptr).norm() <= near_enough) break;
    if (i + 1 == most)
      throw std::domain_error(fmt::format("the loop of joint {} cannot be closed near the file's pose", worstJoint()));
  }
  motorValues();
}

void MechanismClosing::moveTo(const MotorMotion& motion) {
  const Eigen::VectorXd start = motorValues();
  double share = 0, by = 1;
  while (share < 1) {
    const double next = std::min(1.0, share + by);
    speeds_.keep();
    near_kept_ = near_;
    if (newton(next == 1 ? motion.q : Eigen::VectorXd(start + next * (motion.q - start)))) {
      share = next;
      by *= 2;
      continue;
    }
    by /= 2;
    const std::string joint = by < 1e-6 ? worstJoint() : "";
    speeds_.goBack();
    near_ = near_kept_;
    if (by < 1e-6)
      throw std::domain_error(
          fmt::format("the loop of joint {} cannot follow the motors at t = {} s", joint, motion.t));
  }
}

void MechanismClosing::place(const MotorMotion& motion, Bias bias) {
  moveTo(motion);
  factors_ = std::make_unique<RankedFactors>(allRows(motorCount()));
  const auto solved = [&](Eigen::VectorXd right) -> Eigen::VectorXd {
    return column_scale_.cwiseProduct(factors_->solve(right.cwiseQuotient(row_scale_)));
  };
  Eigen::VectorXd right = Eigen::VectorXd::Zero(rowCount() + motorCount());
  right.tail(motorCount()) = motion.qdot;
  u_ = solved(right);
  speeds_.setSpeeds(u_);
  for (Eigen::Index i = 0; i < rowCount(); ++i) right(i) = bias == Bias::kept ? -formOf(rows_[i], true).bias : 0;
  for (Eigen::Index k = 0; k < motorCount(); ++k) right(rowCount() + k) = motion.qddot(k) - formOf(k, true).bias;
  u_dot_ = solved(right);
}

Eigen::VectorXd MechanismClosing::loads() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(speeds_.count());
  for (std::size_t k = 0; k < coordinates_.size(); ++k) {
    const MechanismJoint& joint = *coordinates_[k].joint;
    if (!joint.isLoaded()) continue;
    const Form form = formOf(k, true);
    const double rate = form.J.dot(u_);
    double force = -joint.damping * rate - joint.rotor_inertia * (form.J.dot(u_dot_) + form.bias);
    if (joint.friction != 0) force -= joint.friction * std::tanh(rate / joint.smoothing());
    if (joint.stiffness != 0) force -= joint.stiffness * (form.value - joint.spring_reference);
    out += force * form.J;
  }
  return out;
}

// [recipe]
// u = N q̇: S has the motors' rows, G those of the cut joints. Rows are divided and speeds multiplied by the machine's
// length where they are lengths, so that a pivoted QR factorisation tells redundant closures.
Eigen::MatrixXd MechanismClosing::complement() const {
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(rowCount() + motorCount(), motorCount());
  for (Eigen::Index k = 0; k < motorCount(); ++k) right(rowCount() + k, k) = 1 / row_scale_(rowCount() + k);
  return column_scale_.asDiagonal() * factors_->solve(right);
}

Eigen::VectorXd MechanismClosing::effortsByComplement(const Eigen::VectorXd& f) const {
  return complement().transpose() * f;
}
// [/recipe]

Eigen::VectorXd MechanismClosing::leastEfforts(const Eigen::VectorXd& f) const {
  const Eigen::MatrixXd N = complement();
  return (N.transpose() * N).llt().solve(N.transpose() * f);
}

Eigen::VectorXd MechanismClosing::atMotors(const Eigen::VectorXd& f) const {
  Eigen::VectorXd out(motorCount());
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    const JointCoordinate& c = coordinates_[k];
    const auto own = speeds_.own(c.row.joint, c.index);
    if (!own) throw std::domain_error(fmt::format("{} is no coordinate of its own", c.joint->name));
    out(k) = own->sign * f(own->speed);
  }
  return out;
}

void MechanismClosing::take(const Eigen::VectorXd& u) {
  u_ = u;
  u_dot_ = Eigen::VectorXd::Zero(u.size());
  motorValues();  // so that angles count their turns
}

Eigen::VectorXd MechanismClosing::onSpeeds(const Eigen::VectorXd& efforts) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(speeds_.count());
  for (Eigen::Index k = 0; k < efforts.size(); ++k) out += efforts(k) * formOf(k, false).J;
  return out;
}

double MechanismClosing::energyOfRotors() const {
  double out = 0;
  for (std::size_t k = 0; k < coordinates_.size(); ++k) {
    const double rate = formOf(k, false).J.dot(u_);
    out += coordinates_[k].joint->rotor_inertia * rate * rate / 2;
  }
  return out;
}

double MechanismClosing::gap() const {
  return rows_.empty() ? 0 : errors(nullptr).cwiseAbs().maxCoeff() * mechanism_.length();
}

Eigen::VectorXd MechanismClosing::effortsByMultipliers(const Eigen::VectorXd& f) const {
  return factors_->solveTransposed(column_scale_.cwiseProduct(f))
      .tail(motorCount())
      .cwiseQuotient(row_scale_.tail(motorCount()));
}

}  // namespace ursula
