#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

namespace ursula {

/// A state in which a simulator is asked.
struct WantedState {
  Eigen::VectorXd wanted, efforts;  ///< accelerations of the motion, and the efforts that are right for them
  Eigen::MatrixXd inertia;          ///< efforts per acceleration
  Eigen::VectorXd scale;            ///< turns accelerations into one unit
  double rounding = 0;              ///< a difference of accelerations in that unit that is none
};

/// Gives the simulator's accelerations under efforts, in the states of these numbers.
using AccelerationsIn = std::function<std::vector<Eigen::VectorXd>(const std::vector<std::size_t>& states,
                                                                   const std::vector<Eigen::VectorXd>& efforts)>;

/// Returns the efforts under which a simulator has the wanted accelerations, so that it is judged as a solver is. Where
/// its accelerations under the right efforts are right, these are the answer. Else they are found by Broyden's method
/// (Math. Comp. 19 (1965) 577), which ends after 2n steps, since accelerations are affine in the efforts (Gay, SIAM J.
/// Numer. Anal. 16 (1979) 623). With so many questions asked, the last step stands.
std::vector<Eigen::VectorXd> neededEfforts(const std::vector<WantedState>& states, const AccelerationsIn& simulator,
                                           long questions);

}  // namespace ursula
