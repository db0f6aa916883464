// Rotors, thin rods, spinning rods and mass centres off the links' lines, on legs of all kinds. They are compared with
// d'Alembert's principle in 50 digits, with motions and virtual displacements by differences of poses. It uses no rate,
// Jacobian, tensor or wrench of the solver.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/real50.h"
#include "model/machine_numbers.h"
#include "nocsolver/noc/noc.h"
#include "parts/derivatives/effort_derivatives.h"
#include "parts/fast/batch_dynamics.h"
#include "parts/fast/fast_dynamics.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

using Real = Real50;
using Six = Vector6<Real>;

enum class Added { rotors, rods, spins, off_line, all };

Matrix3d roundTensor(double across, double along) { return Vector3d(across, across, along).asDiagonal(); }

void addTo(Leg& leg, std::size_t i, Added added) {
  const double share = 1 + 0.1 * static_cast<double>(i);
  Link &first = leg.proximal, &second = leg.distal;
  if (added == Added::rotors || added == Added::all)
    for (std::size_t j = 0; j < 3; ++j)
      if (leg.actuated[j]) leg.rotor_inertia.on(rowOf(leg.kind).coordinates[j]) = share * (3 + static_cast<double>(j));
  if (added == Added::rods) {
    if (leg.kind != LegKind::PUS) first.inertia = roundTensor(first.inertia(0, 0), 0);
    second.inertia = roundTensor(second.inertia(0, 0), 0);
  }
  if (added == Added::spins && leg.kind != LegKind::URS) {
    if (leg.kind == LegKind::UPS) first.inertia = roundTensor(first.inertia(0, 0), first.inertia(0, 0));
    second.inertia = roundTensor(second.inertia(0, 0), 1.5 * second.inertia(0, 0));
    leg.spins = true;
  }
  if (added == Added::off_line || added == Added::all) {
    first.off_line = share * Vector3d(0.09, -0.05, 0);
    if (leg.kind == LegKind::PUS) first.off_line = share * Vector3d(0.09, 0, -0.05);
    second.off_line = share * Vector3d(-0.04, 0.11, 0);
  }
}

/// A machine of tests/vectors without friction, with the addition.
ManipulatorParameters machineWith(const std::string& name, Added added) {
  ManipulatorParameters machine = frictionless(*vectorScenario(name).manipulator).parameters();
  for (std::size_t i = 0; i < machine.legs.size(); ++i) addTo(machine.legs[i], i, added);
  return machine;
}

/// A body, with E = ½ tr(I) 1 − I, so that the virtual work of inertia is tr(R̈ E δRᵀ) + m c̈ · δc.
struct Body {
  Real mass;
  Matrix3<Real> E;
};

struct Pose {
  std::array<Vector3<Real>, body_count> c;
  std::array<Matrix3<Real>, body_count> R;
  Six q;
};

Matrix3<Real> secondMoments(const Matrix3d& I) { return (0.5 * I.trace() * Matrix3d::Identity() - I).cast<Real>(); }

class Mechanism {
 public:
  explicit Mechanism(const ManipulatorParameters& machine) : machine_(machine), solver_{Manipulator(machine)} {
    for (Body& body : bodies_) body = {Real(0), Matrix3<Real>::Zero()};
    for (std::size_t i = 0; i < machine.legs.size(); ++i) {
      const Leg& leg = machine.legs[i];
      bodies_[i] = {Real(leg.proximal.mass), secondMoments(leg.proximal.inertia)};
      bodies_[leg_count + i] = {Real(leg.distal.mass), secondMoments(leg.distal.inertia)};
      if (!leg.spins) continue;  // a spinning link's energy is that of its line alone
      const Matrix3<Real> of_line = Vector3<Real>::UnitZ() * Vector3<Real>::UnitZ().transpose();
      if (leg.kind == LegKind::UPS) bodies_[i].E = Real(leg.proximal.inertia(0, 0)) * of_line;
      bodies_[leg_count + i].E = Real(leg.distal.inertia(0, 0)) * of_line;
    }
    bodies_.back() = {Real(machine.platform.mass), secondMoments(machine.platform.inertia)};
  }

