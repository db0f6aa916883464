#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>

#include "validation/limits/conditioning.h"
#include "validation/samples/place_name.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();

enum class Level { measured, derived };

struct Quantity {
  std::string name, unit, what;
  const char* shape;  ///< of the limit, in words; multiplied by eps and a level
  Deviation PointwiseSample::*deviation;
  bool of_body;
  std::function<double(const PointwiseSample&)> size;  ///< size of the quantity itself
  const char* further = "";                            ///< further terms of the limit, in words
};

/// Every limit is a derived shape times a level. The level is measured (RoundingProfile) or derived (rounding_depth).
std::string basisOf(const Quantity& quantity, Level level) {
  return level == Level::measured
             ? fmt::format("eps {} x {:g} x the spread measured in turned and rescaled frames{}", quantity.shape,
                           rounding_safety, quantity.further)
             : fmt::format("eps {} x {:g}, what roundings add up to at most", quantity.shape, rounding_depth);
}

const PointwiseSample& sampleAt(const std::vector<PointwiseSample>& samples, double t) {
  return *std::find_if(samples.begin(), std::prev(samples.end()),
                       [t](const PointwiseSample& sample) { return sample.motion.t == t; });
}

double largestSize(const std::vector<PointwiseSample>& samples, const Quantity& quantity) {
  double largest = 0;
  for (const PointwiseSample& sample : samples) largest = std::max(largest, quantity.size(sample));
  return largest;
}

/// Stands for the unit of the machine's efforts; `where` is then a motor.
constexpr const char* of_efforts = "";

Check judgeQuantity(const std::vector<PointwiseSample>& samples, Quantity quantity, const Units& units,
                    Level level = Level::measured) {
  const bool is_effort = quantity.unit == of_efforts;
  if (is_effort) quantity.unit = units.efforts.unit;
  const auto nameOf = [&](int where) {
    return is_effort ? motorName(units, where) : placeName(where, quantity.of_body);
  };
  WorstShare worst;
  double given = 0;  // possible error from a file's missing digits, which does not make a limit useless
  for (const PointwiseSample& sample : samples) {
    if (!sample.refused.empty()) return notMade(quantity.name, quantity.unit, "no answer: " + sample.refused);
    const Deviation& deviation = sample.*quantity.deviation;
    worst.add(deviation.error, deviation.limit, sample.motion.t, deviation.where);
    given = std::max(given, deviation.given);
  }
  if (!worst.any) return notMade(quantity.name, quantity.unit, "no instant was compared");
  const CheckedQuantity of{quantity.name, quantity.unit, largestSize(samples, quantity), given};
  const JudgedValue shown = worst.shown(of.useful());
  const Conditioning& c = sampleAt(samples, shown.t).conditioning;
  const std::string basis = fmt::format("{}; there kappa(B) = {:.3g}, kappa(legs) = {:.3g}, eps = {:.3g}",
                                        basisOf(quantity, level), c.kappa_B, c.kappa_legs, eps);
  const std::string why = fmt::format("{}, at {} instants; shown for t = {:.6g} s, {}", quantity.what, samples.size(),
                                      shown.t * units.time, nameOf(shown.where));
  Check check = judgedIfUseful(of, worst, basis, why, causeOfRounding(samples, worst.widest_t));
  check.largest = {worst.largest, worst.largest_t * units.time, nameOf(worst.largest_where)};
  return check;
}

