#pragma once

#include <array>

#include "base/scalar.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "model/scenario.h"

namespace ursula {

/// Changes numbers by one rounding, up or down, fixed by the seed. Zeros stay zero, and numbers of equal size stay
/// equal. Otherwise only some evaluations would take the branches for equal numbers.
class Mover {
 public:
  explicit Mover(unsigned seed) : seed_(seed) {}

  void operator()(double& number) const;
  template <class Derived>
  void operator()(Eigen::MatrixBase<Derived>& of) const {
    for (Eigen::Index k = 0; k < of.size(); ++k) (*this)(of(k % of.rows(), k / of.rows()));
  }
  void operator()(std::array<double, 3>& numbers) const {
    for (double& number : numbers) (*this)(number);
  }

 private:
  unsigned seed_;
};

/// Returns the motion, and the machine, with every number changed by one rounding.
Motion<double> moved(Motion<double> motion, unsigned seed);
Manipulator moved(const Manipulator& machine, unsigned seed);
/// Returns the scenario with such a machine; its motion and load stay.
Scenario moved(Scenario scenario, unsigned seed);

}  // namespace ursula
