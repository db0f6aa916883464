// Inverse and direct dynamics by two formulations: the solver's, which never forms T, and (37) and (34) with the whole
// T. The power balance, which does not need T, checks both.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <iostream>

#include "base/real50.h"
#include "nocsolver/noc/noc.h"
#include "tests/model/derivatives.h"
#include "tests/nocsolver/newton_euler.h"
#include "tests/nocsolver/rounding.h"
#include "tests/support/motions.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

/// Both formulations to the torques at one motion.
template <class S>
struct Engines {
  Vector6<S> torques, assembled;
  Matrix6<S> T_P, M_P, inertia;
  NocWorkspace<S> work;
  double relative_limit, torque_limit;  ///< N·m

  template <class R = Corrected>
  Engines(const Manipulator& manipulator, const Motion<S>& motion, R reading = R{}) {
    const Noc<S, R> solver(manipulator, reading);
    torques = solver.inverseDynamics(motion, work);
    M_P = solver.massMatrixAtP(motion, work);
    const Noc<S> right(manipulator);
    BodyMotions<S> bodies;
    right.inverseKinematics(motion, work);
    right.jacobians(motion, work);
    right.bodyMotions(motion, work, bodies);
    right.twistShaping(motion, work);
    const TwistShaping<S>& T = work.T;
    T_P = right.platformShaping(work);
    assembled = -T.transpose() * generalizedWrench(manipulator, bodies, right.rates(work));  // (37)
    inertia = generalizedInertia(manipulator, bodies, T);
    relative_limit = roundingLimit(right, work);
    torque_limit = relative_limit * static_cast<double>(wrenchScale(manipulator, bodies, right.rates(work), T));
  }

  double torqueError() const { return static_cast<double>(S((torques - assembled).norm())); }
};

Vector6d twistRateOf(const Motion<double>& motion) {
  Vector6d out;
  out << motion.omega_dot, motion.p_ddot;
  return out;
}

class Dynamics : public testing::TestWithParam<std::string> {
 protected:
  Dynamics() {
    ManipulatorParameters parameters = vectorScenario(GetParam()).manipulator->parameters();
    for (Leg& leg : parameters.legs) {  // smoothed so much that it is not just the rate's sign
      leg.coulomb.phi = 3, leg.coulomb.psi = 5, leg.coulomb.theta = 7;
      leg.coulomb.smoothing_speed = 0.5;
    }
    with_coulomb_ = std::make_unique<const Manipulator>(parameters);
  }
  Scenario scenario_ = vectorScenario(GetParam());
  std::unique_ptr<const Manipulator> with_coulomb_;
  SeededDraws dice_{11};
};

TEST_P(Dynamics, inverseIsTheProductWithTheAssembledT) {
  double worst = 0;
  for (int k = 0; k < 20; ++k) {
    const Motion<double> motion = randomState(scenario_, dice_);
    for (const Manipulator* manipulator : {scenario_.manipulator.get(), with_coulomb_.get()}) {
      const Engines<double> engines(*manipulator, motion);
      EXPECT_LE(engines.torqueError(), engines.torque_limit);
      worst = std::max(worst, engines.torqueError() / engines.torques.norm());
    }
  }
  std::cout << "relative to the torques, in doubles: " << worst << '\n';
}

TEST_P(Dynamics, inverseIsThatProductIn50DigitsToo) {
  const auto trajectory = tumbling(scenario_, 5);  // its orientation is exact to 50 digits
  const Engines<Real50> engines(*with_coulomb_, trajectory->at(Real50(0.3 * trajectory->duration())));
  EXPECT_LE(engines.torqueError(), engines.torque_limit);
  EXPECT_LE(engines.torque_limit, 1e-36) << "the limit has lost its meaning";
}

