// EffortDerivatives against central differences of FastDynamics in 50 digits, over the machines of tests/vectors (every
// kind of leg, mixtures, friction, several motors on a leg).

#include "parts/derivatives/effort_derivatives.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/real50.h"
#include "model/machine_numbers.h"
#include "parts/fast/fast_dynamics.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/motions.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

constexpr double promised = 1e-12;
using ByState = Eigen::Matrix<double, 6, 18>;
using Six = Vector6<Real50>;

/// exp(h [e_k]×)
Matrix3<Real50> turn(int k, const Real50& h) {
  Matrix3<Real50> out = Matrix3<Real50>::Identity();
  const int a = (k + 1) % 3, b = (k + 2) % 3;
  out(a, a) = out(b, b) = cos(h);
  out(b, a) = sin(h);
  out(a, b) = -out(b, a);
  return out;
}

Motion<Real50> changed(Motion<Real50> motion, int column, const Real50& h) {
  const int k = column % 3;
  if (column < 3)
    motion.Q = turn(k, h) * motion.Q;
  else
    (column < 6    ? motion.p
     : column < 9  ? motion.omega
     : column < 12 ? motion.p_dot
     : column < 15 ? motion.omega_dot
                   : motion.p_ddot)(k) += h;
  return motion;
}

/// A load that stays in B, or turns with the platform.
Six turned(const Six& load, bool turns, int column, const Real50& h) {
  if (!turns || column >= 3) return load;
  Six out;
  const Matrix3<Real50> R = turn(column, h);
  out << R * load.head<3>(), R * load.tail<3>();
  return out;
}

ByState differences(const FastDynamics<Real50>& fast, const Motion<double>& at, const Six& load, bool turns) {
  const Real50 h("1e-16");  // leaves 32 digits
  const Motion<Real50> motion = exactly(at);
  ByState out;
  for (int k = 0; k < 18; ++k) {
    const Six above = fast.inverseDynamics(changed(motion, k, h), turned(load, turns, k, h));
    const Six below = fast.inverseDynamics(changed(motion, k, -h), turned(load, turns, k, -h));
    out.col(k) = Six((above - below) / (2 * h)).cast<double>();
  }
  return out;
}

/// The largest error of a block over its size.
double distance(const ByState& found, const ByState& expected) {
  double out = 0;
  for (int first = 0; first < 18; first += 3) {
    const auto e = expected.middleCols<3>(first);
    out = std::max(out, (found.middleCols<3>(first) - e).norm() / e.norm());
  }
  return out;
}

Six someLoad() {
  Six out;
  out << 3, -5, 2, 40, -30, 70;
  return out;
}

EffortsByState::Block turning(const Vector6d& load) {
  EffortsByState::Block out;
  for (int k = 0; k < 3; ++k)
    out.col(k) << Vector3d::Unit(k).cross(load.head<3>()), Vector3d::Unit(k).cross(load.tail<3>());
  return out;
}

/// Norm of the k-th column, or of all three columns of its vector, because their errors mix.
double sizeOf(const EffortDerivatives::Columns& columns, const MachineNumber& number, std::size_t k) {
  const auto at = static_cast<Eigen::Index>(k);
  return number.entries == 3 ? columns.middleCols(at - number.entry, 3).norm() : columns.col(at).norm();
}

class DerivativesOf : public testing::TestWithParam<std::string> {
 protected:
  const Manipulator& machine() const { return *scenario_.manipulator; }
  Motion<double> motion(std::size_t k) const { return rounded(rows_[k].motion); }

  Scenario scenario_ = vectorScenario(GetParam());
  std::vector<VectorRow> rows_ = vectorRows(GetParam());
};

TEST_P(DerivativesOf, byStateAreTheDifferencesInFiftyDigits) {
  const FastDynamics<Real50> fast(machine());
  const Vector6d load = someLoad().cast<double>();
  for (const std::size_t row : {1u, 3u})
    for (const bool turns : {false, true}) {
      const ByState expected = differences(fast, motion(row), someLoad(), turns);
      const Vector6d efforts = fast.inverseDynamics(exactly(motion(row)), someLoad()).cast<double>();
      const EffortDerivatives of(machine());
      const EffortsByState found = turns ? of.byState(motion(row), load, turning(load)) : of.byState(motion(row), load);
      EXPECT_LE(distance(found.derivatives, expected), promised) << "row " << row;
      EXPECT_LE((found.efforts - efforts).norm(), promised * efforts.norm());
      for (int k = 0; k < 18; ++k) {  // a wrong column is found
        ByState wrong = found.derivatives;
        wrong.col(k) *= 1 + 1e-9;
        if (expected.col(k).norm() > 1e-3 * expected.middleCols<3>(k / 3 * 3).norm()) {
          EXPECT_GT(distance(wrong, expected), promised) << k;
        }
      }
      if (turns) {
        EXPECT_GT(distance(of.byState(motion(row), load).derivatives, expected), 1e-9) << "the turn is seen";
      }
    }
}

TEST_P(DerivativesOf, byStateAllocateNothing) {
  const EffortDerivatives of(machine());
  const Motion<double> at = motion(2);
  EffortsByState found;
  EXPECT_EQ(allocationsIn([&] { found = of.byState(at); }), 0);
  EXPECT_GT(found.derivatives.norm(), 0);
}

