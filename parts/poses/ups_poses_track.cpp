#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <optional>

#include "base/dense.h"
#include "parts/poses/ups_poses_parts.h"

namespace ursula::ups {
namespace {

Roots rootsInChart(const Legs& legs, const LegSection& section, int index) {
  const Multiplication multiply = multiplication(section.N, index);
  Roots none;
  none.pivot = std::min(multiply.pivot, section.pivot);
  if (!(none.pivot > smallestPivot()) || !multiply.M.allFinite()) return none;
  const std::optional<EigenPairs> pairs = eigenPairs(multiply.M);
  if (!pairs) return none;
  const Eigen::MatrixXcd all = pairs->vectors.topRows<section_count>();
  RootCollector collector(legs);
  for (int i = 0; i < solution_count; ++i) {
    const bool real = pairs->values(i).imag() == 0;
    const ComplexCoordinates x = multiply.map.cast<std::complex<double>>() * all.col(i);
    collector.addEigenvector(x.normalized(), real ? 1 : 2);
    if (!real) ++i;
  }
  Roots roots = collector.count();
  roots.pivot = none.pivot;
  return roots;
}

// A nearby machine, perturbed by s times a fixed generic amount, has 40 solutions for all but a few s. They are
// followed from s = 1 to 0 on a curved path through the complex plane that avoids those few. Each isolated pose of the
// machine ends as many paths as its multiplicity. The others end at infinity or on a curve of poses; every such curve
// ends at least one.

using Complex = std::complex<double>;

constexpr double eps = Eigen::NumTraits<double>::epsilon();
constexpr int throw_count = 3, step_limit = 4000;
const double last_t = std::pow(2.0, -36), late_t = std::pow(2.0, -10), bend = 0.7;
/// A path whose |h| of unit coordinates ends below little_h ends at infinity; a real pose has a larger |h|. A path that
/// ends below hidden_h does so too if it ends at no pose.
const double little_h = std::pow(eps, 1.0 / 4), hidden_h = std::pow(eps, 3.0 / 16);

/// The way from a perturbed machine, at s = 1, to the given one, at s = 0.
struct Way {
  Legs end, change;

  Legs start() const {
    Legs legs = end;
    for (std::size_t i = 0; i < 6; ++i) {
      legs.a[i] += change.a[i];
      legs.b[i] += change.b[i];
    }
    legs.d += change.d;
    return legs;
  }

  LegsOver<Complex> at(Complex s) const {
    LegsOver<Complex> legs;
    for (std::size_t i = 0; i < 6; ++i) {
      legs.a[i] = end.a[i] + s * change.a[i];
      legs.b[i] = end.b[i] + s * change.b[i];
    }
    legs.d = end.d + s * change.d;
    return legs;
  }

