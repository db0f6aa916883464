#include "validation/outside/motion_windows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/scalar.h"
#include "validation/verdict/result.h"

namespace ursula {
namespace {

/// Windows in a motion, and the fewest rows in one.
constexpr int windows = 20, rows_in_window = 8;
/// What is left open by rows is known for the scenario's motion and for fewer rows; all of them may leave up to as many
/// times of it.
constexpr double other_motion = 4;
/// A window is decided if its rows leave no more open than the user allows, or than this share of the largest effort: a
/// mass that is wrong by a percent changes efforts by more.
constexpr double telling = 1e-3;
/// Errors of a smooth motion shrink at least with the fourth power of the rows' distance, those of a kink in a smooth
/// mean with the third at most.
constexpr double order_of_smooth = 4, smooth = 16, of_kink = 8;

/// The windows of one motion.
struct Windows {
  double half = 0;
  std::vector<double> centres;
};

/// Means of the given efforts less those needed by a motion.
EffortList meansOff(const EffortRows& rows, const EffortsAt& needed, const Windows& in) {
  EffortList off = rows.efforts, out;
  for (std::size_t k = 0; k < rows.t.size(); ++k) off[k] -= needed(rows.t[k]);
  const WindowMeans means(rows.t, in.half);
  for (const double centre : in.centres) out.emplace_back(means.at(centre, off));
  return out;
}

/// The same by some of the rows; empty if the loops cannot follow these.
EffortList meansOff(const MotionAsked& asked, const SomeRows& some, const Windows& in) {
  const bool keeps = asked.given.at_any_instant;
  try {
    if (keeps) return meansOff(asked.given, asked.needed(some), in);
    return meansOff({some.of(asked.given.t), some.of(asked.given.efforts)}, asked.needed(some), in);
  } catch (const LoopError&) {
  } catch (const InvalidParameter&) {  // too few rows
  }
  return {};
}

/// The largest values around each.
EffortList mostAround(const EffortList& values) {
  const std::size_t reach = 1 + values.size() / windows;
  EffortList out;
  for (std::size_t k = 0; k < values.size(); ++k) {
    Eigen::VectorXd most = values[k].cwiseAbs();
    for (std::size_t j = k > reach ? k - reach : 0; j <= std::min(k + reach, values.size() - 1); ++j)
      most = most.cwiseMax(values[j].cwiseAbs()).eval();
    out.push_back(std::move(most));
  }
  return out;
}

/// Largest differences around each; those to zero where a window of `b` has no row.
EffortList differences(const EffortList& a, const EffortList& b) {
  EffortList out;
  for (std::size_t k = 0; k < a.size(); ++k) out.push_back(b[k].allFinite() ? Eigen::VectorXd(a[k] - b[k]) : a[k]);
  return mostAround(out);
}

EffortList largerOf(EffortList a, const EffortList& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = a[k].cwiseMax(b[k]).eval();
  return a;
}

/// What the rows' distance leaves open, and how quickly that falls with it.
struct LeftBetween {
  EffortList error;
  std::vector<double> order;  ///< one at least, as kinks are
};

/// Every second row changes the means by d₂, every fourth by d₄ more, every eighth by d₈. Where these shrink twice as a
/// smooth motion's do, d₂²/d₄ is left. A kink, as friction and steps of efforts make them, lies between rows at random,
/// so that a difference may be small by chance: both halves of the rows are left out, and no less than d₄/8 is left.
/// All of the efforts are open if the loops cannot follow every second row.
LeftBetween leftBetween(const MotionAsked& asked, const Windows& in, const EffortList& of_all) {
  const EffortList second = meansOff(asked, {2, 0}, in), other = meansOff(asked, {2, 1}, in);
  LeftBetween out{{}, std::vector<double>(in.centres.size(), 1)};
  if (second.empty() || other.empty()) {
    Eigen::VectorXd most = asked.given.efforts.front().cwiseAbs();
    for (const Eigen::VectorXd& each : asked.given.efforts) most = most.cwiseMax(each.cwiseAbs()).eval();
    out.error = EffortList(in.centres.size(), most);
    return out;
  }
  out.error = largerOf(differences(of_all, second), differences(of_all, other));
  const EffortList fourth = meansOff(asked, {4, 0}, in), eighth = meansOff(asked, {8, 0}, in);
  if (fourth.empty()) return out;
  const EffortList before = largerOf(differences(second, fourth), differences(other, fourth));
  const EffortList first = eighth.empty() ? EffortList() : differences(fourth, eighth);
  for (std::size_t k = 0; k < before.size(); ++k) {
    bool shrinks = true;
    for (Eigen::Index i = 0; i < before[k].size(); ++i) {
      const double d2 = out.error[k](i), d4 = before[k](i);
      const bool once = smooth * d2 < d4, twice = once && !eighth.empty() && smooth * d4 < first[k](i);
      out.error[k](i) = twice ? d2 * d2 / d4 : std::max(d2, d4 / of_kink);
      shrinks = shrinks && once;
    }
    if (shrinks) out.order[k] = order_of_smooth;
  }
  return out;
}

/// The distance of rows at which half of the windows leave `wanted` open, by what they leave now.
double enoughFor(const std::vector<double>& shares, const std::vector<double>& order, double distance) {
  std::vector<double> enough;
  for (std::size_t k = 0; k < shares.size(); ++k)
    enough.push_back(distance / std::pow(std::max(shares[k], 1.0), 1 / order[k]));
  std::nth_element(enough.begin(), enough.begin() + static_cast<std::ptrdiff_t>(enough.size() / 2), enough.end());
  return enough[enough.size() / 2];
}

/// Where the rows leave more open than is wanted, only the part of a difference remains that they do not explain.
void decide(const MotionAsked& asked, const EffortList& needed, const std::vector<double>& order, MotionWindows& out) {
  double largest = 0;
  for (const Eigen::VectorXd& each : needed)
    largest = larger(largest, each.cwiseProduct(asked.in).cwiseAbs().maxCoeff());
  const auto& user = asked.tolerance;
  const double allowed = user ? user->relative * largest + user->absolute : 0;
  const double most = user ? allowed : telling * largest;
  out.wanted = user ? "what the tolerance allows" : fmt::format("{:g} of the largest", telling);
  std::vector<double> shares;
  for (std::size_t k = 0; k < out.t.size(); ++k) {
    double share = 0;
    bool is_open = false;
    for (Eigen::Index i = 0; i < needed[k].size(); ++i) {
      const double in = asked.in(i), left = out.precision[k](i) * in;
      const double off = out.efforts[k](i) - needed[k](i), size = std::abs(off) * in;
      // No integrator is exact, and its error is unknown: what would not matter anywhere is no mistake here either.
      if (!user) out.precision[k](i) += useful_share * largest / in;
      share = larger(share, most > 0 ? left / most : 0);
      if (left <= most && !(user && size > allowed && size - left <= allowed)) continue;
      is_open = true;
      out.efforts[k](i) = needed[k](i) + (size > left ? off * (1 - left / size) : 0);
      out.precision[k](i) = useful_share * largest / in;
    }
    shares.push_back(share);
    if (is_open) ++out.undecided;
  }
  out.enough = enoughFor(shares, order, out.distance);
}

}  // namespace

MotionWindows inWindows(const MotionAsked& asked) {
  const double duration = asked.given.t.back() - asked.given.t.front();
  const std::size_t rows = std::min(asked.instants.size(), asked.given.t.size());
  Windows in;
  in.half = std::max(duration / windows, rows_in_window * duration / static_cast<double>(rows - 1)) / 2;
  if (!(6 * in.half < duration))
    throw CsvError(fmt::format("{} rows show no accelerations, expected at least {}", rows, 4 * rows_in_window));
  in.centres = WindowMeans(asked.given.t, in.half).centres(rows);
  MotionWindows out;
  out.t = in.centres;
  out.window = 2 * in.half;
  out.distance = duration / static_cast<double>(rows - 1);
  EffortRows spline{asked.given.t, {}};
  for (const double each : spline.t) spline.efforts.push_back(asked.sampled(each));
  const EffortsAt by_all = asked.needed({});
  const EffortList off = meansOff(asked.given, by_all, in);
  const EffortList open = mostAround(meansOff(spline, asked.right, in));
  const LeftBetween left = leftBetween(asked, in, off);
  EffortList needed;
  for (std::size_t k = 0; k < out.t.size(); ++k) {
    needed.push_back(by_all(out.t[k]));
    out.efforts.emplace_back(needed[k] + off[k]);
    out.precision.emplace_back(other_motion * (open[k] + left.error[k]));
  }
  decide(asked, needed, left.order, out);
  return out;
}

}  // namespace ursula
