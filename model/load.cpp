#include "model/load.h"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.h"
#include "base/quintic_spline.h"
#include "base/real50.h"

namespace ursula {
namespace {

using LoadKnot = CurvePoint<Real50, 6>;

/// Returns the harmonic mean of the slopes on both sides, 0 at an extremum (F. N. Fritsch and J. Butland, SIAM J. Sci.
/// Stat. Comput. 5 (1984) 300–304): at most twice the lesser. A quintic that rises by 1 over s in [0, 1] with end
/// slopes m₀, m₁ in [0, 2] and zero second derivatives there is monotone. Its slope is linear in m₀ and m₁. At that
/// square's corners it is 30 s²(1 − s)², 2 (1 − s)²(1 + 2s), its mirror image, and 2 − 30 s²(1 − s)² >= 1/8.
Real50 limitedSlope(const Real50& before, const Real50& after) {
  return before * after > 0 ? Real50(2 * before * after / (before + after)) : Real50(0);
}

void require(bool holds, std::size_t row, const char* key, const std::string& value, const std::string& bound) {
  if (!holds) throw InvalidParameter(fmt::format("load.table[{}].{}", row + 1, key), value, bound);
}

void validate(const std::vector<TimedWrench>& rows) {
  if (rows.size() < 2)
    throw InvalidParameter("load.table", fmt::format("{} row{}", rows.size(), rows.size() == 1 ? "" : "s"), ">= 2");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    require(std::isfinite(rows[i].time), i, "time", fmt::format("{}", rows[i].time), "a finite number");
    require(i == 0 || rows[i].time > rows[i - 1].time, i, "time", fmt::format("{}", rows[i].time),
            i == 0 ? "" : fmt::format("> {}, the time before", rows[i - 1].time));
    require(rows[i].wrench.force.allFinite(), i, "force", "a non-finite entry", "finite numbers");
    require(rows[i].wrench.moment.allFinite(), i, "moment", "a non-finite entry", "finite numbers");
  }
}

QuinticHermite<Real50, 6> curveThrough(const std::vector<TimedWrench>& rows) {
  std::vector<LoadKnot> knots(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    knots[i].t = rows[i].time;
    knots[i].value << rows[i].wrench.force.cast<Real50>(), rows[i].wrench.moment.cast<Real50>();
  }
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
    const LoadKnot::Vector before = (knots[i].value - knots[i - 1].value) / (knots[i].t - knots[i - 1].t);
    const LoadKnot::Vector after = (knots[i + 1].value - knots[i].value) / (knots[i + 1].t - knots[i].t);
    for (int k = 0; k < 6; ++k) knots[i].rate(k) = limitedSlope(before(k), after(k));
  }
  return QuinticHermite<Real50, 6>(knots);
}

}  // namespace

struct LoadHistory::Curves {
  QuinticHermite<Real50, 6> exact;
  QuinticHermite<double, 6> rounded;
  std::vector<TimedWrench> rows;
  std::vector<double> knots;
};

namespace {

template <class S>
Wrench<S> widened(const Wrench<double>& wrench) {
  return {wrench.force.cast<S>(), wrench.moment.cast<S>()};
}

/// Beyond the ends it returns the end rows exactly.
template <class S>
Wrench<S> wrenchAt(const QuinticHermite<S, 6>& curve, const TimedWrench& first, const TimedWrench& last, const S& t) {
  if (t <= S(first.time)) return widened<S>(first.wrench);
  if (t >= S(last.time)) return widened<S>(last.wrench);
  const auto value = curve.at(t).value;
  return {value.template head<3>(), value.template tail<3>()};
}

}  // namespace

LoadHistory::LoadHistory(const std::vector<TimedWrench>& rows) {
  validate(rows);
  const QuinticHermite<Real50, 6> curve = curveThrough(rows);
  std::vector<double> knots;
  knots.reserve(rows.size());
  for (const TimedWrench& row : rows) knots.push_back(row.time);
  curves_ = std::make_unique<Curves>(Curves{curve, QuinticHermite<double, 6>(curve), rows, std::move(knots)});
}

LoadHistory::LoadHistory(const LoadHistory& from, const Matrix6d& map, double time_unit) {
  const auto curve = from.curves_->exact.mapped(map.cast<Real50>(), Real50(time_unit));
  std::vector<TimedWrench> rows = from.curves_->rows;
  std::vector<double> knots;
  for (TimedWrench& row : rows) {
    Vector6d wrench;
    wrench << row.wrench.force, row.wrench.moment;
    wrench = (map * wrench).eval();
    row = {row.time / time_unit, {wrench.head<3>(), wrench.tail<3>()}};
    knots.push_back(row.time);
  }
  curves_ =
      std::make_unique<Curves>(Curves{curve, QuinticHermite<double, 6>(curve), std::move(rows), std::move(knots)});
}

const std::vector<TimedWrench>& LoadHistory::rows() const { return curves_->rows; }

const std::vector<double>& LoadHistory::knots() const { return curves_->knots; }

LoadHistory::~LoadHistory() = default;

Wrench<double> LoadHistory::at(double t) const {
  return wrenchAt(curves_->rounded, curves_->rows.front(), curves_->rows.back(), t);
}

template <class S, class>
Wrench<S> LoadHistory::at(const S& t) const {
  return wrenchAt(curves_->exact, curves_->rows.front(), curves_->rows.back(), t);
}

Wrench<double> Load::at(double t) const { return history ? history->at(t) : Wrench<double>{force, moment}; }

template <class S, class>
Wrench<S> Load::at(const S& t) const {
  return history ? history->at(t) : widened<S>({force, moment});
}

template Wrench<Real50> LoadHistory::at(const Real50& t) const;
template Wrench<Real50> Load::at(const Real50& t) const;

}  // namespace ursula
