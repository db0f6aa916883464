#pragma once

#include "model/manipulator.h"
#include "model/open_tree.h"

namespace ursula {

/// Returns the rates of the platform's speeds under efforts.
Vector6d closedRates(const OpenTree& tree, const OpenTreeMasses& masses, const Manipulator& manipulator,
                     const Vector6d& efforts);

/// Returns a bound, to first order, of how much soft closures change the platform's rates. Each closure leaves `part`
/// of the acceleration at which its gap would open without it.
Vector6d changeOfRates(const OpenTree& tree, const OpenTreeMasses& masses, const Manipulator& manipulator,
                       const Vector6d& efforts, double part);

}  // namespace ursula
