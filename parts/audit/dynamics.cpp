// (28)–(31), (34), (35), (38), (45): Newton–Euler for every body, compared with differences of momentum.

#include <Eigen/Geometry>

#include "parts/audit/formula.h"

namespace ursula::audit {
namespace {

/// One side of an equation, collected over all bodies.
Side bodies(Vector6<S> (*side)(const ReferenceBody&)) {
  return [side](At at) {
    Values all;
    for (const ReferenceBody& body : at.bodies) append(all, side(body));
    return all;
  };
}

/// M ṫ + W M t
Vector6<S> inertiaWrench(const ReferenceBody& body) {
  return stack(body.I * body.omega_dot + crossMatrix(body.omega) * V(body.I * body.omega), body.mass * body.c_ddot);
}

/// (31) as printed, where the dot spans Mt.
Vector6<S> withDotOverAll(const ReferenceBody& body) {
  return body.momentumRate() + stack(crossMatrix(body.omega) * V(body.I * body.omega), V(V::Zero()));
}

Vector6<S> inertiaForces(const ReferenceBody& body) {
  return stack(-body.omega.cross(V(body.I * body.omega)) - body.I * body.omega_dot, -body.mass * body.c_ddot);
}

/// m d(Gᵀċ)/dt of the proximal link, plus ω × m Gᵀċ with Ω in the lower block of W.
V inBodyAxes(Of leg, bool with_lower_block) {
  const M G = leg.at.G(), G_dot = leg.dot.G();
  const V momentum = leg.m_proximal * V(G.transpose() * leg.dot.c());
  const V rate = leg.m_proximal * V(G_dot.transpose() * leg.dot.c() + G.transpose() * leg.ddot.c());
  const V omega = G.transpose() * vect(G_dot * G.transpose());
  return with_lower_block ? V(rate + omega.cross(momentum)) : rate;
}

}  // namespace

std::vector<Formula> dynamicsFormulas() {
  const Side momentum_rates = bodies([](const ReferenceBody& body) { return body.momentumRate(); });
  return {{"(28)",
           "N m, N",
           {"M t = −WMt + w", {}},
           {"M ṫ = −WMt + w", bodies(inertiaWrench)},
           momentum_rates,
           "The dot over t is missing: dimensions do not match.",
           {},
           false,
           true},
          misprint("text by (28)", "t = [wᵀ, ċᵀ]ᵀ", "t = [ωᵀ, ċᵀ]ᵀ", "A letter: w is the wrench."),
          {"text by (29)",
           "N",
           {"(28) with W = diag(Ω, 0) is written in a frame fixed to the body",
            legs([](Of leg) { return inBodyAxes(leg, false); })},
           {"… in axes of ℬ, or in axes of the body with W = diag(Ω, Ω)",
            legs([](Of leg) { return inBodyAxes(leg, true); })},
           legs([](Of leg) { return V(leg.m_proximal * (leg.at.G().transpose() * leg.ddot.c())); }),
           "Read as components along axes of the body; force rows of the proximal links. (38), (45) and (46) are in "
           "axes of ℬ, and so hold."},
          {"(31)",
           "N m, N",
           {"d(Mt)/dt = −WMt + w^W + w^N", bodies(withDotOverAll)},
           {"M ṫ = −WMt + w^W + w^N", bodies(inertiaWrench)},
           momentum_rates,
           "In our source the dot spans Mt. Read so, in axes of ℬ, ω × Iω is counted twice.",
           {},
           false,
           true},
          misprint("(34)", "I φ̇ + C φ̇ = Tᵀw^W", "I φ̈ + C φ̇ = Tᵀw^W",
                   "A dot is missing: dimensions do not match. (36) has it."),
          misprint("(35)", "\"w^N can be decomposed as\" w^W = w^a + w^g + w^d", "w^W can be decomposed",
                   "The sentence names the wrench of the constraints, the formula the working wrench."),
          {"(38)",
           "N m, N",
           {"wⁿ = [−ω × Iω − Iω̇; −m c̈] = −Mṫ − WMt", bodies(inertiaForces)},
           {},
           bodies([](const ReferenceBody& body) { return Vector6<S>(-body.momentumRate()); })},
          misprint("text by (45)", "w_i^g = [0ᵀ, m gᵀ], w_M^g = [0ᵀ, m gᵀ]", "(w_i^g)ᵀ = [0ᵀ, m gᵀ], …",
                   "A row stands for a column; w_{6+i}^g beside them has the transpose.")};
}

}  // namespace ursula::audit