/// Controls: each omission makes a difference of more than a tenth of a newton metre.
TEST_P(Dynamics, aTermLeftOutIsSeen) {
  const Motion<double> motion = randomState(scenario_, dice_);
  for (const FormulaError formula_error :
       {FormulaError::eq16, FormulaError::eq17, FormulaError::eq23, FormulaError::eq43b_doubled, FormulaError::eq47,
        FormulaError::drop_gyroscopic_legs, FormulaError::drop_platform_centripetal, FormulaError::drop_gravity_legs,
        FormulaError::drop_gravity_platform, FormulaError::drop_friction}) {
    const Engines<double> engines(*with_coulomb_, motion, WithFormulaErrors(formula_error));
    EXPECT_GT(engines.torqueError(), 0.1) << "error " << static_cast<int>(formula_error);
    EXPECT_GT(0.1, 1e3 * engines.torque_limit);
  }
}

TEST_P(Dynamics, aLoadIsCarriedByTheTransposedJacobian) {
  const Noc<double> solver(*scenario_.manipulator);
  NocWorkspace<double> work;
  const Motion<double> motion = randomState(scenario_, dice_);
  Vector6d load;
  load << dice_.vector(300), dice_.vector(2000);
  const Vector6d without = solver.inverseDynamics(motion, work);
  const Vector6d change = solver.inverseDynamics(motion, work, load) - without;
  const Vector6d expected = -solver.platformShaping(work).transpose() * load;
  EXPECT_LE((change - expected).norm(), roundingLimit(solver, work) * (without.norm() + expected.norm()));
  EXPECT_GT(expected.norm(), 1);
}

/// An error δτ of the torques causes an error of M_P⁻¹ T_P⁻ᵀ δτ in the accelerations.
TEST_P(Dynamics, directUndoesInverse) {
  double worst = 0;
  for (int k = 0; k < 20; ++k) {
    const Motion<double> motion = randomState(scenario_, dice_);
    Vector6d load;
    load << dice_.vector(300), dice_.vector(2000);
    const Noc<double> solver(*with_coulomb_);
    NocWorkspace<double> work;
    const Vector6d torques = solver.inverseDynamics(motion, work, load);
    const Engines<double> engines(*with_coulomb_, motion);
    Motion<double> unread = motion;
    unread.omega_dot.setConstant(std::nan(""));  // it must ignore accelerations in the motion
    unread.p_ddot.setConstant(std::nan(""));
    const Vector6d found = solver.directDynamics(unread, torques, work, load);
    const double error = (found - twistRateOf(motion)).norm();
    const double response = (engines.M_P.inverse() * engines.T_P.inverse().transpose()).norm();
    EXPECT_LE(error, response * (engines.torque_limit + engines.relative_limit * engines.T_P.norm() * load.norm()));
    worst = std::max(worst, error / twistRateOf(motion).norm());
    const Vector6d other = solver.directDynamics(unread, Vector6d(1.001 * torques), work, load);
    EXPECT_GT((other - found).norm(), 1e-4);
  }
  std::cout << "direct(inverse), relative to the accelerations: " << worst << '\n';
}

TEST_P(Dynamics, massMatrixIsTheAssembledOneAtP) {
  for (int k = 0; k < 10; ++k) {
    const Engines<double> engines(*scenario_.manipulator, randomState(scenario_, dice_));
    const Matrix6d projected = engines.T_P.transpose() * engines.M_P * engines.T_P;
    const double scale = engines.M_P.norm() * engines.T_P.squaredNorm();
    EXPECT_LE((projected - engines.inertia).norm(), engines.relative_limit * scale);
    EXPECT_GT(engines.inertia.norm(), 1e6 * engines.relative_limit * scale) << "the limit has lost its meaning";
    EXPECT_LE((engines.M_P - engines.M_P.transpose()).norm(), engines.relative_limit * engines.M_P.norm());
    EXPECT_EQ(engines.M_P.llt().info(), Eigen::Success);
    EXPECT_GT(engines.M_P.ldlt().vectorD().minCoeff(), 0);
  }
}