  Six efforts(const Trajectory& trajectory, const Real& t) const {
    const Real h("1e-8");
    std::array<Pose, 5> moving;
    for (int k = -2; k <= 2; ++k) moving[static_cast<std::size_t>(k + 2)] = at(trajectory.at(Real(t + k * h)));
    const auto second = [&](const auto& of) {
      return ((-of(moving[0]) + Real(16) * of(moving[1]) - Real(30) * of(moving[2]) + Real(16) * of(moving[3]) -
               of(moving[4])) /
              (Real(12) * h * h))
          .eval();
    };
    Pose acceleration;
    acceleration.q = second([](const Pose& pose) { return pose.q; });
    for (std::size_t b = 0; b < body_count; ++b) {
      acceleration.c[b] = second([b](const Pose& pose) { return pose.c[b]; });
      acceleration.R[b] = second([b](const Pose& pose) { return pose.R[b]; });
    }
    Matrix6<Real> by_q;
    Six work;
    for (int k = 0; k < 6; ++k) {
      const Pose moved = displaced(trajectory.at(t), k, h);
      by_q.row(k) = moved.q.transpose();
      work(k) = workOf(acceleration, moved);
    }
    return by_q.partialPivLu().solve(work);
  }

 private:
  Pose at(const Motion<Real>& motion) const {
    NocWorkspace<Real> work;
    solver_.displacements(motion, work);
    Pose out;
    out.c.fill(Vector3<Real>::Zero());
    out.R.fill(Matrix3<Real>::Identity());
    for (std::size_t i = 0; i < machine_.legs.size(); ++i) {
      const Leg& leg = machine_.legs[i];
      const LegState<Real>& placed = work.legs[i];
      const Vector3<Real> A = leg.base_point.cast<Real>();
      out.R[i] = placed.R_1;
      out.R[leg_count + i] = placed.R_2;
      out.c[i] = A + placed.O_1 + placed.R_1 * leg.proximalCenter().cast<Real>();
      out.c[leg_count + i] = A + placed.O_2 + placed.R_2 * leg.distalCenter().cast<Real>();
    }
    out.R.back() = motion.Q;
    out.c.back() = motion.p + motion.Q * machine_.platform.center_of_mass.cast<Real>();
    out.q = solver_.angles(work).driven(solver_.machine().motors);
    return out;
  }

  /// The pose displaced by a turn about an axis through P, or along one.
  Pose displaced(const Motion<Real>& motion, int k, const Real& h) const {
    const auto by = [&](int steps) {
      Motion<Real> there = motion;
      const Vector3<Real> e = Vector3<Real>::Unit(k % 3) * (steps * h);
      if (k >= 3) {
        there.p += e;
      } else {
        Matrix3<Real> half;  // Cayley's map
        half << Real(0), -e.z() / 2, e.y() / 2, e.z() / 2, Real(0), -e.x() / 2, -e.y() / 2, e.x() / 2, Real(0);
        const Matrix3<Real> one = Matrix3<Real>::Identity();
        there.Q = Matrix3<Real>(one - half).inverse() * (one + half) * motion.Q;
      }
      return at(there);
    };
    const std::array<Pose, 4> poses = {by(-2), by(-1), by(1), by(2)};
    const auto first = [&](const auto& of) {
      return ((of(poses[0]) - Real(8) * of(poses[1]) + Real(8) * of(poses[2]) - of(poses[3])) / (Real(12) * h)).eval();
    };
    Pose out;
    out.q = first([](const Pose& pose) { return pose.q; });
    for (std::size_t b = 0; b < body_count; ++b) {
      out.c[b] = first([b](const Pose& pose) { return pose.c[b]; });
      out.R[b] = first([b](const Pose& pose) { return pose.R[b]; });
    }
    return out;
  }

  Real workOf(const Pose& acceleration, const Pose& moved) const {
    const Vector3<Real> g = machine_.gravity.cast<Real>();
    Real out = 0;
    for (std::size_t b = 0; b < body_count; ++b)
      out += bodies_[b].mass * (acceleration.c[b] - g).dot(moved.c[b]) +
             (acceleration.R[b] * bodies_[b].E * moved.R[b].transpose()).trace();
    for (int m = 0; m < motor_count; ++m) {
      const Motor& motor = solver_.machine().motors[static_cast<std::size_t>(m)];
      const double rotor = machine_.legs[static_cast<std::size_t>(motor.leg)].rotor_inertia.on(motor.coordinate);
      out += Real(rotor) * acceleration.q(m) * moved.q(m);
    }
    return out;
  }

