#include "parts/map/pose_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/scalar.h"
#include "base/text.h"
#include "model/instants.h"
#include "model/leg_kind.h"
#include "model/legs/leg_type.h"
#include "model/torque_names.h"
#include "nocsolver/legs/leg_model.h"
#include "parts/fast/batch_dynamics.h"
#include "parts/fast/solver.h"
#include "validation/subject/scaled_jacobian.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

constexpr std::size_t most_poses = 100'000'000;

std::vector<std::string> parts(const std::string& text) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    if (c == ',')
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

/// The same limit as for a scenario's numbers.
constexpr double largest_coordinate = 1e100;

double finiteNumber(const std::string& name, const std::string& text, const std::string& part) {
  const LeadingNumber read = leadingNumber(part);
  if (part.empty() || read.length != part.size() || !std::isfinite(read.value))
    throw GridError(fmt::format("--{} {}: '{}' is not a finite number", name, text, part));
  if (!(std::abs(read.value) <= largest_coordinate))
    throw GridError(fmt::format("--{} {}: {}, expected a size of at most {}", name, text, part, largest_coordinate));
  return read.value;
}

Vector3d anglesOf(const Matrix3d& Q) {
  return Vector3d(std::atan2(Q(2, 1), Q(2, 2)), -std::asin(std::clamp(Q(2, 0), -1.0, 1.0)),
                  std::atan2(Q(1, 0), Q(0, 0))) /
         degree;
}

/// Extends the path of P by a quarter of the machine's length.
void setAround(const Scenario& scenario, std::array<GridAxis, grid_axes>& axes) {
  constexpr std::array<int, 3> counts = {41, 41, 3};
  Eigen::AlignedBox3d box;
  for (const double t : equallySpaced(scenario.trajectory->duration(), 101)) box.extend(scenario.trajectory->at(t).p);
  const double beside = MachineParameters<double>(*scenario.manipulator).length / 4;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (!axes[i].given) axes[i] = {box.min()(k) - beside, box.max()(k) + beside, counts[i], true};
  }
}

}  // namespace

GridAxis gridAxis(const std::string& name, const std::string& text) {
  const std::vector<std::string> all = parts(text);
  if (all.size() != 1 && all.size() != 3)
    throw GridError(fmt::format("--{} {}: {} numbers, expected FROM,TO,COUNT or one value", name, text, all.size()));
  GridAxis axis;
  axis.given = true;
  axis.from = axis.to = finiteNumber(name, text, all[0]);
  if (all.size() == 1) return axis;
  axis.to = finiteNumber(name, text, all[1]);
  const double count = finiteNumber(name, text, all[2]);
  if (!(count >= 1 && count <= most_poses) || count != std::floor(count))
    throw GridError(fmt::format("--{} {}: a count of {}, expected a whole number of 1 or more, 100 million at most",
                                name, text, all[2]));
  axis.count = static_cast<int>(count);
  if (axis.varies() != (axis.from != axis.to))
    throw GridError(fmt::format("--{} {}: a count of {} from {} to {}, expected {}", name, text, axis.count, axis.from,
                                axis.to, axis.varies() ? "two ends apart" : "2 or more"));
  return axis;
}

PoseGrid::PoseGrid(const Scenario& scenario, const std::array<GridAxis, grid_axes>& axes, double instant)
    : axes_(axes) {
  const double duration = scenario.trajectory->duration();
  if (!(instant >= 0 && instant <= duration))
    throw GridError(fmt::format("--at {}: expected an instant of the motion, from 0 to {} s", instant, duration));
  const Motion<double> there = scenario.trajectory->at(instant);
  rest_.t = instant;
  rest_.p = there.p;
  rest_.Q = there.Q;
  if (std::none_of(axes_.begin(), axes_.end(), [](const GridAxis& axis) { return axis.varies(); }))
    setAround(scenario, axes_);
  turns_ = std::any_of(axes_.begin() + 3, axes_.end(), [](const GridAxis& axis) { return axis.given; });
  const std::array<double, grid_axes> coordinates = coordinatesOf(there);
  for (std::size_t i = 0; i < grid_axes; ++i) {
    if (!axes_[i].given) axes_[i].from = axes_[i].to = coordinates[i];
    if (!axes_[i].varies()) continue;
    varying_.push_back(i);
    const auto count = static_cast<std::size_t>(axes_[i].count);
    if (size_ > most_poses / count) throw GridError("more than 100 million poses: expected fewer");
    size_ *= count;
  }
  if (varying_.size() == 2 || varying_.size() == 3) return;
  std::string names;
  for (const std::size_t i : varying_) names += (names.empty() ? "" : ", ") + std::string(grid_axis_names[i]);
  throw GridError(fmt::format("{} {} ({}), expected two or three with FROM,TO,COUNT", varying_.size(),
                              varying_.size() == 1 ? "coordinate varies" : "coordinates vary", names));
}

