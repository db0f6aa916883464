#include "validation/subject/singular_everywhere.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "nocsolver/errors.h"
#include "nocsolver/noc/noc.h"
#include "validation/subject/scaled_jacobian.h"

namespace ursula {
namespace {

constexpr int most_tried = 400, enough = 40, fewest = 20;
constexpr double nearly = 1e-4;  // of J's largest singular value: there rounding alone costs four of 16 digits

/// The k-th pose around `start`: the fractional parts of k√n for six primes n fill the cube evenly. Every fifth is up
/// to half the machine's length away, the others nearer, because strokes may be short.
Motion<double> poseAround(const Motion<double>& start, double length, int k) {
  const double far = std::ldexp(0.5, -(k % 5));
  const auto share = [k](double prime) {
    const double x = k * std::sqrt(prime);
    return 2 * (x - std::floor(x)) - 1;
  };
  Motion<double> out = start;
  out.p += far * length * Vector3d(share(2), share(3), share(5));
  out.Q = Eigen::Quaterniond(1, far * share(7), far * share(11), far * share(13)).normalized() * start.Q;
  return out;
}

SingularEverywhere tryPoses(const Scenario& scenario) {
  const Noc<double> solver(*scenario.manipulator);
  const Motion<double> start = scenario.trajectory->at(0);
  NocWorkspace<double> work;
  SingularEverywhere out;
  for (int k = 1; k <= most_tried && out.poses < enough && out.largest <= nearly; ++k) try {
      const Motion<double> pose = poseAround(start, solver.machine().length, k);
      solver.displacements(pose, work);
      try {
        solver.jacobians(pose, work);
      } catch (const SingularJacobian&) {  // B is there all the same
      }
      out.largest = std::max(out.largest, 1 / conditionNumber(scaledB(work.B, solver.machine().length)));
      ++out.poses;
    } catch (const PoseError&) {  // a pose that the legs cannot take says nothing
    }
  return out;
}

/// Returns the platform's size over the base's if all distances between their joints have this ratio within 1e-3;
/// otherwise 0.
double similarityOf(const std::vector<Leg>& legs) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Leg& a : legs)
    for (const Leg& b : legs)
      if (&a != &b) {
        const double ratio = (a.platform_point - b.platform_point).norm() / (a.base_point - b.base_point).norm();
        if (!std::isfinite(ratio)) return 0;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
      }
  return legs.size() == leg_count && most <= 1.001 * least ? most : 0;
}

}  // namespace

std::string SingularEverywhere::words() const {
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  return fmt::format(
      "{}singular in every pose: {}; move the joints pairwise (in {} poses that were tried, the smallest "
      "singular value of J is at most {:.2g} of the largest)",
      largest <= rounding ? "" : "nearly ",
      similarity > 0 ? fmt::format("similar hexagons at base and platform, 1 : {:.4g}", similarity)
                     : "the places of the joints make it so",
      poses, largest);
}

std::optional<SingularEverywhere> singularEverywhere(const Scenario& scenario) {
  SingularEverywhere found = tryPoses(scenario);
  if (found.poses < fewest || !(found.largest <= nearly)) return std::nullopt;
  found.similarity = similarityOf(scenario.manipulator->parameters().legs);
  return found;
}

}  // namespace ursula