  /// Returns ∂f/∂s.
  Vec6<Complex> slope(const LegsOver<Complex>& legs, const ComplexPose& pose) const {
    const Mat3<Complex> Q = rotation<Complex>(pose.q);
    Vec6<Complex> out;
    for (std::size_t i = 0; i < 6; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const Vec3<Complex> v = pose.p + Q * legs.b[i] - legs.a[i], dv = Q * change.b[i] - change.a[i];
      out(k) = 2.0 * product(v, dv) - 2.0 * legs.d(k) * change.d(k);
    }
    return out;
  }
};

/// Perturbs the legs by up to 0.3 units.
Way randomWay(const Legs& legs, int index) {
  std::uint64_t state = 0xd1b54a32d192ed03u * static_cast<std::uint64_t>(index + 1);
  const auto next = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return 0.3 * (static_cast<double>(state >> 33) / 1073741824.0 - 1);
  };
  Way way{legs, legs};
  for (std::size_t i = 0; i < 6; ++i) {
    for (int k = 0; k < 3; ++k) way.change.a[i](k) = next();
    for (int k = 0; k < 3; ++k) way.change.b[i](k) = next();
    way.change.d(static_cast<Eigen::Index>(i)) = next();
  }
  return way;
}

Complex bent(double t) { return {t, bend * t * (1 - t)}; }

/// Returns the size of a step from a pose; rotations are relative already.
double size(const Vec6<Complex>& step, const ComplexPose& pose) {
  return step.head<3>().norm() + step.tail<3>().norm() / (1 + pose.p.norm());
}

/// Applies Newton's method at s. Returns nullopt unless the start is close to the solution.
std::optional<ComplexPose> corrected(const LegsOver<Complex>& legs, ComplexPose pose, double closeness) {
  double previous = closeness;
  for (int i = 0; i < 4; ++i) {
    const Equations<Complex> at = equations<Complex>(legs, pose);
    const Vec6<Complex> step = -at.J.partialPivLu().solve(at.f);
    const double length = size(step, pose);
    if (!(length <= previous)) return std::nullopt;
    pose = displaced<Complex>(pose, step);
    if (length <= 1e-9 || at.solved()) return pose;
    previous = length / 8;
  }
  return std::nullopt;
}

/// Returns the pose at t = 2⁻³⁶, or earlier where rounding hides the path, as it does near a singular end or infinity.
/// Returns nullopt if the path is lost.
std::optional<ComplexPose> follow(const Way& way, ComplexPose pose, double closeness) {
  double t = 1, fraction = 0.05;
  for (int i = 0; i < step_limit && t > last_t; ++i) {
    if (t < late_t && std::abs(coordinates(pose)(at_h)) < little_h) break;
    const double next_t = t * (1 - fraction);
    const LegsOver<Complex> legs = way.at(bent(t));
    const Equations<Complex> at = equations<Complex>(legs, pose);
    const Vec6<Complex> tangent = -at.J.partialPivLu().solve(way.slope(legs, pose));
    const ComplexPose predicted = displaced<Complex>(pose, tangent * (bent(next_t) - bent(t)));
    if (const auto next = corrected(way.at(bent(next_t)), predicted, closeness)) {
      pose = *next;
      t = next_t;
      fraction = std::min(0.5, 1.5 * fraction);
    } else {
      fraction /= 2;
      if (fraction < 1e-6) return t < late_t ? std::optional(pose) : std::nullopt;
    }
  }
  return pose;
}

/// Adds the end of a path to the collector: a pose, or a solution at infinity. A path that ends at neither is lost.
void finish(const Legs& legs, const ComplexPose& end, RootCollector& collector, bool& free) {
  const double h = std::abs(coordinates(end)(at_h));
  ComplexPose pose = end;
  const double near = std::pow(eps, 1.0 / 8);
  if (h > little_h && polishPose(legs, pose) && (coordinates(pose) - coordinates(end)).norm() < near) {
    free = free || isFree(legs, pose);
    collector.addEnd(pose);
  } else if (h < hidden_h) {
    collector.addInfinite(1);
  }
}

Roots tracked(const Way& way, const Roots& start, double closeness) {
  RootCollector collector(way.end);
  bool free = false;
  for (const Root& root : start.list)
    for (int conjugate = 0; conjugate < (root.real ? 1 : 2); ++conjugate) {
      const ComplexPose from = conjugate ? ComplexPose{root.at.q.conjugate(), root.at.p.conjugate()} : root.at;
      if (const auto end = follow(way, from, closeness)) finish(way.end, *end, collector, free);
    }
  Roots roots = collector.count();
  roots.free = free;
  return roots;
}

}  // namespace

double smallestPivot() { return 16 * std::pow(Eigen::NumTraits<double>::epsilon(), 0.75); }

/// If a solution lies in a chart's plane at infinity, that chart fails; this hardly happens to two.
Roots findRoots(const Legs& legs) {
  const LegSection section = legSection(legs);
  Roots best;
  int faulty = 0;
  for (int index = 0; index < chart_count && faulty < 2 && !best.complete(); ++index) {
    const Roots roots = rootsInChart(legs, section, index);
    const double pivot = std::max(best.pivot, roots.pivot);
    if (!(roots.pivot > smallestPivot())) ++faulty;
    if (roots.all() > best.all()) best = roots;
    best.pivot = pivot;
  }
  return best;
}

Roots trackRoots(const Legs& legs) {
  Roots best;
  double closeness = 0.05;
  for (int index = 0; index < throw_count; ++index, closeness /= 4) {
    const Way way = randomWay(legs, index);
    const Roots start = findRoots(way.start());
    if (start.counted != solution_count) continue;
    const Roots roots = tracked(way, start, closeness);
    if (roots.free) return roots;
    if (roots.all() > best.all()) best = roots;
    if (best.complete()) break;
  }
  return best;
}

}  // namespace ursula::ups
