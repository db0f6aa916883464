#include "studies/map/pose_grid.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "base/leading_number.h"
#include "model/instants.h"
#include "nocsolver/legs/leg_model.h"

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
  Vector6d coordinates;
  coordinates << there.p, anglesOf(there.Q);
  for (std::size_t i = 0; i < grid_axes; ++i) {
    if (!axes_[i].given) axes_[i].from = axes_[i].to = coordinates(static_cast<Eigen::Index>(i));
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

}  // namespace ursula