  ManipulatorParameters machine_;
  Noc<Real> solver_;
  std::array<Body, body_count> bodies_;
};

double apart(const Six& found, const Six& expected) {
  return static_cast<double>(Real((found - expected).norm() / expected.norm()));
}

class AddedInertia : public testing::TestWithParam<std::tuple<std::string, Added>> {
 protected:
  const std::string& name() const { return std::get<0>(GetParam()); }
  Added added() const { return std::get<1>(GetParam()); }
  std::vector<VectorRow> rows_ = vectorRows(name());
  ManipulatorParameters parameters_ = machineWith(name(), added());
  Manipulator machine_{parameters_};
  Scenario scenario_ = vectorScenario(name());
};

/// Differences of fourth order with step 1e-8 have errors of some 1e-32, with derivatives up to 1e6 times the motion's;
/// rounding is 1e-34.
TEST_P(AddedInertia, effortsAreThoseOfDAlembertsPrinciple) {
  const Noc<Real> solver(machine_), plain(frictionless(*scenario_.manipulator));
  const Mechanism mechanism(parameters_);
  NocWorkspace<Real> work;
  for (const std::size_t row : {1u, 3u}) {
    const Motion<Real> motion = scenario_.trajectory->at(rows_[row].motion.t);
    const Six expected = mechanism.efforts(*scenario_.trajectory, motion.t);
    EXPECT_LE(apart(solver.inverseDynamics(motion, work), expected), 1e-22);
    if (added() != Added::spins || name().find("urs") == std::string::npos) {
      EXPECT_GT(apart(plain.inverseDynamics(motion, work), expected), 1e-9);
    }
  }
}

TEST_P(AddedInertia, directDynamicsAndReactionsGoWithThem) {
  const Noc<Real> solver(machine_);
  const FastDynamics<Real> fast(machine_);
  NocWorkspace<Real> work;
  for (const VectorRow& row : rows_) {
    const Six efforts = solver.inverseDynamics(row.motion, work);
    const BodyVector<Real> w_N = solver.constraintWrench(row.motion, efforts, work);
    EXPECT_LE(static_cast<double>(Real((work.T.transpose() * w_N).norm())),
              1e-38 * static_cast<double>(Real(w_N.norm() * work.T.norm())));
    const Matrix6<Real> T_P = solver.platformShaping(work), M_P = solver.massMatrixAtP(row.motion, work);
    const Matrix6<Real> I = solver.I(work);
    EXPECT_LE(static_cast<double>(Real((I - T_P.transpose() * M_P * T_P).norm() / I.norm())), 1e-38);
    Six expected;
    expected << row.motion.omega_dot, row.motion.p_ddot;
    EXPECT_LE(apart(fast.inverseDynamics(row.motion), efforts), 1e-38);
    EXPECT_LE(apart(solver.directDynamics(row.motion, efforts, work), expected), 1e-32);
    EXPECT_LE(apart(fast.directDynamics(row.motion, efforts), expected), 1e-32);
    EXPECT_GT(apart(fast.directDynamics(row.motion, Real("1.000001") * efforts), expected), 1e-12);
  }
}

