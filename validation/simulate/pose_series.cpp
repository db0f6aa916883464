#include "validation/simulate/pose_series.h"

#include <fmt/format.h>

#include "model/instants.h"
#include "nocsolver/solver.h"

namespace ursula {
namespace {

/// The points of one instant, in the order of the columns: p, then A, R, B of each leg.
std::vector<Vector3d> points(const Scenario& scenario, const Solver<double>& solver, const Motion<double>& motion) {
  Workspace<double> work;
  BodyMotions<double> bodies;
  solver.inverseKinematics(motion, work);
  solver.bodyMotions(motion, work, bodies);
  std::vector<Vector3d> all = {motion.p};
  for (int i = 0; i < leg_count; ++i) {
    const Leg& leg = scenario.manipulator->leg(i);
    const auto k = static_cast<std::size_t>(i);
    const Vector3d R = leg.base_point + leg.proximal.length * bodies[k].R.col(2);
    all.insert(all.end(), {leg.base_point, R, R + leg.distal.length * bodies[leg_count + k].R.col(2)});
  }
  return all;
}

std::vector<std::string> pointNames() {
  std::vector<std::string> names = {"p"};
  for (int i = 1; i <= leg_count; ++i)
    for (const char* point : {"A", "R", "B"}) names.push_back(fmt::format("{}_{}", point, i));
  return names;
}

}  // namespace

TimeSeries poseSeries(const Scenario& scenario, int count) {
  const Solver<double> solver(*scenario.manipulator);
  const std::vector<double> instants = equallySpaced(scenario.trajectory->duration(), count);
  std::vector<std::vector<Vector3d>> rows;
  rows.reserve(instants.size());
  for (double t : instants) rows.push_back(points(scenario, solver, scenario.trajectory->at(t)));
  TimeSeries series;
  series.add("t_s", instants);
  const std::vector<std::string> names = pointNames();
  for (std::size_t k = 0; k < names.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> column;
      column.reserve(rows.size());
      for (const std::vector<Vector3d>& row : rows) column.push_back(row[k](axis));
      series.add(fmt::format("{}_{}_m", names[k], "xyz"[axis]), std::move(column));
    }
  return series;
}

}  // namespace ursula
