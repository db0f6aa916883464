#include "report/files/inverse_blocks.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "model/instants.h"
#include "nocsolver/errors.h"
#include "nocsolver/noc/noc.h"
#include "validation/findings/findings.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Blocks are so large that handing one over costs nothing, and so small that they fit into the second-level cache.
constexpr int rows_of_block = 512;

/// Files contain no infinities or NaN.
void requireFiniteSeries(const TimeSeries& series, const std::vector<Motion<double>>& motions) {
  for (std::size_t row = 0; row < motions.size(); ++row)
    for (std::size_t i = 0; i < series.names.size(); ++i)
      requireFinite(&series.columns[i][row], 1, series.names[i].c_str(), motions[row].t);
}

class InverseBlocks {
 public:
  InverseBlocks(const Scenario& scenario, int samples)
      : scenario_(scenario), samples_(samples), solver_(*scenario.manipulator) {}

  TimeSeries block(std::size_t k) const {
    const int first = static_cast<int>(k) * rows_of_block, count = std::min(rows_of_block, samples_ - first);
    std::vector<Motion<double>> motions;
    std::vector<Vector6d> loads;
    motions.reserve(count);
    loads.reserve(count);
    for (int row = first; row < first + count; ++row) {
      motions.push_back(scenario_.trajectory->at(instantOf(scenario_.trajectory->duration(), row, samples_)));
      loads.push_back(loadAtP(scenario_.load.get(), motions.back()));
    }
    std::vector<Vector6d> efforts;
    std::vector<JointMotion> joints;
    efforts.reserve(motions.size());
    joints.reserve(motions.size());
    NocWorkspace<double> work;
    for (std::size_t row = 0; row < motions.size(); ++row) {  // in order, so that the first refused pose is reported
      efforts.push_back(solver_.inverseDynamics(motions[row], work, loads[row]));
      joints.push_back({solver_.angles(work), solver_.rates(work), solver_.accelerations(work)});
    }
    TimeSeries series = inverseSeries(*scenario_.manipulator, motions, joints, efforts);
    requireFiniteSeries(series, motions);
    return series;
  }

 private:
  const Scenario& scenario_;
  int samples_;
  Noc<double> solver_;
};

/// Keeps quaternion signs continuous across blocks by the previous row, because each block begins with w >= 0.
void turn(TimeSeries& block, std::array<double, 4>& before) {
  const auto w = std::find(block.names.begin(), block.names.end(), "q_w") - block.names.begin();  // x, y and z follow
  double along = 0;
  for (std::size_t i = 0; i < 4; ++i) along += before[i] * block.columns[w + i].front();
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<double>& q = block.columns[w + i];
    if (along < 0)
      for (double& value : q) value = -value;
    before[i] = q.back();
  }
}

}  // namespace

BlockTable inverseBlocks(const Scenario& scenario, int samples) {
  const auto made = std::make_shared<InverseBlocks>(scenario, samples);
  BlockTable table;
  table.rows = samples;
  table.blocks = (table.rows + rows_of_block - 1) / rows_of_block;
  table.make = [made](std::size_t k) { return made->block(k); };
  table.settle = [before = std::array<double, 4>{}](TimeSeries& block) mutable { turn(block, before); };
  return table;
}

}  // namespace ursula
