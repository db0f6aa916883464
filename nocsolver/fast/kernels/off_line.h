#pragma once

// Terms of mass centres off their links' lines, added to leg_forces.h and plane_mass.h. Internal.
//
// Those files place each mass m at ρ from the first end on the line. Let o lead from there to the mass centre. b is
// the point's acceleration minus g; V and W are the partial velocities of the point and of the link's ω:
//   Q = Vᵀ m a_o + Wᵀ (o × m (b + a_o)),  a_o = ω̇ × o + ω × (ω × o)                                             (a)
//   M = m (VᵀU + UᵀV + UᵀU),  the columns of U those of W each × o                                             (b)
// All vectors are along x, u, z of the leg's plane (for RUS the rod's). There ω̇ is W q̈ plus the term from the
// rotation of x.

#include <Eigen/Geometry>
#include <array>

#include "nocsolver/fast/kernels/plane_leg.h"

namespace ursula::kernel {

template <class S>
struct OffLink {
  S mass;
  Vector3<S> o, omega, omega_dot, b;
  Matrix3<S> W, V;
};

/// W, and ω with its rate.
template <class S>
struct OffTurn {
  Matrix3<S> W;
  Vector3<S> omega, omega_dot;
};

/// `before` is the motion of the link's first end: b and V. The link's frame is [x, r × x, r].
template <class S>
struct OffEnd {
  Vector3<S> b;
  Matrix3<S> V;

  OffEnd along(const OffTurn<S>& turn, const Vector3<S>& arm) const {
    OffEnd out{b + turn.omega_dot.cross(arm) + turn.omega.cross(turn.omega.cross(arm)), V};
    for (int j = 0; j < 3; ++j) out.V.col(j) += Vector3<S>(turn.W.col(j)).cross(arm);
    return out;
  }
  OffLink<S> link(const S& mass, const Vector3<S>& off, const Vector3<S>& x, const Vector3<S>& r, const S& distance,
                  const OffTurn<S>& turn) const {
    const OffEnd at = along(turn, distance * r);
    return {mass, off.x() * x + off.y() * r.cross(x), turn.omega, turn.omega_dot, at.b, turn.W, at.V};
  }
};

/// The columns of W are multiples of −u and x; the rotation of x adds a term to ω̇ along z.
template <class S>
OffTurn<S> offTurn(const PlaneLeg<S>& leg, const Vector3<S>& about_minus_u, const Vector3<S>& about_x) {
  OffTurn<S> out;
  out.W << about_x.transpose(), -about_minus_u.transpose(), Vector3<S>::Zero().transpose();
  out.omega = out.W * leg.rate;
  out.omega_dot = out.W * leg.acceleration;
  out.omega_dot.z() -= out.omega.x() * out.omega.y();  // ẋ = −α̇ u × x = α̇ z
  return out;
}

template <class S>
using OffLinks = std::array<OffLink<S>, 2>;

template <class S>
OffLinks<S> offLinks(Ups, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const Vector3<S> x = Vector3<S>::UnitX(), e(S(0), leg.C_1, leg.S_1);
  const OffTurn<S> turn = offTurn<S>(leg, Vector3<S>::UnitX(), Vector3<S>::UnitY());
  const OffEnd<S> A{base, Matrix3<S>::Zero()};
  OffEnd<S> rod{base + leg.acceleration(2) * e + (S(2) * leg.rate(2)) * turn.omega.cross(e), Matrix3<S>::Zero()};
  rod.V.col(2) = e;
  return {A.link(model.mass_1, model.off_1, x, e, model.rho, turn),
          rod.link(model.mass_2, model.off_2, x, e, leg.d - model.s + model.sigma, turn)};
}

template <class S>
OffLinks<S> offLinks(Urs, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const Vector3<S> x = Vector3<S>::UnitX(), e(S(0), leg.C_1, leg.S_1), s(S(0), leg.C_2, leg.S_2);
  const OffTurn<S> first = offTurn<S>(leg, Vector3<S>::UnitX(), Vector3<S>::UnitY());
  const OffTurn<S> second = offTurn<S>(leg, Vector3<S>::UnitX(), Vector3<S>(S(0), S(1), S(1)));
  const OffEnd<S> A{base, Matrix3<S>::Zero()};
  return {A.link(model.mass_1, model.off_1, x, e, model.rho, first),
          A.along(first, model.l * e).link(model.mass_2, model.off_2, x, s, model.sigma, second)};
}

/// A carriage does not turn, so the place of its mass does not matter.
template <class S>
OffLinks<S> offLinks(Pus, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const Vector3<S> x = Vector3<S>::UnitX(), u = Vector3<S>::UnitY(), s(S(0), leg.C_2, leg.S_2);
  const OffTurn<S> none = offTurn<S>(leg, Vector3<S>::Zero(), Vector3<S>::Zero());
  const OffTurn<S> turn = offTurn<S>(leg, Vector3<S>::UnitY(), Vector3<S>::UnitZ());
  OffEnd<S> carriage{base + leg.acceleration(0) * u, Matrix3<S>::Zero()};
  carriage.V.col(0) = u;
  return {carriage.link(model.mass_1, Vector3<S>::Zero(), x, u, S(0), none),
          carriage.link(model.mass_2, model.off_2, x, s, model.sigma, turn)};
}

template <class S>
OffLinks<S> offLinks(Rus, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const Vector3<S> x = Vector3<S>::UnitX(), s(S(0), leg.C_2, leg.S_2);
  const Vector3<S> x_crank(leg.C_1, S(0), -leg.S_1), e(leg.S_1, S(0), leg.C_1);
  const OffTurn<S> crank = offTurn<S>(leg, Vector3<S>::UnitX(), Vector3<S>::Zero());
  const OffTurn<S> rod = offTurn<S>(leg, Vector3<S>(S(1), S(1), S(0)), Vector3<S>(S(0), S(0), S(-1)));
  const OffEnd<S> A{base, Matrix3<S>::Zero()};
  return {A.link(model.mass_1, model.off_1, x_crank, e, model.rho, crank),
          A.along(crank, model.l * e).link(model.mass_2, model.off_2, x, s, model.sigma, rod)};
}

/// (a)
template <class Kind, class S>
Vector3<S> offLineForces(Kind kind, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  Vector3<S> Q = Vector3<S>::Zero();
  for (const OffLink<S>& link : offLinks<S>(kind, model, base, leg)) {
    const Vector3<S> a_o = link.omega_dot.cross(link.o) + link.omega.cross(link.omega.cross(link.o));
    const Vector3<S> f = link.mass * a_o, n = link.o.cross(Vector3<S>(link.mass * link.b + f));
    Q += link.V.transpose() * f + link.W.transpose() * n;
  }
  return Q;
}

/// (b)
template <class Kind, class S>
Matrix3<S> offLineMass(Kind kind, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  Matrix3<S> M = Matrix3<S>::Zero();
  for (const OffLink<S>& link : offLinks<S>(kind, model, Vector3<S>::Zero(), leg)) {
    Matrix3<S> U;
    for (int j = 0; j < 3; ++j) U.col(j) = Vector3<S>(link.W.col(j)).cross(link.o);
    const Matrix3<S> VU = link.V.transpose() * U;
    M += link.mass * (VU + VU.transpose() + U.transpose() * U);
  }
  return M;
}

}  // namespace ursula::kernel
