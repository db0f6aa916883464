#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
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

/// Looks for accelerations that do not follow the efforts: no efforts make such a simulator right.
class Unmoved {
 public:
  explicit Unmoved(std::vector<std::string> names) : names_(std::move(names)) {}

  /// Takes the first answer in a state.
  void addFirst(const Eigen::VectorXd& answer);
  /// Takes an answer under other efforts in that state, which right ones would change by `right`; a change within
  /// `least` is none.
  void add(const Eigen::VectorXd& first, const Eigen::VectorXd& answer, const Eigen::VectorXd& right,
           const Eigen::VectorXd& least);
  /// "the same answer whatever is asked: 0 for a_x, …", or "… whatever the efforts are: …"; empty if all follow.
  std::string words() const;

 private:
  struct Entry {
    double first = 0;
    bool is_same = true;  ///< in all states
    bool moves = false, should_move = false;
  };
  std::vector<std::string> names_;
  std::vector<Entry> entries_;
};

/// Returns the efforts under which a simulator has the wanted accelerations, so that it is judged as a solver is. Where
/// its accelerations under the right efforts are right, these are the answer. Else they are found by Broyden's method
/// (Math. Comp. 19 (1965) 577), which ends after 2n steps, since accelerations are affine in the efforts (Gay, SIAM J.
/// Numer. Anal. 16 (1979) 623). With so many questions asked, the last step stands. `unmoved` gets all answers.
std::vector<Eigen::VectorXd> neededEfforts(const std::vector<WantedState>& states, const AccelerationsIn& simulator,
                                           long questions, Unmoved& unmoved);

}  // namespace ursula
