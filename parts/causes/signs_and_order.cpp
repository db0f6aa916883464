#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "parts/causes/fits.h"

namespace ursula {
namespace {

using Order = std::vector<std::size_t>;  ///< entry i is the leg, 0-based, whose torques column i contains
constexpr std::size_t columns = motor_count;

/// "leg 3", "legs 1, 2 and 5", of the motors.
std::string namesOf(const TorqueResidual& data, const std::vector<int>& motors) {
  std::string out = fmt::format("{}{} ", data.motors.kind(), motors.size() == 1 ? "" : "s");
  for (std::size_t k = 0; k < motors.size(); ++k)
    out += fmt::format("{}{}", k == 0 ? "" : k + 1 == motors.size() ? " and " : ", ", motors[k] + 1);
  return out;
}

/// "legs 2 and 5 swapped", "legs 1, 2 and 3 permuted".
std::string permutationText(const TorqueResidual& data, const Order& from) {
  const char* each = data.motors.kind();
  std::vector<int> moved;
  std::string detail;
  bool is_turned = true, is_mirrored = true;  // legs after a rotation or a reversal of the numbering
  for (std::size_t i = 0; i < columns; ++i) {
    is_turned = is_turned && (i + from[0]) % columns == from[i];
    is_mirrored = is_mirrored && (from[0] + columns - i) % columns == from[i];
    if (from[i] == i) continue;
    moved.push_back(static_cast<int>(i));
    detail += fmt::format("{}column {} holds {} {}", detail.empty() ? "" : ", ", i + 1, each, from[i] + 1);
  }
  if (moved.empty()) return "";
  if (moved.size() == 2) return namesOf(data, moved) + " swapped";
  if (is_turned) return fmt::format("{}s numbered from another one: {}", each, detail);
  if (is_mirrored) return fmt::format("{}s numbered the other way round (mirrored): {}", each, detail);
  return fmt::format("{} permuted ({})", namesOf(data, moved), detail);
}

std::string signText(const TorqueResidual& data, const std::vector<int>& flipped) {
  if (flipped.size() < columns) return "the sign of " + namesOf(data, flipped) + " flipped";
  if (data.motors.allSlide()) return "the sign of every force flipped (positive against d)";
  return data.motors.one_a_leg ? "the sign of every leg flipped (torques about +u, not conjugate to phi)"
                               : "the sign of every motor flipped";
}

/// The unit that the sizes suggest for any order of the legs; 1 if they suggest none.
double unitFactor(const TorqueResidual& data) {
  double found = 0, exact = 0;
  for (std::size_t k = 0; k < data.exact.size(); ++k) {
    found += data.found(k).squaredNorm();
    exact += data.exact[k].squaredNorm();
  }
  const double factor = exact > 0 ? std::sqrt(found / exact) : 1;
  return unitOf(factor, data.motors).empty() ? 1 : factor;
}

/// One motor in each row.
Eigen::MatrixXd rowsOf(const std::vector<Vector6d>& all) {
  Eigen::MatrixXd out(motor_count, static_cast<Eigen::Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) out.col(static_cast<Eigen::Index>(k)) = all[k];
  return out;
}

}  // namespace

MotorPairs::MotorPairs(const Eigen::MatrixXd& found, const Eigen::MatrixXd& right)
    : sign(found.rows(), found.rows()), cost(found.rows(), found.rows()) {
  for (Eigen::Index i = 0; i < found.rows(); ++i)
    for (Eigen::Index j = 0; j < found.rows(); ++j) {
      double plus = 0, minus = 0;
      for (Eigen::Index k = 0; k < found.cols(); ++k) {
        const double less = found(i, k) - right(j, k), more = found(i, k) + right(j, k);
        plus += less * less, minus += more * more;
      }
      sign(i, j) = plus <= minus ? 1 : -1;
      cost(i, j) = std::min(plus, minus);
    }
}

Order MotorPairs::best(double& least) const {
  constexpr Eigen::Index most = 7;
  Order from(static_cast<std::size_t>(cost.rows())), out;
  std::iota(from.begin(), from.end(), std::size_t{0});
  least = HUGE_VAL;
  if (cost.rows() > most) {
    for (Eigen::Index i = 0; i < cost.rows(); ++i) {
      Eigen::Index nearest = 0;
      cost.row(i).minCoeff(&nearest);
      out.push_back(static_cast<std::size_t>(nearest));
    }
    return std::is_permutation(out.begin(), out.end(), from.begin()) ? out : from;
  }
  do {
    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
      sum += cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(from[i]));
    if (sum < least) out = from, least = sum;
  } while (std::next_permutation(from.begin(), from.end()));
  return out;
}

void nameMotors(const std::vector<int>& motors, NamedCause& cause) {
  if (motors.size() == 1) cause.motor = motors.front() + 1;
  if (motors.size() == motor_count) cause.body = "all";
  if (motors.size() > 1 && motors.size() < motor_count)
    for (const int motor : motors) cause.legs.push_back(motor + 1);
}

std::optional<Hypothesis> signsAndOrder(const TorqueResidual& data) {
  const double unit = unitFactor(data);
  std::vector<Vector6d> found;
  for (std::size_t k = 0; k < data.exact.size(); ++k) found.push_back(data.found(k));
  const MotorPairs pairs(rowsOf(found), unit * rowsOf(data.exact));
  double least = 0;
  const Order best = pairs.best(least);
  std::vector<int> flipped;
  for (std::size_t i = 0; i < columns; ++i)
    if (pairs.signAt(i, best[i]) < 0) flipped.push_back(static_cast<int>(i));
  std::string text = permutationText(data, best);
  const bool is_order = !text.empty();
  if (!is_order && flipped.empty()) return std::nullopt;  // a unit alone belongs to the scale hypothesis
  if (!flipped.empty()) text += (is_order ? ", and " : "") + signText(data, flipped);
  if (unit != 1) text += fmt::format(", and {}", unitOf(unit, data.motors));
  std::vector<Vector6d> left(data.exact.size());
  for (std::size_t k = 0; k < left.size(); ++k)
    for (std::size_t i = 0; i < columns; ++i)
      left[k](i) = data.found(k)(i) - unit * pairs.signAt(i, best[i]) * data.exact[k](best[i]);
  Hypothesis out{text, std::sqrt(least) / data.norm(), 0};
  out.beyond = data.beyond(left) / std::max(1.0, unit);  // rounding grows with the torques
  out.named = NamedCause{is_order ? CauseKind::order : CauseKind::sign};
  if (is_order)
    for (const std::size_t leg : best) out.named->legs.push_back(static_cast<int>(leg) + 1);
  else
    nameMotors(flipped, *out.named);
  if (is_order && !flipped.empty())
    for (std::size_t i = 0; i < columns; ++i) out.named->signs.push_back(pairs.signAt(i, best[i]) < 0 ? -1 : 1);
  return out;
}

}  // namespace ursula
