#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/mechanism.h"

namespace ursula {

/// What a comparison with MuJoCo's own reader must not hold against ours.
struct ReadingChoices {
  bool of_file_pose = true;               ///< the reference pose is the file's own, no keyframe's
  bool has_file_gravity = true;           ///< gravity is the file's
  bool leaves_out = false;                ///< the user left loads out
  bool is_urdf = false;                   ///< rotors are then said by elements of others, which MuJoCo passes over
  std::vector<std::string> retyped = {};  ///< joints whose type another file says, which MuJoCo does not read
  bool by_eigenvalues = true;             ///< MuJoCo diagonalises inertias of the file, which costs half of the digits
};

/// How far MuJoCo's own reading of a model file is from this program's.
struct ReadingDifference {
  std::string refusal;                       ///< MuJoCo's words, if it does not read the file; the rest is empty then
  double value = 0;                          ///< relative, of the quantity that is the nearest to its limit
  double limit = 1e-12;                      ///< of that quantity
  std::string where;                         ///< "mass of arm"
  std::vector<std::string> left_out;         ///< "armature of left": what MuJoCo cannot have read
  int bodies = 0, joints = 0, closures = 0;  ///< that were compared
};

/// Loads the file with MuJoCo and compares what has a name in both: masses, mass centres, inertias, frames, axes,
/// anchors, loads, closures and gravity. Throws std::runtime_error if the build lacks MuJoCo.
ReadingDifference readByMujoco(const std::filesystem::path& file, const MechanismParameters& ours,
                               const ReadingChoices& choices);

}  // namespace ursula
