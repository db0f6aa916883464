#pragma once

// One formula of the audit: its two versions and the expected values.

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "nocsolver/legs/reading.h"
#include "parts/audit/reference_mechanism.h"

namespace ursula::audit {

/// The components of one side of an equation.
using Values = std::vector<S>;

inline void append(Values& to, const S& value) { to.push_back(value); }
inline void append(Values& to, const Values& more) { to.insert(to.end(), more.begin(), more.end()); }
template <class Derived>
void append(Values& to, const Eigen::MatrixBase<Derived>& matrix) {
  const typename Derived::PlainObject plain = matrix;
  to.insert(to.end(), plain.data(), plain.data() + plain.size());
}
template <class... Parts>
Values values(const Parts&... parts) {
  Values all;
  (append(all, parts), ...);
  return all;
}

using At = const ReferenceState&;
using Of = const ReferenceLeg&;
using Side = std::function<Values(At)>;

/// One side of an equation, collected over all legs. `side(leg)` or `side(at, leg)` is a number, a vector or a matrix.
template <class F>
Side legs(F side) {
  return [side](At at) {
    Values all;
    for (Of leg : at.legs)
      if constexpr (std::is_invocable_v<F, Of>)
        append(all, side(leg));
      else
        append(all, side(at, leg));
    return all;
  };
}

/// A formula's text, in plain text without the leg's index, and its value with exact input, so that only the formula is
/// under audit.
struct Reading {
  std::string text;
  Side side;
};

struct Formula {
  std::string equation;
  std::string unit;
  Reading printed;  ///< as printed in our source
  Reading holds;    ///< empty if the printed one is correct
  Side truth;       ///< the expected values
  std::string note = "";
  std::vector<FormulaError> errors = {};  ///< the same error in the solver, to find its effect on the torques
  bool only_in_36 = false;                ///< whether (37) does not use it, so that its effect is found by (36)
  bool misprint = false;                  ///< dimensions or types do not match, or a symbol plainly belongs elsewhere
};

/// A misprint that has no value.
inline Formula misprint(const char* equation, const char* printed, const char* holds, const char* note) {
  return {equation, "", {printed, {}}, {holds, {}}, {}, note, {}, false, true};
}

/// Velocity and acceleration of B as in (6), (8).
inline V velocityOfB(At at, Of leg) {
  return at.platform.p_dot + crossMatrix(at.platform.omega) * at.platform.Q * leg.b;
}
inline V accelerationOfB(At at, Of leg) {
  const M Omega = crossMatrix(at.platform.omega);
  return at.platform.p_ddot + (crossMatrix(at.platform.omega_dot) + Omega * Omega) * at.platform.Q * leg.b;
}

std::vector<Formula> displacementFormulas();
std::vector<Formula> rateFormulas();
std::vector<Formula> accelerationFormulas();
std::vector<Formula> jacobianFormulas();
std::vector<Formula> bodyFormulas();
std::vector<Formula> dynamicsFormulas();
std::vector<Formula> complementFormulas(const Manipulator& manipulator);
std::vector<Formula> appendixFormulas();

inline Vector6<S> stack(const V& angular, const V& linear) {
  Vector6<S> six;
  six << angular, linear;
  return six;
}

/// The signed distance of B from the axis of φ, m.
inline S distanceFromAxis(Of leg) { return leg.s * sin(leg.at.psi() + leg.at.theta()) - leg.l * sin(leg.at.psi()); }

}  // namespace ursula::audit
