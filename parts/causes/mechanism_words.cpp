#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/text.h"
#include "parts/causes/hypotheses.h"
#include "parts/causes/mechanism_tried.h"

namespace ursula::mechanisms {
namespace {

/// "'crank'", "all bodies", "motor 2", …
std::string ownerOf(const NamedCause& cause) {
  if (!cause.joint.empty()) return "joint '" + cause.joint + "'";
  if (cause.motor > 0) return fmt::format("motor {}", cause.motor);
  if (!cause.legs.empty()) {
    std::string out = "motors ";
    for (std::size_t i = 0; i < cause.legs.size(); ++i)
      out += fmt::format("{}{}", i == 0 ? "" : i + 1 == cause.legs.size() ? " and " : ", ", cause.legs[i]);
    return out;
  }
  return cause.body.empty() || cause.body == "all" ? "" : "'" + cause.body + "'";
}

std::string ofOwner(const NamedCause& cause) {
  if (cause.joint.empty() && cause.body == "passive") return " of the passive joints";
  if (cause.joint.empty() && cause.body == "motors") return " of the motors";
  const std::string owner = ownerOf(cause);
  return owner.empty() ? "" : " of " + owner;
}

std::string termWords(const std::string& term) {
  static const std::pair<const char*, const char*> known[] = {{"gravity", "the weight"},
                                                              {"gyroscopic", "the gyroscopic moment"},
                                                              {"coriolis", "the velocity-product term"},
                                                              {"centripetal", "the acceleration by velocities"},
                                                              {"inertia", "the inertia"},
                                                              {"acceleration", "the acceleration"},
                                                              {"friction", "the friction"},
                                                              {"rotor_inertia", "the armature"},
                                                              {"springs", "the springs' force"},
                                                              {"orientation", "the tensor of inertia"},
                                                              {"angular_velocity", "the angular velocity"},
                                                              {"angular_acceleration", "the angular acceleration"},
                                                              {"", "the effort"}};
  for (const auto& [name, words] : known)
    if (term == name) return words;
  return term;
}

/// "the mass", "entry y of the mass centre", from the last words of a number's path.
std::string numberWords(const std::string& key) {
  if (key == "center_of_mass") return "the mass centre";
  if (key.rfind("center_of_mass.", 0) == 0) return fmt::format("entry {} of the mass centre", "xyz"[key.back() - '0']);
  if (key == "inertia") return "the tensor of inertia";
  if (key.rfind("inertia.", 0) == 0) return "the inertia " + key.substr(8);
  if (key == "springref") return "the spring's rest position";
  if (key == "friction") return "the Coulomb friction";
  for (const char* vector : {"position", "axis"})
    if (key.rfind(vector + std::string("."), 0) == 0)
      return fmt::format("entry {} of the {}", "xyz"[key.back() - '0'], vector);
  return "the " + key;
}

std::string numbersWords(const NamedCause& cause) {
  if (!cause.found || !cause.expected) return "";
  const std::string unit = cause.unit.empty() ? "" : " " + cause.unit;
  const double size = std::abs(*cause.found), spread = cause.uncertainty.value_or(0);
  const bool is_zero = size <= spread && spread <= 1e-9 * std::abs(*cause.expected);
  std::string out = fmt::format("{:.7g}", is_zero ? 0 : *cause.found);
  if (!is_zero && cause.uncertainty && *cause.uncertainty > 1e-7 * std::abs(*cause.found))
    out += fmt::format(" +- {:.2g}", *cause.uncertainty);
  return fmt::format(" is {}{} instead of {:.7g}{}", out, unit, *cause.expected, unit);
}

std::string parameterWords(const NamedCause& cause) {
  const std::string wrong = cause.found ? numbersWords(cause) : " is wrong";
  if (cause.term == "gravity") {
    const bool one = cause.parameter.size() > std::string("gravity").size();
    return (one ? fmt::format("entry {} of gravity", "xyz"[cause.parameter.back() - '0']) : "gravity") + wrong;
  }
  if (cause.term == "friction")
    return "the Coulomb friction" + ofOwner(cause) + " is not smoothed: it has the sign of the rate";
  const std::string owner = cause.joint.empty() ? "body." + cause.body + "." : "joint." + cause.joint + ".";
  const std::string on = cause.joint.empty() || cause.body.empty() ? "" : " on '" + cause.body + "'";
  return numberWords(cause.parameter.substr(owner.size())) + ofOwner(cause) + on + wrong;
}

std::string closureWords(const std::string& term) {
  if (term == "open")
    return "these are the efforts of the open tree, read at the motors; the loops' forces are missing";
  if (term == "bias")
    return "the velocity-product term of the closures (J̇v) is left out of the passive joints' accelerations";
  if (term == "least_squares")
    return "the efforts are shared among all joints by least squares, and read at the motors";
  if (term == "constant") return "the loops' transmission is constant: N of the first instant at every instant";
  return "soft constraints of the loops, read at the motors: the loops left open, with forces in proportion to J̇v of "
         "each closure";
}

/// "kN m for N m; kN for N".
std::string unitWords(double factor) {
  MotorNames moments, forces;
  forces.slides.fill(true);
  const std::string of_moments = unitOf(factor, moments), of_forces = unitOf(factor, forces);
  if (of_moments.empty() || of_forces.empty() || of_moments == of_forces)
    return of_moments.empty() ? of_forces : of_moments;
  return of_moments + "; " + of_forces;
}

std::string scaleWords(const NamedCause& cause) {
  const std::string what = cause.term.empty() ? cause.body == "all" ? "every effort" : "the effort" + ofOwner(cause)
                                              : termWords(cause.term) + ofOwner(cause);
  if (!cause.found) return what + " has a wrong factor";
  const std::string unit = cause.kind == CauseKind::units && cause.term.empty() ? unitWords(*cause.found) : "";
  return fmt::format("{} has a factor of {:.7g}{}", what, *cause.found,
                     cause.kind != CauseKind::units ? ""
                     : unit.empty()                 ? " (units)"
                                                    : " (" + unit + ")");
}

std::string orderWords(const NamedCause& cause) {
  std::string out;
  for (std::size_t i = 0; i < cause.legs.size(); ++i)
    if (cause.legs[i] != static_cast<int>(i) + 1)
      out += fmt::format("{}column {} holds motor {}", out.empty() ? "" : ", ", i + 1, cause.legs[i]);
  for (std::size_t i = 0; i < cause.signs.size(); ++i)
    if (cause.signs[i] < 0) out += fmt::format("{}column {} has the wrong sign", out.empty() ? "" : ", ", i + 1);
  const char* of = cause.term.empty() ? "the motors" : "the motors' accelerations";
  return of + std::string(" are in another order: ") + out;
}

std::string causeWords(const NamedCause& cause) {
  switch (cause.kind) {
    case CauseKind::parameter:
      return parameterWords(cause);
    case CauseKind::closure:
      return closureWords(cause.term);
    case CauseKind::scale:
    case CauseKind::units:
      return scaleWords(cause);
    case CauseKind::order:
      return orderWords(cause);
    case CauseKind::sign:
      if (cause.body == "all" && cause.term.empty()) return "the sign of every effort is wrong";
      return "the sign of " + termWords(cause.term) + ofOwner(cause) + " is wrong";
    case CauseKind::missing_term:
      return termWords(cause.term) + ofOwner(cause) + " is left out";
    case CauseKind::frame:
      return termWords(cause.term) + ofOwner(cause) + " is in the wrong frame";
    case CauseKind::reference_point:
      return (cause.term.empty() ? "the mass centre" : termWords(cause.term)) + ofOwner(cause) +
             " is about the wrong point";
    case CauseKind::offset:
      return "a constant offset" + ofOwner(cause) +
             (cause.found ? fmt::format(" of {:.6g} {}", *cause.found, cause.unit) : "");
    case CauseKind::delay:
      return fmt::format("the efforts are {:.6g} ms {}", 1000 * std::abs(*cause.found),
                         *cause.found > 0 ? "late" : "early");
    default:
      return name(cause.kind);
  }
}

}  // namespace

std::string inWords(const Fitted& cause) {
  return causeWords(cause.named) + (cause.detail.empty() ? "" : " (" + cause.detail + ")");
}

}  // namespace ursula::mechanisms
