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

/// The content of a model file in any format: bodies, primitive joints, closures, motors and gravity. `motors` are those
/// of the file, or the user's choice.
struct ModelGraph : MechanismParameters {
  ModelFormat format = ModelFormat::sdf;
  Assumptions assumptions;
};

/// A model that cannot be imported: what is wrong, what was expected, what would help. The line of the file is 1-based,
/// or 0 if no single line causes it.
class ImportError : public InputError {
 public:
  explicit ImportError(const std::string& what, int at_line = 0) : InputError(what), line(at_line) {}

  int line;
};

}  // namespace ursula::exchange
