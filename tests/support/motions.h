#pragma once

#include <memory>
#include <random>

#include "model/scenario.h"

namespace ursula {

/// Random numbers that are equal on every machine, unlike those of the standard's distributions.
class SeededDraws {
 public:
  explicit SeededDraws(unsigned seed) : engine_(seed) {}
  /// Uniform in [low, high).
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vector3d vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }

 private:
  std::mt19937_64 engine_;
};

/// A motion through poses near the scenario's own that rotates about all three axes (the helix rotates about one).
std::unique_ptr<Trajectory> tumbling(const Scenario& scenario, unsigned seed);

/// A pose near one of the scenario's own with a twist and a twist rate of about 1 in every coordinate.
Motion<double> randomState(const Scenario& scenario, SeededDraws& dice);

}  // namespace ursula
