#include "model/exact_trajectory.h"

#include <stdexcept>

namespace ursula {

template <class S, class>
Motion<S> Trajectory::at(const S& t) const {
  const ExactTrajectory* trajectory = exact();
  if (trajectory == nullptr) throw std::logic_error("trajectory '" + kind() + "' knows its motion in doubles only");
  return trajectory->at(t);
}

template Motion<Real50> Trajectory::at(const Real50& t) const;

}  // namespace ursula
