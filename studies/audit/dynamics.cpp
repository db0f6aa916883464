// (28)–(31), (34), (35), (38), (45): Newton–Euler for every body, compared with differences of momentum.

#include <Eigen/Geometry>

#include "studies/audit/formula.h"

namespace ursula::audit {
namespace {

Values overBodies(const ReferenceState& at, const std::function<Vector6<S>(const ReferenceBody&)>& side) {
  Values all;
  for (const ReferenceBody& body : at.bodies) append(all, side(body));
  return all;
}

/// M ṫ + W M t
Vector6<S> inertiaWrench(const ReferenceBody& body) {
  return stack(body.I * body.omega_dot + crossMatrix(body.omega) * V(body.I * body.omega), body.mass * body.c_ddot);
}

Vector6<S> momentumRate(const ReferenceBody& body) { return body.momentumRate(); }

Formula newtonEuler() {
  Formula f;
  f.equation = "(28)";
  f.printed = "M t = −WMt + w";
  f.holds = "M ṫ = −WMt + w";
  f.unit = "N m, N";
  f.that_holds = [](const ReferenceState& at) { return overBodies(at, inertiaWrench); };
  f.truth = [](const ReferenceState& at) { return overBodies(at, momentumRate); };
  f.note = "The dot over t is missing: dimensions do not match.";
  f.misprint = true;
  return f;
}

/// The remark below (29), with W's lower block zero, compared with axes of B.
Formula bodyAxes() {
  Formula f;
  f.equation = "text by (29)";
  f.printed = "(28) with W = diag(Ω, 0) is written in a frame fixed to the body";
  f.holds = "… in axes of ℬ, or in axes of the body with W = diag(Ω, Ω)";
  f.unit = "N";
  const auto reading = [](bool whole) {
    return overLegs([whole](const ReferenceState&, const ReferenceLeg& leg) {
      // m d(Gᵀċ)/dt, plus ω × m Gᵀċ with Ω in the lower block.
      const M G = leg.at.G(), G_dot = leg.dot.G();
      const V momentum = leg.m_proximal * V(G.transpose() * leg.dot.c());
      const V rate = leg.m_proximal * V(G_dot.transpose() * leg.dot.c() + G.transpose() * leg.ddot.c());
      const V omega = G.transpose() * vect(G_dot * G.transpose());
      return values(whole ? V(rate + omega.cross(momentum)) : rate);
    });
  };
  f.as_printed = reading(false);
  f.that_holds = reading(true);
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(V(leg.m_proximal * (leg.at.G().transpose() * leg.ddot.c())));
  });
  f.note =
      "Read as components along axes of the body; force rows of the proximal links. (38), (45) and (46) are in axes of "
      "ℬ, and so hold.";
  return f;
}

Formula allBodies() {
  Formula f;
  f.equation = "(31)";
  f.printed = "d(Mt)/dt = −WMt + w^W + w^N";
  f.holds = "M ṫ = −WMt + w^W + w^N";
  f.unit = "N m, N";
  f.as_printed = [](const ReferenceState& at) {
    return overBodies(at, [](const ReferenceBody& body) {
      const V gyroscopic = crossMatrix(body.omega) * V(body.I * body.omega);
      return Vector6<S>(body.momentumRate() + stack(gyroscopic, V(V::Zero())));
    });
  };
  f.that_holds = [](const ReferenceState& at) { return overBodies(at, inertiaWrench); };
  f.truth = [](const ReferenceState& at) { return overBodies(at, momentumRate); };
  f.note = "In our source the dot spans Mt. Read so, in axes of ℬ, ω × Iω is counted twice.";
  f.misprint = true;
  return f;
}

Formula typographical(const char* equation, const char* printed, const char* holds, const char* note) {
  Formula f;
  f.equation = equation;
  f.printed = printed;
  f.holds = holds;
  f.note = note;
  f.misprint = true;
  return f;
}

Formula inertiaWrenches() {
  Formula f;
  f.equation = "(38)";
  f.printed = "wⁿ = [−ω × Iω − Iω̇; −m c̈] = −Mṫ − WMt";
  f.unit = "N m, N";
  f.as_printed = [](const ReferenceState& at) {
    return overBodies(at, [](const ReferenceBody& body) {
      return stack(-body.omega.cross(V(body.I * body.omega)) - body.I * body.omega_dot, -body.mass * body.c_ddot);
    });
  };
  f.truth = [](const ReferenceState& at) {
    return overBodies(at, [](const ReferenceBody& body) { return Vector6<S>(-body.momentumRate()); });
  };
  return f;
}

}  // namespace

std::vector<Formula> dynamicsFormulas() {
  return {newtonEuler(),
          typographical("text by (28)", "t = [wᵀ, ċᵀ]ᵀ", "t = [ωᵀ, ċᵀ]ᵀ", "A letter: w is the wrench."),
          bodyAxes(),
          allBodies(),
          typographical("(34)", "I φ̇ + C φ̇ = Tᵀw^W", "I φ̈ + C φ̇ = Tᵀw^W",
                        "A dot is missing: dimensions do not match. (36) has it."),
          typographical("(35)", "\"w^N can be decomposed as\" w^W = w^a + w^g + w^d", "w^W can be decomposed",
                        "The sentence names the wrench of the constraints, the formula the working wrench."),
          inertiaWrenches(),
          typographical("text by (45)", "w_i^g = [0ᵀ, m gᵀ], w_M^g = [0ᵀ, m gᵀ]", "(w_i^g)ᵀ = [0ᵀ, m gᵀ], …",
                        "A row stands for a column; w_{6+i}^g beside them has the transpose.")};
}

}  // namespace ursula::audit