std::array<double, grid_axes> PoseGrid::coordinatesOf(const Motion<double>& pose) {
  const Vector3d angles = anglesOf(pose.Q);
  return {pose.p.x(), pose.p.y(), pose.p.z(), angles.x(), angles.y(), angles.z()};
}

std::array<double, grid_axes> PoseGrid::at(std::size_t k) const {
  std::array<double, grid_axes> out{};
  for (std::size_t i = 0; i < grid_axes; ++i) {
    const auto count = static_cast<std::size_t>(axes_[i].count);
    out[i] = axes_[i].value(static_cast<int>(k % count));
    k /= count;
  }
  return out;
}

Motion<double> PoseGrid::pose(std::size_t k) const {
  const std::array<double, grid_axes> c = at(k);
  Motion<double> out = rest_;
  out.p = {c[0], c[1], c[2]};
  if (turns_)
    out.Q = (Eigen::AngleAxisd(c[5] * degree, Vector3d::UnitZ()) * Eigen::AngleAxisd(c[4] * degree, Vector3d::UnitY()) *
             Eigen::AngleAxisd(c[3] * degree, Vector3d::UnitX()))
                .toRotationMatrix();
  return out;
}

namespace {

constexpr std::size_t rows_of_block = 512;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Kinematic results for one pose.
struct Reached {
  double reach = 0, kappa = none, sine_min = none, stroke_min = none;
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
  bool hasStroke() const {
    const auto& legs = scenario_.manipulator->parameters().legs;
    return std::any_of(legs.begin(), legs.end(), [](const Leg& leg) { return leg.kind == LegKind::UPS; });
  }

  /// The smallest distance from an end of a stroke, m.
  double strokeLeft(const JointVariables<double>& q) const {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < scenario_.manipulator->legCount(); ++i)
      if (const Leg& leg = scenario_.manipulator->leg(i); leg.kind == LegKind::UPS)
        least = std::min(least, typeOf(leg.kind).margin(leg, q, i));
    return least;
  }

  std::size_t legs() const { return scenario_.manipulator->parameters().legs.size(); }

  TimeSeries emptyBlock(std::size_t rows) const {
    TimeSeries out;
    const auto add = [&](const std::string& name) { out.add(name, std::vector<double>(rows)); };
    for (const char* name : {"p_x_m", "p_y_m", "p_z_m", "roll_rad", "pitch_rad", "yaw_rad", "reach", "kappa_B"})
      add(name);
    for (std::size_t i = 0; i < legs(); ++i) add(fmt::format("sine_{}", i + 1));
    add("sine_min");
    if (hasStroke()) add("stroke_min_m");
    add(fmt::format("tau_max_{}", effortSuffix(scenario_.manipulator->motors())));
    return out;
  }

  void fill(TimeSeries& out, std::size_t row, std::size_t of_grid, const Motion<double>& pose,
            const Vector6d& efforts) const {
    const std::array<double, grid_axes> at = grid_.at(of_grid);
    const Reached reached = reachedAt(pose);
    std::size_t column = 0;
    const auto put = [&](double value) { out.columns[column++][row] = value + 0.0; };  // no −0
    for (std::size_t i = 0; i < grid_axes; ++i) put(i < 3 ? at[i] : at[i] * degree);
    put(reached.reach);
    put(reached.kappa);
    for (const double sine : reached.sines) put(sine);
    put(reached.sine_min);
    if (hasStroke()) put(reached.stroke_min);
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
      out.stroke_min = strokeLeft(solver_.angles(work));
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

bool isTelescopic(const Scenario& scenario) {
  const auto& legs = scenario.manipulator->parameters().legs;
  return std::all_of(legs.begin(), legs.end(), [](const Leg& leg) { return leg.kind == LegKind::UPS; });
}

BlockTable mapBlocks(const Scenario& scenario, const PoseGrid& grid, DrawnMap& drawn) {
  const auto map = std::make_shared<PoseMap>(scenario, grid);
  BlockTable table;
  table.rows = grid.size();
  table.blocks = (table.rows + rows_of_block - 1) / rows_of_block;
  table.make = [map](std::size_t k) { return map->block(k); };
  drawn.effort_unit = std::string(effortSuffix(scenario.manipulator->motors())) == "N" ? "N" : "N·m";
  const char* const margin = isTelescopic(scenario) ? "stroke_min_m" : "sine_min";
  table.settle = [&drawn, margin](TimeSeries& block) {
    const std::vector<double>& reach = *block.find("reach");
    drawn.reached += static_cast<std::size_t>(std::count(reach.begin(), reach.end(), 1.0));
    if (!drawn.kept) return;
    keep(block, drawn.kappa, *block.find("kappa_B"));
    keep(block, drawn.margin, *block.find(margin));
    keep(block, drawn.effort, block.columns.back());
  };
  return table;
}

}  // namespace ursula
