#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/real50.h"
#include "validation/checks/quintic_by_control_points.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

constexpr double epsilon = Eigen::NumTraits<double>::epsilon();

Vector6d stacked(const Wrench<double>& wrench) { return (Vector6d() << wrench.force, wrench.moment).finished(); }

/// One component of the table between two rows.
///
/// Rounding: the double evaluation adds powers of s = (t − t₀)/h whose coefficients are y₀, v₀, 10 r − 6 v₀ − 4 v₁, −15
/// r + 8 v₀ + 7 v₁ and 6 r − 3 (v₀ + v₁), with the rise r and v = h times a slope. Each coefficient is rounded once and
/// suffers at most 10 roundings in Horner's rule. s, off by three roundings, enters five times. Together 26 roundings
/// of eps/2 stay within 25 eps.
struct Segment {
  Real50 h;
  double rise = 0;
  QuinticEnd from, to;

  Real50 at(const Real50& s) const { return atControlPoints(controlPoints(from, to, h), s); }
  double limit(double s) const {
    const double size = std::abs(rise), y_0 = std::abs(static_cast<double>(from.value)),
                 v_0 = std::abs(static_cast<double>(h * from.rate)), v_1 = std::abs(static_cast<double>(h * to.rate));
    const double cubic = 10 * size + 6 * v_0 + 4 * v_1, quartic = 15 * size + 8 * v_0 + 7 * v_1,
                 quintic = 6 * size + 3 * (v_0 + v_1);
    return rounding_depth * epsilon * (y_0 + s * (v_0 + s * s * (cubic + s * (quartic + s * quintic))));
  }
};

class Table {
 public:
  explicit Table(const std::vector<TimedWrench>& rows) : rows_(rows) {}

  Segment segment(std::size_t i, int k) const {
    Segment out;
    out.h = width(i);
    out.from = {value(i, k), slope(i, k), 0};
    out.to = {value(i + 1, k), slope(i + 1, k), 0};
    out.rise = static_cast<double>(out.to.value - out.from.value);
    return out;
  }
  double value(std::size_t i, int k) const { return stacked(rows_[i].wrench)(k); }

 private:
  Real50 width(std::size_t i) const { return Real50(rows_[i + 1].time) - rows_[i].time; }
  Real50 chord(std::size_t i, int k) const { return (Real50(value(i + 1, k)) - value(i, k)) / width(i); }
  /// The harmonic mean of both sides' chords if they have the same sign; zero at extrema and at both ends.
  Real50 slope(std::size_t i, int k) const {
    if (i == 0 || i + 1 == rows_.size()) return 0;
    const Real50 left = chord(i - 1, k), right = chord(i, k);
    if (left == 0 || right == 0 || (left < 0) != (right < 0)) return 0;
    return 2 / (1 / left + 1 / right);
  }

  const std::vector<TimedWrench>& rows_;
};

const char* componentName(int k) {
  constexpr std::array<const char*, 6> names{"f_x", "f_y", "f_z", "m_x", "m_y", "m_z"};
  return k < 0 ? "no component" : names[k];
}

void compareRows(const std::vector<TimedWrench>& rows, const std::function<Wrench<double>(double)>& at,
                 WorstShare& shown) {
  const auto compare = [&](double t, const TimedWrench& row) {
    shown.addEach(stacked(at(t)) - stacked(row.wrench), Vector6d::Zero(), t);
  };
  for (const TimedWrench& row : rows) compare(row.time, row);
  const double beyond = rows.back().time - rows.front().time;
  compare(rows.front().time - beyond, rows.front());
  compare(rows.back().time + beyond, rows.back());
}

/// At one instant within segment i, compares with the other evaluation and with the range of both rows.
void compareWithin(const Table& table, std::size_t i, double s, double t, const Vector6d& found, WorstShare& shown) {
  for (int k = 0; k < 6; ++k) {
    const Segment segment = table.segment(i, k);
    const double a = table.value(i, k), b = table.value(i + 1, k), limit = segment.limit(s);
    // t is rounded, so s belongs to the rounded t.
    shown.add(std::abs(static_cast<double>(Real50(found(k)) - segment.at(s))), limit, t, k);
    shown.add(std::max({0.0, std::min(a, b) - found(k), found(k) - std::max(a, b)}), limit, t, k);
  }
}

Check judgedAs(const WorstShare& shown, const std::string& basis, const std::string& what) {
  Check check = judged("motion.load", shown.value, shown.limit, "N, N m", basis,
                       fmt::format("{}; shown for t = {:.6g} s, {}", what, shown.t, componentName(shown.where)));
  check.largest = {shown.largest, shown.largest_t, componentName(shown.largest_where)};
  return check;
}

}  // namespace

Check judgeLoadTable(const std::vector<TimedWrench>& rows, const std::function<Wrench<double>(double)>& at) {
  if (rows.size() < 2) return notMade("motion.load", "N, N m", "a table of fewer than two rows");
  WorstShare shown;
  compareRows(rows, at, shown);
  const Table table(rows);
  constexpr std::size_t most_segments = 40;  // of thousands, because 50 digits are expensive
  const std::size_t every = (rows.size() + most_segments - 1) / most_segments;
  for (std::size_t i = 0; i + 1 < rows.size(); i += every)
    for (const double share : {0.07, 0.31, 0.5, 0.88}) {
      const double from = rows[i].time, to = rows[i + 1].time, t = from + share * (to - from);
      if (!(t > from && t < to)) continue;  // the rows are adjacent doubles
      const double s = static_cast<double>((Real50(t) - from) / (Real50(to) - from));
      compareWithin(table, i, s, t, stacked(at(t)), shown);
    }
  return judgedAs(
      shown, "0 at the rows and beyond; between them, 25 eps x the sum of the terms in powers of (t - t_0)/h",
      fmt::format("the load must meet its {} rows, be constant beyond them, and between them be the quintic "
                  "with harmonic-mean slopes within both rows' range",
                  rows.size()));
}

Check judgeLoad(const Load& load, double duration) {
  if (load.history) return judgeLoadTable(load.history->rows(), [&](double t) { return load.at(t); });
  const Vector6d constant = stacked({load.force, load.moment});
  WorstShare shown;
  for (const double t : {0.0, 0.3 * duration, duration})
    shown.addEach(stacked(load.at(t)) - constant, Vector6d::Zero(), t);
  return judgedAs(shown, "the load is constant: nothing is rounded",
                  "the load against the force and moment given, at 3 instants");
}

}  // namespace ursula
