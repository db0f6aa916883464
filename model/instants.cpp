#include "model/instants.h"

#include <algorithm>

namespace ursula {

std::vector<double> equallySpaced(double duration, int count) {
  std::vector<double> instants;
  instants.reserve(count);
  for (int k = 0; k < count; ++k) instants.push_back(instantOf(duration, k, count));
  return instants;
}

std::vector<double> allKnots(const Scenario& scenario) {
  std::vector<double> knots = scenario.trajectory->knots();
  if (scenario.load && scenario.load->history) {
    const std::vector<double>& more = scenario.load->history->knots();
    knots.insert(knots.end(), more.begin(), more.end());
    std::sort(knots.begin(), knots.end());
  }
  return knots;
}

std::vector<double> knotsWithin(const Scenario& scenario, double start, double end) {
  const std::vector<double> knots = allKnots(scenario);
  const double duration = scenario.trajectory->duration();
  const double least = duration * (knots.size() <= most_knots ? 1e-9 : 1.0 / 4096);
  std::vector<double> within;
  double before = start;
  for (double knot : knots)
    if (knot - before >= least && end - knot >= least) within.push_back(before = knot);
  return within;
}

}  // namespace ursula
