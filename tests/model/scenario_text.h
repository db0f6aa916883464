#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace ursula {

/// A small valid scenario; tests change one place of it.
inline const std::string good_scenario = R"(name = "small"

[manipulator]
[manipulator.platform]
mass = 500.0
center_of_mass = [0.0, 0.0, 1.88]
inertia = [800.0, 810.0, 820.0]

[manipulator.leg_defaults]
proximal = { length = 1.4, mass = 10.0, center_of_mass = 0.7, inertia = [4.2, 4.2, 0.015] }
distal = { length = 1.3, mass = 9.0, center_of_mass = 0.6, inertia = [3.3, 3.3, 0.015] }
friction = { actuated = 0.5, universal = 0.25, knee = 0.125 }

[[manipulator.leg]]
base_point = [-0.0953, -1.9682, 0.0]
base_axis = [-0.9397, 0.0, 0.3420]
platform_point = [-0.0667, -1.3847, 0.0]

[[manipulator.leg]]
base_point = [0.0953, -1.9682, 0.0]
base_axis = [0.9397, 0.0, 0.3420]
platform_point = [0.0667, -1.3777, 0.0]

[[manipulator.leg]]
base_point = [1.7521, 0.9016, 0.0]
base_axis = [0.4698, -0.8138, 0.3420]
platform_point = [1.2265, 0.6381, 0.0]

[[manipulator.leg]]
base_point = [1.6569, 1.0666, 0.0]
base_axis = [-0.4698, 0.8138, 0.3420]
platform_point = [1.1598, 0.7536, 0.0]

[[manipulator.leg]]
base_point = [-1.6569, 1.0666, 0.0]
base_axis = [0.4698, 0.8138, 0.3420]
platform_point = [-1.1598, 0.7466, 0.0]

[[manipulator.leg]]
base_point = [-1.7521, 0.9016, 0.0]
base_axis = [-0.4698, -0.8138, 0.3420]
platform_point = [-1.2265, 0.6311, 0.0]

[trajectory]
kind = "helix"
duration = 3.0
radius = 0.2
pitch = 1.2
start_angle = -1.5707963267948966
end_angle = -1.0471975511965976
height_phase = 2.2
)";

/// Returns `text` with the first `from` replaced; the test fails if there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  if (place == std::string::npos) {
    ADD_FAILURE() << "not in the text: " << from;
    return text;
  }
  return text.replace(place, from.size(), to);
}

/// A text and the `line:column` of the '@' that was in it.
struct MarkedText {
  std::string text, place;
};

inline MarkedText marked(std::string text) {
  const auto mark = text.find('@');
  if (mark == std::string::npos) {
    ADD_FAILURE() << "no mark in the text";
    return {text, "?"};
  }
  const std::string before = text.substr(0, mark);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto column = mark - (before.rfind('\n') == std::string::npos ? 0 : before.rfind('\n') + 1) + 1;
  return {text.erase(mark, 1), std::to_string(line) + ":" + std::to_string(column)};
}

}  // namespace ursula
