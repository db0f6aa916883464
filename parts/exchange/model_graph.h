#pragma once

#include <string>
#include <vector>

#include "base/errors.h"
#include "model/mechanism.h"

namespace ursula::exchange {

using ursula::JointKind;
using GraphBody = MechanismBody;
using GraphJoint = MechanismJoint;

/// One assumption of the import, with its size in the machine's own units.
struct Assumption {
  std::string what;   ///< a full sentence
  std::string where;  ///< bodies, joints or place in the file
  double size = 0;
  std::string unit = "1";  ///< "m", "rad", "1", "kg", …
  bool warning = false;    ///< the file may not mean what was read; warnings come first
};
using Assumptions = std::vector<Assumption>;
/// Returns one line of text, "warning: JOINT: This joint is open … (0.01 m)".
std::string inWords(const Assumption& assumption);

enum class ModelFormat { sdf, mjcf, urdf };

/// Forces in the file that no machine has words for: they are refused, unless the user leaves them out.
struct OtherForce {
  std::string kind;     ///< the user's word for it, "fluid"
  std::string refusal;  ///< the text of the refusal
  int line = 0;
  Assumption left_out;  ///< said if it is left out
};

/// A pose of an MJCF's `<keyframe>`; `qpos` as the file has it.
struct Keyframe {
  std::string name, qpos;
  int line = 0;
};

/// The content of a model file in any format: bodies, primitive joints, closures, motors and gravity. `motors` are
/// those of the file, or the user's choice. What only some machines can have, as springs, is carried and refused later.
struct ModelGraph : MechanismParameters {
  ModelFormat format = ModelFormat::sdf;
  Assumptions assumptions;
  std::vector<OtherForce> other_forces;
  std::vector<Keyframe> keyframes;
};

/// A model that cannot be imported: what is wrong, what was expected, what would help. The line of the file is 1-based,
/// or 0 if no single line causes it.
class ImportError : public InputError {
 public:
  explicit ImportError(const std::string& what, int at_line = 0) : InputError(what), line(at_line) {}

  int line;
};

}  // namespace ursula::exchange
