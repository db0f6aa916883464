#pragma once

// One formula of the audit: its two versions and the expected values.

#include <functional>
#include <string>
#include <vector>

#include "nocsolver/legs/reading.h"
#include "studies/audit/reference_mechanism.h"

namespace ursula::audit {

/// The components of one side of an equation.
using Values = std::vector<S>;

inline void append(Values& to, const S& value) { to.push_back(value); }
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

using Side = std::function<Values(const ReferenceState&)>;
using LegSide = std::function<Values(const ReferenceState&, const ReferenceLeg&)>;

/// One side of an equation, collected over all legs.
inline Side overLegs(LegSide side) {
  return [side = std::move(side)](const ReferenceState& reference) {
    Values all;
    for (const ReferenceLeg& leg : reference.legs) {
      const Values one = side(reference, leg);
      all.insert(all.end(), one.begin(), one.end());
    }
    return all;
  };
}

struct Formula {
  std::string equation;
  std::string printed;  ///< as printed in our source, in plain text without the leg's index
  std::string holds;    ///< empty if the printed one is correct
  std::string unit;
  Side as_printed;  ///< evaluated with exact input, so that only the formula is under audit
  Side that_holds;  ///< empty if the printed one is correct
  Side truth;       ///< the expected values
  std::string note;
  std::vector<FormulaError> formula_errors;  ///< the same error in the solver, to find its effect on the torques
  bool through_36 = false;                   ///< whether (37) does not use it, so that its effect is found by (36)
  bool misprint = false;  ///< dimensions or types do not match, or a symbol plainly belongs elsewhere
};

/// Velocity and acceleration of B as in (6), (8).
inline V velocityOfB(const ReferenceState& at, const ReferenceLeg& leg) {
  return at.platform.p_dot + crossMatrix(at.platform.omega) * at.platform.Q * leg.b;
}
inline V accelerationOfB(const ReferenceState& at, const ReferenceLeg& leg) {
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
inline S distanceFromAxis(const ReferenceLeg& leg) {
  return leg.s * sin(leg.at.psi() + leg.at.theta()) - leg.l * sin(leg.at.psi());
}

}  // namespace ursula::audit
