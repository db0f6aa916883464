#pragma once

#include <string>
#include <vector>

#include "model/manipulator.h"
#include "model/mechanism.h"

namespace ursula {

/// The motors of a machine, as a file of efforts counts them.
struct EffortAxes {
  struct Axis {
    bool slides = false;
    std::string joint = {};  ///< its name, empty of a leg's
  };
  EffortAxes(const Motors& motors);
  EffortAxes(const Mechanism& mechanism);
  int count() const { return static_cast<int>(axes.size()); }
  const Axis& operator[](int k) const { return axes[k]; }

  std::vector<Axis> axes;
};

}  // namespace ursula
