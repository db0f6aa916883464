#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/limits/conditioning.h"
#include "validation/limits/formulation_faults.h"
#include "validation/limits/motion_sizes.h"

namespace ursula {

/// The largest difference between an engine's answers in another change of frame and in the given one, and the limit
/// of its own rounding, in the quantity's unit.
struct FrameDifference {
  double t = 0;
  Rounded quantity = Rounded::torque;
  double difference = 0, limit = 0;
};

/// The measured rounding of every formulation along one scenario. Each gets the given numbers, then inputs changed by
/// one rounding, in the same frame (moved_inputs.h). The spread of its answers is its noise. An error is the same in
/// all evaluations, on whatever leg, axis or frame it depends, so it does not enter; neither does the subject. A spread
/// beyond what rounding explains (most_spread) gives no level, so the limit is infinite.
///
/// Some instants are measured, in units of the derived shape, which extends the level to the instants between. A level
/// is a floor plus safety × the largest spread at the five nearest instants.
///
/// The engines are also asked in other changes of frame (frame_change.h): the same physics, so the same answers.
class RoundingProfile {
 public:
  /// Measures at `instants` equally spaced instants of the motion. Throws PoseError like the solver.
  RoundingProfile(const Scenario& scenario, int instants, const Deadline& deadline = {},
                  const FormulationFaults& faults = {});
  ~RoundingProfile();

  /// The conditioning at an instant of the motion, with measured levels.
  Conditioning at(const Motion<double>& motion) const;
  /// The same with the instant itself measured; direct dynamics then has `torques`, if given.
  Conditioning closer(const Motion<double>& motion, const Vector6d* torques = nullptr) const;

  const MotionSizes& sizes() const { return sizes_; }

  /// The measured spread of `quantity` at each measured instant, in units of its shape: the solver's plus the engine's.
  std::vector<double> spreads(Rounded quantity) const;
  /// The largest spread of one formulation in `quantity`, over the largest that rounding explains.
  double largestOfOne(Rounded quantity) const;

  /// The efforts of the engines in other frames, at each measured instant and for each engine.
  std::vector<FrameDifference> acrossFrames() const;

 private:
  struct Measured {
    double t = 0;
    RoundingLevels solver = uniformLevels(0), engines = uniformLevels(0);
    RoundingLevels across_frames = uniformLevels(0);  ///< differences of the engines, in units of the shape
  };
  Measured measure(const Motion<double>& motion, const Vector6d* torques, const std::vector<std::size_t>& frames) const;
  Conditioning withLevels(const Motion<double>& motion, const Measured* measured_here) const;
  std::pair<std::size_t, std::size_t> nearest(double t) const;  ///< from the first to the last of five instants

  struct Workspace;
  MotionSizes sizes_;
  std::unique_ptr<Workspace> workspace_;  ///< scratch, for one thread at a time
  std::vector<Measured> measured_;
  std::vector<Motion<double>> motions_;  ///< at the measured instants
};

/// Measures a limit again if a value exceeds it. It stops after the first confirmed excess: the check has failed.
class RemeasuredLimits {
 public:
  explicit RemeasuredLimits(const RoundingProfile& profile) : profile_(profile) {}
  /// `factor` × the rounding of `quantity`, for a sample with conditioning `at` and a value of `error`.
  double limit(double error, const Conditioning& at, Rounded quantity, const Motion<double>& motion, double factor = 1,
               const Vector6d* torques = nullptr);

 private:
  const RoundingProfile& profile_;
  bool confirmed_ = false;
};

/// Torques changed by the size of the largest, for direct dynamics off the commanded motion.
Vector6d otherTorques(const Vector6d& torques);

/// A sufficient number of instants for a run that is judged at `samples` instants, which may all be at rest.
int profileInstants(int samples);

/// Factor on a measured spread. The spread is the largest of some ten to forty differences; a limit must hold for some
/// 10,000. For normal deviates the ratio is below 3 (Cramér, Mathematical Methods of Statistics, 1946, sect. 28.6); the
/// rest covers other distributions. Over 5,000 random machines the largest error used about a third of its limit.
constexpr double rounding_safety = 10;

/// The least level, in case all evaluations round equally and show no spread. The shape is a worst case, and rounding
/// of doubles seldom reaches a hundredth of it.
constexpr double rounding_floor = 0.02;
/// The floor is at most this share of the quantity's terms. Near a singular pose the product of several condition
/// numbers exceeds everything measured and would make a useless limit. The remaining digits there are measured.
constexpr double floor_share = 1e-9;

}  // namespace ursula