TEST_P(AddedInertia, everyInstructionSetHasThem) {
  const FastDynamics<Real> exact(machine_);
  for (const InstructionSet set :
       {InstructionSet::portable, InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!isSupported(set)) continue;
    const FastDynamics<double> single(machine_, set);
    const BatchDynamics batch(machine_, set);
    std::vector<Motion<double>> motions;
    for (const VectorRow& row : rows_) motions.push_back(rounded(row.motion));
    std::vector<Vector6d> efforts(motions.size()), rates(motions.size());
    std::vector<PoseFault> faults(motions.size());
    batch.inverseDynamics(motions.data(), motions.size(), efforts.data(), faults.data());
    batch.directDynamics(motions.data(), efforts.data(), motions.size(), rates.data(), faults.data());
    for (std::size_t k = 0; k < motions.size(); ++k) {
      Vector6d rate;
      rate << motions[k].omega_dot, motions[k].p_ddot;
      const Vector6d expected = exact.inverseDynamics(rows_[k].motion).cast<double>();
      EXPECT_LE((efforts[k] - expected).norm(), 1e-11 * expected.norm());
      EXPECT_LE((single.inverseDynamics(motions[k]) - expected).norm(), 1e-11 * expected.norm());
      EXPECT_LE((rates[k] - rate).norm(), 1e-9 * (1 + rate.norm()));
      EXPECT_LE((single.directDynamics(motions[k], efforts[k]) - rate).norm(), 1e-9 * (1 + rate.norm()));
    }
  }
}

/// Derivatives are compared with differences in 50 digits; efforts are linear in a rotor's inertia and quadratic in a
/// mass centre's place.
TEST_P(AddedInertia, derivativesAndRegressorHaveThem) {
  const EffortDerivatives of(machine_);
  const Motion<double> at = rounded(rows_[3].motion);
  const EffortDerivatives::Columns found = of.byParameters(at);
  const std::vector<MachineNumber> numbers = machineNumbers(machine_.parameters());
  const Vector6d efforts = FastDynamics<double>(machine_).inverseDynamics(at);
  int seen = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (numbers[k].group() != NumberGroup::rotor && numbers[k].quantity != Quantity::center_across) continue;
    const auto with = [&](double by) {
      ManipulatorParameters changed = machine_.parameters();
      numbers[k].set(changed, numbers[k].get(changed) + by);
      return FastDynamics<Real>(Manipulator(changed)).inverseDynamics(exactly(at));
    };
    const double h = 0x1p-20;
    const Vector6d expected = Six((with(h) - with(-h)) / Real(2 * h)).cast<double>();
    EXPECT_LE((found.col(static_cast<Eigen::Index>(k)) - expected).norm(), 1e-11 * efforts.norm()) << numbers[k].path;
    seen += expected.norm() > 1e-6 * efforts.norm() ? 1 : 0;
  }
  const int least = added() == Added::rotors     ? motor_count - 1  // some coordinate hardly accelerates then
                    : added() == Added::off_line ? 2 * machine_.legCount()
                                                 : 0;
  EXPECT_GE(seen, least);
  const EffortDerivatives::Columns Y = of.regressor(at);
  EXPECT_LE((Y * of.regressorValues() - efforts).norm(), 1e-11 * efforts.norm());
}

TEST(AddedInertiaOfRotors, aWrongRotorIsSeen) {
  const std::string name = kindNames().front();
  const Manipulator machine(machineWith(name, Added::rotors));
  const Motion<double> motion = rounded(vectorRows(name)[2].motion);
  NocWorkspace<double> work;
  const Vector6d right = Noc<double>(machine).inverseDynamics(motion, work);
  const WrongNoc<double> without(machine, WithFormulaErrors(FormulaError::drop_rotor));
  EXPECT_GT((without.inverseDynamics(motion, work) - right).norm(), 1e-6 * right.norm());
  const Vector6d direct = Noc<double>(machine).directDynamics(motion, right, work);
  EXPECT_GT((without.directDynamics(motion, right, work) - direct).norm(), 1e-6 * direct.norm());
  EXPECT_GT((without.massMatrixAtP(motion, work) - Noc<double>(machine).massMatrixAtP(motion, work)).norm(), 1e-6);
}

const auto asName = [](const auto& info) {
  constexpr std::array<const char*, 5> words = {"rotors", "rods", "spins", "off_line", "all"};
  return asTestName(std::get<0>(info.param)) + "_" + words[static_cast<std::size_t>(std::get<1>(info.param))];
};

INSTANTIATE_TEST_SUITE_P(Machines, AddedInertia,
                         testing::Combine(testing::ValuesIn(kindNames()),
                                          testing::Values(Added::rotors, Added::rods, Added::spins, Added::off_line,
                                                          Added::all)),
                         asName);

}  // namespace
}  // namespace ursula
