#pragma once

#include <vector>

#include "validation/subject/subject.h"

namespace ursula {

/// Returns k φ⁻¹ mod 1 of the duration, not in order of time. The gaps have at most three lengths and match no period
/// (Knuth, The Art of Computer Programming 3, sect. 6.4, theorem S).
std::vector<double> goldenInstants(double duration, int count);

/// Returns the midpoints of the `count` intervals near which the torques curve most.
std::vector<double> curvedInstants(const std::vector<Answered>& in_order, std::size_t count);

void sortByTime(std::vector<Answered>& answers);

/// The efforts of a solver that was asked a few times: the right ones, plus the difference of its answers from them,
/// interpolated. The last of several answers at one instant counts.
class InterpolatedAnswers {
 public:
  using History = std::function<Vector6d(double t)>;
  InterpolatedAnswers(History right, std::vector<Answered> answers);
  Vector6d operator()(double t) const;

 private:
  History right_;
  std::vector<Answered> off_;
};

}  // namespace ursula