/// Kinetic and potential energy of 13 bodies, J.
Real50 energy(const Manipulator& manipulator, const BodyMotions<Real50>& bodies) {
  Real50 sum = 0;
  for (int b = 0; b < body_count; ++b) {
    const Inertia<Real50> inertia = inertiaOf<Real50>(manipulator, b);
    const BodyMotion<Real50>& body = bodies[static_cast<std::size_t>(b)];
    const Vector3<Real50> spin = body.R.transpose() * body.twist.head<3>();
    sum +=
        (spin.dot(Vector3<Real50>(inertia.about_center * spin)) + inertia.mass * body.twist.tail<3>().squaredNorm()) /
        2;
    sum -= inertia.mass * manipulator.gravity().cast<Real50>().dot(body.c);
  }
  return sum;
}

Real50 dissipation(const Manipulator& manipulator, const JointVariables<Real50>& rates) {
  Real50 sum = 0;
  for (int i = 0; i < leg_count; ++i) {
    const Leg& leg = manipulator.leg(i);
    const double speed = leg.coulomb.smoothing_speed;
    sum -= rates.phi(i) * frictionTorque(leg.friction.phi, leg.coulomb.phi, speed, rates.phi(i)) +
           rates.psi(i) * frictionTorque(leg.friction.psi, leg.coulomb.psi, speed, rates.psi(i)) +
           rates.theta(i) * frictionTorque(leg.friction.theta, leg.coulomb.theta, speed, rates.theta(i));
  }
  return sum;
}

/// τᵀφ̇ = d(energy)/dt + dissipation, the derivative by a central difference.
TEST_P(Dynamics, powerOfTheTorquesBecomesEnergyAndHeat) {
  const auto trajectory = tumbling(scenario_, 3);
  const Noc<Real50> solver(*with_coulomb_);
  NocWorkspace<Real50> work;
  const auto energyAt = [&](const Real50& t) {
    BodyMotions<Real50> bodies;
    const Motion<Real50> motion = trajectory->at(t);
    solver.inverseKinematics(motion, work);
    solver.bodyMotions(motion, work, bodies);
    return energy(*with_coulomb_, bodies);
  };
  for (const double instant : instantsInside(trajectory->duration(), 3)) {
    const Real50 t(instant);
    const Real50 rate = (energyAt(t + difference_step) - energyAt(t - difference_step)) / (2 * difference_step);
    const Vector6<Real50> torques = solver.inverseDynamics(trajectory->at(t), work);
    const Real50 power = torques.dot(solver.rates(work).phi), heat = dissipation(*with_coulomb_, solver.rates(work));
    const double scale = static_cast<double>(Real50(torques.norm()));
    EXPECT_LE(static_cast<double>(Real50(abs(power - rate - heat))), difference_tolerance * scale);
    EXPECT_GT(static_cast<double>(Real50(abs(power - rate))), 1e-6 * scale) << "without its heat it must not balance";
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, Dynamics, testing::ValuesIn(vectorNames()),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

/// The helix at t_f = 3 s, by position-level kinematics in 60 digits and d'Alembert's principle.
TEST(PaperHelix, hasItsReferenceTorques) {
  const std::array<std::pair<double, std::array<double, 6>>, 3> reference = {
      {{0,
        {1781.1709921149679, -1416.5553895461321, 2766.4777229186097, 110.36097275261635, -1189.076509881727,
         -3764.9416079054001}},
       {1.5,
        {5370.8050099846401, -978.81424077574318, 7797.3749369532718, 3103.9762041999248, 2161.7809306438784,
         -2331.7670319625501}},
       {3,
        {24593.499943682222, 6729.2515146115527, 25065.531685212988, 13373.873533911844, 15845.632576113775,
         3305.8309418147462}}}};
  const Scenario scenario = vectorScenario("paper-helix");
  const Noc<double> solver(*scenario.manipulator);
  NocWorkspace<double> work;
  for (const auto& [t, values] : reference) {
    const Vector6d expected = Eigen::Map<const Vector6d>(values.data());
    const Vector6d torques = solver.inverseDynamics(scenario.trajectory->at(t), work);
    const double error = (torques - expected).norm() / expected.norm();
    std::cout << "t = " << t << " s: " << error << " of the reference torques\n";
    EXPECT_LE(error, 1e-12);
  }
}

}  // namespace
}  // namespace ursula
