#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <memory>
#include <string>

namespace ursula::mujoco {

static_assert(sizeof(mjtNum) == sizeof(double), "MuJoCo may be built for single precision");

struct Delete {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, Delete>;
using Data = std::unique_ptr<mjData, Delete>;

// MuJoCo's parser keeps global state, so that these two take turns. They throw std::runtime_error with MuJoCo's words.
Model parseText(const std::string& text);
Model parseFile(const std::filesystem::path& file);

/// Throws std::runtime_error if there is no memory.
Data dataOf(const mjModel& model);

}  // namespace ursula::mujoco