const std::vector<Quantity>& kinematicQuantities() {
  using S = PointwiseSample;
  const auto spin = [](const S& s) { return s.conditioning.twist_scale; };
  const auto rate = [](const S& s) { return s.conditioning.rate_scale; };
  static const std::vector<Quantity> quantities = {
      {"kinematics.joint_angles", "rad", "joint coordinates against Simbody's loop placed by geometry",
       "kappa(legs) x largest coordinate / length", &S::joint_angles, false, [](const S&) { return 1.0; }},
      {"kinematics.joint_rates", "rad/s", "their rates against Simbody's constraint Jacobian",
       "kappa(legs) kappa(B) x velocity / length", &S::joint_rates, false,
       [spin](const S& s) { return spin(s) / s.conditioning.length; }},
      {"kinematics.joint_accelerations", "rad/s^2", "their accelerations against Simbody's constraints",
       "kappa(legs)^2 kappa(B) x acceleration / length", &S::joint_accelerations, false,
       [rate](const S& s) { return rate(s) / s.conditioning.length; }},
      {"kinematics.positions", "m", "mass centres and orientations of all bodies, Simbody put into the joint state",
       "kappa(legs) x largest coordinate", &S::position, true,
       [](const S& s) { return s.conditioning.position_scale; }},
      {"kinematics.twists", "m/s", "twists of all bodies, (16), (41)", "kappa(legs) kappa(B) x velocity", &S::twist,
       true, spin},
      {"kinematics.accelerations", "m/s^2", "twist rates of all bodies, (17), (43)",
       "kappa(legs)^2 kappa(B) x acceleration", &S::twist_rate, true, rate},
      {"kinematics.jacobian", "m/s", "t_P = T phi_dot (24) with Simbody's joint rates",
       "kappa(legs) kappa(B)^2 x velocity", &S::jacobian, true, spin},
      {"kinematics.jacobian_rate", "m/s^2", "T phi_ddot + T_dot phi_dot (25) with Simbody's joint motion",
       "kappa(legs)^2 kappa(B)^2 x acceleration", &S::jacobian_rate, true, rate},
      {"kinematics.jacobian_difference", "m/s", "T_dot against five-point differences of T along the motion",
       "kappa(legs) kappa(B) x ||T|| x 1.5 / step", &S::jacobian_difference, true,
       [spin](const S& s) { return s.conditioning.shaping_scale * (1 + spin(s) / s.conditioning.length); },
       ", and what doubling the step changes"},
  };
  return quantities;
}

const std::vector<Quantity>& dynamicQuantities() {
  using S = PointwiseSample;
  const auto torque = [](const S& s) { return s.torques_simbody.cwiseAbs().maxCoeff(); };
  static const std::vector<Quantity> quantities = {
      {"torque.pointwise", of_efforts, "torques against Simbody's own inverse dynamics",
       "kappa(B) kappa(legs) x || |T|' |w| ||", &S::torque, false, torque},
      {"acceleration.pointwise", "m/s^2", "Simbody's accelerations of the platform under the torques, commanded state",
       "(|| T_P inv(I) || x the torque's and the platform's compliance x the forces that close the loops)",
       &S::acceleration, true, [torque](const S& s) { return s.conditioning.response * torque(s); }},
  };
  return quantities;
}

bool isOfJointsOrTorque(const Quantity& quantity) {
  using S = PointwiseSample;
  const Deviation S::*const those[] = {&S::joint_angles, &S::joint_rates, &S::joint_accelerations, &S::torque};
  return std::find(std::begin(those), std::end(those), quantity.deviation) != std::end(those);
}

}  // namespace

std::vector<Check> judgeJointsAndTorques(const std::vector<PointwiseSample>& samples, const Units& units) {
  std::vector<Check> checks;
  for (const auto* quantities : {&kinematicQuantities(), &dynamicQuantities()})
    for (const Quantity& quantity : *quantities)
      if (isOfJointsOrTorque(quantity)) checks.push_back(judgeQuantity(samples, quantity, units, Level::derived));
  return checks;
}

std::vector<Check> judgePointwise(const std::vector<PointwiseSample>& samples, bool has_kinematics,
                                  const Units& units) {
  std::vector<Check> checks;
  if (has_kinematics)
    for (const Quantity& quantity : kinematicQuantities()) checks.push_back(judgeQuantity(samples, quantity, units));
  for (const Quantity& quantity : dynamicQuantities()) checks.push_back(judgeQuantity(samples, quantity, units));
  return checks;
}

}  // namespace ursula
