#include <fmt/format.h>

#include "base/errors.h"
#include "model/pose_spline.h"
#include "model/scenario_keys.h"
#include "model/scenario_sections.h"
#include "model/trajectories/trajectories.h"
#include "model/trajectories/trajectory_kinds.h"

namespace ursula {
namespace {

PoseSplineOptions sampleOptions() { return {"samples", SplineEnds::free, 6, 1e-6}; }

std::vector<TimedPose> posesOf(const CsvTable& table) {
  const auto& time = table.at("t_s");
  const std::vector<double>* position[] = {&table.at("p_x_m"), &table.at("p_y_m"), &table.at("p_z_m")};
  const std::vector<double>* orientation[] = {&table.at("q_w"), &table.at("q_x"), &table.at("q_y"), &table.at("q_z")};
  std::vector<TimedPose> poses(table.rows());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].time = time[i];
    for (int k = 0; k < 3; ++k) poses[i].position(k) = (*position[k])[i];
    for (int k = 0; k < 4; ++k) poses[i].orientation(k) = (*orientation[k])[i];
  }
  return poses;
}

}  // namespace

std::unique_ptr<Trajectory> makeSamples(const std::vector<TimedPose>& samples) {
  return makePoseSpline(samples, sampleOptions(),
                        [](std::size_t i, const auto& key, const auto& value, const auto& bound) {
                          const std::string place = key.empty() ? "" : fmt::format("[{}].{}", i + 1, key);
                          throw InvalidParameter("trajectory.samples" + place, value, bound);
                        });
}

std::unique_ptr<Trajectory> makeSamples(const CsvTable& table) {
  return makePoseSpline(posesOf(table), sampleOptions(),
                        [&table](std::size_t i, const auto& key, const auto& value, const auto& bound) {
                          const std::string what = key.empty() ? value : key + ": " + value;
                          throw CsvError(fmt::format("{}: error: {}, expected {}", table.place(i), what, bound));
                        });
}

std::vector<ScenarioTable> samplesKeys() {
  return {{"trajectory.samples",
           "[trajectory], kind = \"samples\"",
           "Through the poses of a motion sampled densely.",
           {kindKey(),
            {"file", KeyType::string, "", required_key,
             "a CSV with `t_s`, `p_{x,y,z}_m`, `q_{w,x,y,z}`, at least six rows, or with `t_ms`, `p_x_mm`, `surge_m`, "
             "`roll_deg` and the like; a relative path is taken from the scenario's folder"}}}};
}

std::shared_ptr<const Trajectory> readSamples(const TomlSection& table) {
  table.allowOnly(scenarioTable("trajectory.samples"));
  return makeSamples(readCsvBeside(table, "file", false));
}

}  // namespace ursula
