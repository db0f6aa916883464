#include "studies/map/pose_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "nocsolver/fast/batch_dynamics.h"
#include "nocsolver/solver.h"
#include "validation/subject/effort_columns.h"
#include "validation/subject/scaled_jacobian.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

constexpr std::size_t rows_of_block = 512;
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double radian = 3.14159265358979323846 / 180;

/// Kinematic results for one pose.
struct Reached {
  double reach = 0, kappa = none, sine_min = none;
  std::vector<double> sines;
};

class PoseMap {
 public:
  PoseMap(const Scenario& scenario, const PoseGrid& grid)
      : scenario_(scenario), grid_(grid), solver_(*scenario.manipulator), batch_(*scenario.manipulator) {}

  TimeSeries block(std::size_t k) const {
    const std::size_t first = k * rows_of_block, count = std::min(rows_of_block, grid_.size() - first);
    std::vector<Motion<double>> poses;
    std::vector<Vector6d> loads;
    for (std::size_t row = first; row < first + count; ++row) {
      poses.push_back(grid_.pose(row));
      loads.push_back(loadAtP(scenario_.load.get(), poses.back()));
    }
    std::vector<Vector6d> efforts(count);
    std::vector<PoseFault> faults(count);
    batch_.inverseDynamics(poses.data(), count, efforts.data(), faults.data(), loads.data());
    TimeSeries out = emptyBlock(count);
    for (std::size_t row = 0; row < count; ++row) fill(out, row, first + row, poses[row], efforts[row]);
    return out;
  }

 private:
  std::size_t legs() const { return scenario_.manipulator->parameters().legs.size(); }

  TimeSeries emptyBlock(std::size_t rows) const {
    TimeSeries out;
    const auto add = [&](const std::string& name) { out.add(name, std::vector<double>(rows)); };
    for (const char* name : {"p_x_m", "p_y_m", "p_z_m", "roll_rad", "pitch_rad", "yaw_rad", "reach", "kappa_B"})
      add(name);
    for (std::size_t i = 0; i < legs(); ++i) add(fmt::format("sine_{}", i + 1));
    add("sine_min");
    add(fmt::format("tau_max_{}", effortSuffix(scenario_.manipulator->motors())));
    return out;
  }

  void fill(TimeSeries& out, std::size_t row, std::size_t of_grid, const Motion<double>& pose,
            const Vector6d& efforts) const {
    const std::array<double, grid_axes> at = grid_.at(of_grid);
    const Reached reached = reachedAt(pose);
    std::size_t column = 0;
    const auto put = [&](double value) { out.columns[column++][row] = value; };
    for (std::size_t i = 0; i < grid_axes; ++i) put(i < 3 ? at[i] : at[i] * radian);
    put(reached.reach);
    put(reached.kappa);
    for (const double sine : reached.sines) put(sine);
    put(reached.sine_min);
    put(reached.reach == 1 ? efforts.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : none);
  }

  Reached reachedAt(const Motion<double>& pose) const {
    Reached out;
    out.sines.assign(legs(), none);
    Workspace<double> work;
    try {
      solver_.displacements(pose, work);
      out.reach = 1;
      for (std::size_t i = 0; i < out.sines.size(); ++i) out.sines[i] = solver_.margins(work, static_cast<int>(i)).sine;
      out.sine_min = *std::min_element(out.sines.begin(), out.sines.end());
      solver_.jacobians(pose, work);
      out.kappa = conditionNumber(scaledB(work.B, solver_.length()));
    } catch (const StretchedLeg&) {
      out.reach = 1;  // exactly at the end of its reach
    } catch (const SingularJacobian&) {
      out.kappa = std::numeric_limits<double>::infinity();
    } catch (const PoseError&) {
      out.reach = 0;
    }
    return out;
  }

  const Scenario& scenario_;
  const PoseGrid& grid_;
  Solver<double> solver_;
  BatchDynamics batch_;
};

void keep(const TimeSeries& block, std::vector<float>& to, const std::vector<double>& column) {
  for (std::size_t row = 0; row < block.rows(); ++row) to.push_back(static_cast<float>(column[row]));
}

}  // namespace

BlockTable mapBlocks(const Scenario& scenario, const PoseGrid& grid, DrawnMap* drawn) {
  const auto map = std::make_shared<PoseMap>(scenario, grid);
  BlockTable table;
  table.rows = grid.size();
  table.blocks = (table.rows + rows_of_block - 1) / rows_of_block;
  table.make = [map](std::size_t k) { return map->block(k); };
  if (drawn == nullptr) return table;
  drawn->effort_unit = std::string(effortSuffix(scenario.manipulator->motors())) == "N" ? "N" : "N·m";
  table.settle = [drawn](TimeSeries& block) {
    keep(block, drawn->kappa, *block.find("kappa_B"));
    keep(block, drawn->sine, *block.find("sine_min"));
    keep(block, drawn->effort, block.columns.back());
  };
  return table;
}

}  // namespace ursula
