#include "nocsolver/poses/ups_poses_roots.h"

#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "nocsolver/poses/ups_poses_collector.h"

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

}  // namespace ursula::ups
