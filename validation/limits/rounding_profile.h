#pragma once

#include <memory>
#include <vector>

#include "model/scenario.h"
#include "validation/limits/conditioning.h"

namespace ursula {

/// What rounding does on every formulation along one scenario, measured: the same instants are evaluated in several
/// changes of frame (change of frame.h), which is the same physics with other roundings. The spread of the answers is
/// the formulations' noise. No error of a model enters it, for it is the same in every change of frame, nor anything
/// that is on trial.
///
/// Measured at some instants, in units of the derived shape, which carries the level to the instants between: a level
/// is safety × the largest spread at the five instants about, and a floor.
class RoundingProfile {
 public:
  /// At `instants` equally spaced ones of the motion. Throws PoseError as the solver does.
  RoundingProfile(const Scenario& scenario, int instants);
  ~RoundingProfile();

  /// The conditioning at an instant of the motion, with measured levels.
  Conditioning at(const Motion<double>& motion) const;
  /// The same, where the instant itself is measured, too, the direct dynamics under `torques` where they are given.
  /// What two formulations differ by as the scenario stands is no more than their spread and their least difference in
  /// any change of frame: beyond such a limit it is a difference that no change of frame takes away, and so no
  /// rounding.
  Conditioning closer(const Motion<double>& motion, const Vector6d* torques = nullptr) const;

  /// The measured spread of `quantity`, in units of its shape, at each instant measured.
  std::vector<double> spreads(Rounded quantity) const;

 private:
  struct Measured {
    double t = 0;
    RoundingLevels spread = uniformLevels(0);
  };
  Measured measure(const Motion<double>& motion, const Vector6d* torques) const;
  Conditioning leveled(const Motion<double>& motion, const Measured* itself) const;

  struct Workspace;
  std::unique_ptr<Workspace> workspace_;  ///< what is worked with, by one thread at a time
  std::vector<Measured> measured_;
};

/// Limits that are looked at again where a value is beyond them, until one is so all the same: the check has then
/// failed, whatever comes after.
class SecondLook {
 public:
  explicit SecondLook(const RoundingProfile& profile) : profile_(profile) {}
  /// `factor` × the rounding of `quantity`, of a sample with the conditioning `at`, for a value of `error`.
  double limit(double error, const Conditioning& at, Rounded quantity, const Motion<double>& motion, double factor = 1,
               const Vector6d* torques = nullptr);

 private:
  const RoundingProfile& profile_;
  bool confirmed_ = false;
};

/// Changed by as much as the largest, so that direct dynamics are seen off the commanded motion.
Vector6d otherTorques(const Vector6d& torques);

/// Enough of them for a run that is judged at `samples` instants.
int profileInstants(int samples);

/// By which a measured spread is multiplied: the spread is the largest of some 20 differences, a limit must hold for
/// the largest of some 10,000. For normal deviates the ratio of the two is below 3 (Cramér, Mathematical Methods of
/// Statistics, 1946, sect. 28.6); the rest is for what is not normal. Over 5,000 random machines the largest error used
/// about a third of its limit.
constexpr double rounding_safety = 10;

/// A level is at least this: the shape is a worst case, and what rounds in double seldom reaches a hundredth of it, but
/// may round to the same number in every frame.
constexpr double rounding_floor = 0.02;
/// … but for no more than this share of what the quantity is made of. Near a singular pose the worst case of several
/// condition numbers, one on the other, is beyond all that is measured, and a limit made of it would say nothing; what
/// is left of the digits there is measured.
constexpr double floor_share = 1e-9;

}  // namespace ursula
