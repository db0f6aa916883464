// The solver gets another motion than the commanded one.

#include <Eigen/Geometry>

#include "base/angles.h"
#include "studies/prove/defect_helpers.h"

namespace ursula {
std::vector<Defect> motionDefects(const Manipulator&) {
  using M = Motion<double>;
  return {
      wrongMotion("Q transposed", [](M& m) { m.Q.transposeInPlace(); }),
      wrongMotion("degrees for radians in omega",
                  [](M& m) {
                    m.omega *= degrees_per_radian;
                    m.omega_dot *= degrees_per_radian;
                  }),
      wrongMotion("omega in M for omega in B", [](M& m) { m.omega = (m.Q.transpose() * m.omega).eval(); }),
      wrongMotion("omega_dot in M for omega_dot in B",
                  [](M& m) { m.omega_dot = (m.Q.transpose() * m.omega_dot).eval(); }),
      wrongMotion("velocities left out",
                  [](M& m) {
                    m.omega.setZero();
                    m.p_dot.setZero();
                  }),
      wrongMotion("angular acceleration left out", [](M& m) { m.omega_dot.setZero(); }),
      wrongMotion("acceleration of P left out", [](M& m) { m.p_ddot.setZero(); }),
      wrongMotion("accelerations of C for those of P",
                  [](M& m) { m.p_ddot += m.omega_dot.cross(Vector3d(m.Q.col(2))); }),
      wrongMotion("p off by 1e-6 m", [](M& m) { m.p.x() += 1e-6; }),
      wrongMotion("p off by 1e-10 m", [](M& m) { m.p.y() += 1e-10; }),
      wrongMotion("Q turned by 1e-10", [](M& m) { m.Q = (Eigen::AngleAxisd(1e-10, Vector3d::UnitY()) * m.Q).eval(); }),
      wrongMotion("omega off by 1e-8 of itself", [](M& m) { m.omega *= 1 + 1e-8; }),
      wrongMotion("acceleration of P off by 1e-9 of itself", [](M& m) { m.p_ddot *= 1 + 1e-9; }),
      control(wrongMotion("motion: no fault", [](M&) {}))};
}

}  // namespace ursula