TEST_P(DerivativesOf, refuseWhatInverseDynamicsRefuse) {
  const FastDynamics<double> fast(machine(), InstructionSet::portable);
  const EffortDerivatives of(machine());
  SeededDraws dice(11);
  int refused = 0;
  for (int k = 0; k < 200; ++k) {
    Motion<double> at = motion(static_cast<std::size_t>(k) % rows_.size());
    for (int j = 0; j < 3; ++j) at.p(j) += dice.between(-1, 1) * 2;
    if (k == 0) at.p.x() = std::nan("");
    std::string by_fast, by_state, by_parameters;
    const auto words = [](std::string& to, const auto& call) {
      try {
        call();
      } catch (const PoseError& error) {
        to = error.what();
      }
    };
    words(by_fast, [&] { fast.inverseDynamics(at); });
    words(by_state, [&] { of.byState(at); });
    words(by_parameters, [&] { of.byParameters(at); });
    refused += by_fast.empty() ? 0 : 1;
    EXPECT_EQ(by_state.substr(0, 30), by_fast.substr(0, 30));
    EXPECT_EQ(by_parameters, by_state);
  }
  EXPECT_GT(refused, 10);
}

/// Y π = τ for any bodies.
TEST_P(DerivativesOf, regressorTimesItsValuesIsTheEfforts) {
  const EffortDerivatives of(machine());
  const Eigen::VectorXd values = of.regressorValues();
  ASSERT_EQ(static_cast<std::size_t>(values.size()), of.regressorNames().size());
  for (const std::size_t row : {0u, 2u, 4u}) {
    const Vector6d expected = FastDynamics<double>(machine()).inverseDynamics(motion(row));
    const EffortDerivatives::Columns Y = of.regressor(motion(row));
    EXPECT_LE((Y * values - expected).norm(), promised * expected.norm());
    EXPECT_GT((Y * (values * 1.001) - expected).norm(), promised * expected.norm());
  }
}

TEST_P(DerivativesOf, regressorDoesNotDependOnTheBodies) {
  ManipulatorParameters other = machine().parameters();
  other.platform.mass *= 1.3;
  other.platform.center_of_mass += Vector3d(0.01, -0.02, 0.03);
  for (Leg& leg : other.legs) leg.distal.mass *= 1.2, leg.proximal.center_of_mass *= 0.9, leg.proximal.inertia *= 1.1;
  const EffortDerivatives of(machine()), of_other{Manipulator(other)};
  const EffortDerivatives::Columns Y = of.regressor(motion(2));
  EXPECT_LE((of_other.regressor(motion(2)) - Y).norm(), 1e-10 * Y.norm());
  const Vector6d expected = FastDynamics<double>(Manipulator(other)).inverseDynamics(motion(2));
  EXPECT_LE((Y * of_other.regressorValues() - expected).norm(), promised * expected.norm());
  EXPECT_GT((Y * of.regressorValues() - expected).norm(), 1e-6 * expected.norm());
}

/// Compares with extrapolated differences in 50 digits, whose error is of fourth order in the step. They are one-sided
/// if a body would become impossible; only inertias have such bounds, and efforts are linear in them.
TEST_P(DerivativesOf, byParametersAreTheDifferencesInFiftyDigits) {
  const Motion<double> at = motion(3);
  const Vector6d load = someLoad().cast<double>();
  const EffortDerivatives of(machine());
  const EffortDerivatives::Columns found = of.byParameters(at, load);
  const std::vector<MachineNumber> numbers = machineNumbers(machine().parameters());
  ASSERT_EQ(static_cast<std::size_t>(found.cols()), numbers.size());
  const auto efforts = [&](const MachineNumber& number, double by, double& value) -> Six {
    ManipulatorParameters changed = machine().parameters();
    value = number.get(changed) + by;
    number.set(changed, value);
    return FastDynamics<Real50>(Manipulator(changed)).inverseDynamics(exactly(at), someLoad());
  };
  const auto slope = [&](const MachineNumber& number, double h) -> Six {
    double above = 0, below = 0;
    const Six to = efforts(number, h, above);
    Six from;
    try {
      from = efforts(number, -h, below);
    } catch (const InvalidParameter&) {
      from = efforts(number, 0, below);
    }
    return (to - from) / (Real50(above) - Real50(below));
  };
  const double largest = FastDynamics<double>(machine()).inverseDynamics(at, load).norm();
  int seen = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const MachineNumber& number = numbers[k];
    EXPECT_EQ(of.parameterNames().at(k), number.path);
    const double scale = std::max(std::abs(number.get(machine().parameters())), 0x1p-6), h = 0x1p-18 * scale;
    const Vector6d expected = Six((4 * slope(number, h / 2) - slope(number, h)) / 3).cast<double>();
    const auto column = found.col(static_cast<Eigen::Index>(k));
    // Columns with hardly any effect are right to rounding of the efforts.
    const double size = sizeOf(found, number, k);
    const double limit = promised * std::max(size, 1e-4 * largest / scale);
    EXPECT_LE((column - expected).norm(), limit) << number.path << ": " << expected.transpose();
    seen += expected.norm() > 1e-6 ? 1 : 0;
    if (expected.norm() > 1e-3 * size && promised * size == limit) {
      EXPECT_GT((1.000001 * column - expected).norm(), limit) << number.path;
    }
  }
  EXPECT_GT(seen, static_cast<int>(numbers.size() / 2));
}

INSTANTIATE_TEST_SUITE_P(All, DerivativesOf, testing::ValuesIn(allNames()), byName);

}  // namespace
}  // namespace ursula
