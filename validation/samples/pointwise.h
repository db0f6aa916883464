#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/limits/rounding_profile.h"
#include "validation/samples/simbody_answers.h"
#include "validation/subject/subject.h"

namespace ursula {

struct Units;

/// "leg 3", or "leg 3, motor 5" for a leg with several motors; "platform" for −1. `motor` is 0-based.
std::string motorName(const Units& units, int motor);

/// "leg 3", "proximal link of leg 3" or "platform".
std::string placeName(int where, bool of_body);

/// The difference of one quantity at one instant, and its limit there.
struct Deviation {
  double error = 0;
  double limit = 0;
  int where = -1;    ///< leg or body, 0-based; −1 for none
  double given = 0;  ///< part of the limit from the input, such as printed digits
};

/// The motion at one instant, and its conditioning.
struct Conditions {
  Motion<double> motion;
  Conditioning conditioning;
};

/// All results of the pointwise experiments at one instant.
struct PointwiseSample {
  Motion<double> motion;
  Conditioning conditioning;
  JointMotion joints;                                                               ///< Simbody's own
  Vector6d torques = Vector6d::Constant(std::numeric_limits<double>::quiet_NaN());  ///< NaN where refused
  Vector6d torques_simbody = torques;
  Vector6d torques_given = Vector6d::Zero();  ///< part of the torques' limits from the input, such as printed digits
  Deviation joint_angles, joint_rates, joint_accelerations;  ///< rad, rad/s, rad/s²
  Deviation position, twist, twist_rate;                     ///< over 13 bodies: m, m/s, m/s²
  Deviation jacobian, jacobian_rate;  ///< T φ̇ and T φ̈ + Ṫ φ̇ against the commanded t_P, ṫ_P: m/s, m/s²
  Deviation jacobian_difference;      ///< Ṫ against differences of T along the motion, m/s
  Deviation torque;                   ///< of the motor with the largest share of its limit, N·m
  Deviation acceleration;             ///< platform, m/s²
  Vector6d acceleration_error = Vector6d::Zero();  ///< Simbody's minus commanded, [ω̇; p̈]
  std::string refused;                             ///< why the subject has no answer here; else empty

  /// The limit of each motor's deviation, N·m.
  Vector6d torqueLimits() const { return torques_given.array() + conditioning.torqueRounding(); }
};

/// Solver and Simbody at the same instants: joint state, 13 bodies, torques, accelerations. `profile` is the
/// scenario's; `simbody` are Simbody's answers at the instants, and `fault` is Simbody's.
std::vector<PointwiseSample> runPointwise(const Scenario& scenario, const Subject& subject,
                                          const std::vector<double>& instants, const RoundingProfile& profile,
                                          const std::vector<SimbodyAnswer>& simbody, const Deadline& deadline = {},
                                          const EngineFault& fault = {});
/// The same, but it asks Simbody itself.
std::vector<PointwiseSample> runPointwise(const Scenario& scenario, const Subject& subject,
                                          const std::vector<double>& instants, const RoundingProfile& profile);
/// The same with its own profile.
std::vector<PointwiseSample> runPointwise(const Scenario& scenario, const Subject& subject,
                                          const std::vector<double>& instants, const Deadline& deadline = {});

/// Only joints and torques, with the fewest calls of Simbody: its placed loop and inverse dynamics. Limits are derived
/// (rounding_depth), not measured.
std::vector<PointwiseSample> runJointsAndTorques(const Scenario& scenario, const Subject& subject,
                                                 const std::vector<double>& instants);

/// Sets `torque` from the torques of both sides.
void compareTorques(PointwiseSample& sample);

/// The index of the first sample at t or after it, otherwise of the last.
std::size_t indexFrom(const std::vector<PointwiseSample>& samples, double t);

/// The largest of Simbody's torques, N·m; 0 without samples.
double largestTorque(const std::vector<PointwiseSample>& samples);

std::vector<double> instantsOf(const std::vector<PointwiseSample>& samples);

/// causeOfRounding at the sample at t, or at the first after it; "" if there is none.
std::string causeOfRounding(const std::vector<PointwiseSample>& samples, double t, Rounded quantity = Rounded::torque);

}  // namespace ursula
