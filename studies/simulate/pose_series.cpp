#include "studies/simulate/pose_series.h"

#include <fmt/format.h>

#include "model/instants.h"
#include "nocsolver/noc/noc.h"
#include "validation/subject/leg_points.h"

namespace ursula {
namespace {

/// The points of one instant, in the order of the columns: p, then A, R, B of each leg.
std::vector<Vector3d> points(const Manipulator& machine, const Noc<double>& solver, const Motion<double>& motion) {
  NocWorkspace<double> work;
  solver.displacements(motion, work);
  std::vector<Vector3d> all = {motion.p};
  for (const LegPoints& leg : legPoints(machine, work)) all.insert(all.end(), {leg.A, leg.R, leg.B});
  return all;
}

std::vector<std::string> pointNames(int legs) {
  std::vector<std::string> names = {"p"};
  for (int i = 1; i <= legs; ++i)
    for (const char* point : {"A", "R", "B"}) names.push_back(fmt::format("{}_{}", point, i));
  return names;
}

}  // namespace

TimeSeries poseSeries(const Scenario& scenario, int count) {
  const Manipulator& machine = *scenario.manipulator;
  const Noc<double> solver(machine);
  const std::vector<double> instants = equallySpaced(scenario.trajectory->duration(), count);
  std::vector<std::vector<Vector3d>> rows;
  rows.reserve(instants.size());
  for (double t : instants) rows.push_back(points(machine, solver, scenario.trajectory->at(t)));
  TimeSeries series;
  series.add("t_s", instants);
  const std::vector<std::string> names = pointNames(machine.legCount());
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
