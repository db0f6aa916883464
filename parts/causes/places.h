#pragma once

#include <vector>

#include "parts/causes/diagnosis.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"

namespace ursula {

/// Where a solver's answers are wrong: at the samples, and at all other instants of the motion that it was asked.
struct Places {
  struct Count {
    std::size_t all = 0, wrong = 0;
    double share() const { return all > 0 ? static_cast<double>(wrong) / static_cast<double>(all) : 0; }
  };
  Count samples, others;
  double first = 0, last = 0;         ///< of the others' wrong instants, s
  double largest = 0, largest_t = 0;  ///< the others' largest error, N·m or N, and its instant, s
  int motor = 0;                      ///< of the largest error, 0-based

  /// Whether the samples show what the solver does elsewhere, so that a cause of their errors may be one of all.
  bool areAlike() const;
};

/// All in the units of `scenario`. `answers` are along its motion.
Places placesOf(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                const std::vector<Answered>& answers);

/// Says in place of a cause where the answers are right and wrong. `natural` converts the numbers to SI.
void sayPlaces(const Places& places, const Manipulator& machine, const FrameChange& natural, Diagnosis& diagnosis);

}  // namespace ursula
