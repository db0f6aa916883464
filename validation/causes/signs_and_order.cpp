#include "validation/causes/fits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ursula {
namespace {

using Table = double[motor_count][motor_count];

/// ‖τᵢ ∓ τⱼ‖² for leg i of `torques` and leg j of `exact`.
double mismatch(const TorqueResidual& data, int i, int j, double factor) {
  double sum = 0;
  for (std::size_t k = 0; k < data.exact.size(); ++k) {
    const double left = data.found(k)(i) - factor * data.exact[k](j);
    sum += left * left;
  }
  return sum;
}

std::string legNames(const std::vector<int>& legs) {
  std::string out;
  for (std::size_t k = 0; k < legs.size(); ++k)
    out += fmt::format("{}{}", k == 0 ? "" : k + 1 == legs.size() ? " and " : ", ", legs[k] + 1);
  return out;
}

/// The word for what a column belongs to.
const char* each(const TorqueResidual& data) { return data.motors.kind(); }

std::string plural(const TorqueResidual& data, const std::vector<int>& of) {
  return fmt::format("{}{} ", each(data), of.size() == 1 ? "" : "s");
}

/// "legs 2 and 5 swapped", "legs 1, 2 and 3 permuted".
std::string permutationText(const TorqueResidual& data, const std::vector<int>& from) {
  std::vector<int> moved;
  std::string detail;
  for (int i = 0; i < motor_count; ++i)
    if (from[static_cast<std::size_t>(i)] != i) {
      moved.push_back(i);
      detail += fmt::format("{}column {} holds {} {}", detail.empty() ? "" : ", ", i + 1, each(data),
                            from[static_cast<std::size_t>(i)] + 1);
    }
  if (moved.empty()) return "";
  if (moved.size() == 2) return plural(data, moved) + legNames(moved) + " swapped";
  int turned = 0, mirrored = 0;  // legs after a rotation or a reversal of the numbering
  for (int i = 0; i < motor_count; ++i) {
    turned += (i + from[0]) % motor_count == from[static_cast<std::size_t>(i)] ? 1 : 0;
    mirrored += (from[0] + motor_count - i) % motor_count == from[static_cast<std::size_t>(i)] ? 1 : 0;
  }
  if (turned == motor_count) return fmt::format("{}s numbered from another one: {}", each(data), detail);
  if (mirrored == motor_count)
    return fmt::format("{}s numbered the other way round (mirrored): {}", each(data), detail);
  return fmt::format("{}s {} permuted ({})", each(data), legNames(moved), detail);
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

/// The order with the least cost: entry i is the leg whose torques column i contains.
std::vector<int> bestOrder(const Table& cost, double& least) {
  std::vector<int> from(motor_count), best;
  std::iota(from.begin(), from.end(), 0);
  least = 0;
  do {
    double sum = 0;
    for (int i = 0; i < motor_count; ++i) sum += cost[i][from[static_cast<std::size_t>(i)]];
    if (best.empty() || sum < least) best = from, least = sum;
  } while (std::next_permutation(from.begin(), from.end()));
  return best;
}

/// The remainder in multiples of the limits.
double beyondOf(const TorqueResidual& data, const std::vector<int>& from, const Table& sign, double unit) {
  std::vector<Vector6d> left(data.exact.size());
  for (std::size_t k = 0; k < left.size(); ++k)
    for (int i = 0; i < motor_count; ++i) {
      const int j = from[static_cast<std::size_t>(i)];
      left[k](i) = data.found(k)(i) - unit * sign[i][j] * data.exact[k](j);
    }
  return data.beyond(left);
}

NamedCause namedOrder(const std::vector<int>& from, const std::vector<int>& flipped) {
  NamedCause out{std::is_sorted(from.begin(), from.end()) ? CauseKind::sign : CauseKind::order, "", ""};
  if (out.kind == CauseKind::order) {
    for (const int leg : from) out.legs.push_back(leg + 1);
    return out;
  }
  nameMotors(flipped, out);
  return out;
}

}  // namespace

void nameMotors(const std::vector<int>& motors, NamedCause& cause) {
  if (motors.size() == 1) cause.motor = motors.front() + 1;
  if (motors.size() == motor_count) cause.body = "all";
  if (motors.size() > 1 && motors.size() < motor_count)
    for (const int motor : motors) cause.legs.push_back(motor + 1);
}

std::optional<Hypothesis> signsAndOrder(const TorqueResidual& data) {
  const double unit = unitFactor(data);
  Table cost, sign;
  for (int i = 0; i < motor_count; ++i)
    for (int j = 0; j < motor_count; ++j) {
      const double plus = mismatch(data, i, j, unit), minus_cost = mismatch(data, i, j, -unit);
      sign[i][j] = plus <= minus_cost ? 1 : -1;
      cost[i][j] = std::min(plus, minus_cost);
    }
  double least = 0;
  const std::vector<int> best = bestOrder(cost, least);
  std::vector<int> flipped;
  for (int i = 0; i < motor_count; ++i)
    if (sign[i][best[static_cast<std::size_t>(i)]] < 0) flipped.push_back(i);
  std::string text = permutationText(data, best);
  if (text.empty() && flipped.empty()) return std::nullopt;  // a unit alone belongs to the scale hypothesis
  if (!flipped.empty()) text += text.empty() ? "" : ", and ";
  if (flipped.size() == motor_count)
    text += data.motors.allSlide()  ? "the sign of every force flipped (positive against d)"
            : data.motors.one_a_leg ? "the sign of every leg flipped (torques about +u, not conjugate to phi)"
                                    : "the sign of every motor flipped";
  else if (!flipped.empty())
    text += "the sign of " + plural(data, flipped) + legNames(flipped) + " flipped";
  if (unit != 1) text += fmt::format(", and {}", unitOf(unit, data.motors));
  Hypothesis out{text, std::sqrt(least) / data.norm(), 0};
  out.beyond = beyondOf(data, best, sign, unit) / std::max(1.0, unit);  // rounding grows with the torques
  out.named = namedOrder(best, flipped);
  return out;
}

}  // namespace ursula
