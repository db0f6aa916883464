#include "validation/checks/pointwise_checks.h"

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
  const char* shape;  ///< of the limit, in words; times eps and a level
  Deviation PointwiseSample::*deviation;
  bool of_body;
  /// The quantity's own size, of which useful_share is what a limit may be; 0 where any limit says something.
  std::function<double(const PointwiseSample&)> size = nullptr;
  const char* further = "";  ///< what the limit has beside, in words
};

/// Every limit is a derived shape and a level: measured (RoundingProfile), or derived (rounding_depth).
std::string basisOf(const Quantity& quantity, Level level) {
  return level == Level::measured
             ? fmt::format("eps {} x {:g} x the spread measured in turned and rescaled frames{}", quantity.shape,
                           rounding_safety, quantity.further)
             : fmt::format("eps {} x {:g}, what roundings add up to at most", quantity.shape, rounding_depth);
}

double largestSize(const std::vector<PointwiseSample>& samples, const Quantity& quantity) {
  double largest = 0;
  for (const PointwiseSample& sample : samples)
    if (quantity.size) largest = std::max(largest, quantity.size(sample));
  return largest;
}

/// One of the motors, whose unit is the machine's; `where` is a motor then.
constexpr const char* of_efforts = "";

Check judgeQuantity(const std::vector<PointwiseSample>& samples, Quantity quantity, const Units& units,
                    Level level = Level::measured) {
  const bool is_effort = quantity.unit == of_efforts;
  if (is_effort) quantity.unit = units.efforts.unit;
  const auto nameOf = [&](int where) { return placeName(is_effort ? units.legOf(where) : where, quantity.of_body); };
  Worst shown;
  const PointwiseSample* at = nullptr;
  const PointwiseSample* widest = nullptr;  // by rounding alone: digits that were not printed are no fault of a limit
  double widest_rounding = 0;
  for (const PointwiseSample& sample : samples) {
    if (!sample.refused.empty()) return notMade(quantity.name, quantity.unit, "no answer: " + sample.refused);
    const Deviation& deviation = sample.*quantity.deviation;
    shown.add(deviation.error, deviation.limit, sample.motion.t, deviation.where);
    if (shown.t == sample.motion.t) at = &sample;
    if (widest == nullptr || !(deviation.limit - deviation.given <= widest_rounding))
      widest = &sample, widest_rounding = deviation.limit - deviation.given;
  }
  if (at == nullptr) return notMade(quantity.name, quantity.unit, "no instant was compared");
  const Conditioning& c = at->conditioning;
  const std::string basis = fmt::format("{}; there kappa(B) = {:.3g}, kappa(legs) = {:.3g}, eps = {:.3g}",
                                        basisOf(quantity, level), c.kappa_B, c.kappa_legs, eps);
  const std::string why = fmt::format("{}, at {} instants; shown for t = {:.6g} s, {}", quantity.what, samples.size(),
                                      shown.t * units.time, nameOf(shown.where));
  const double useful = quantity.size ? useful_share * largestSize(samples, quantity) : widest_rounding;
  Check check = judged(quantity.name, shown.value, shown.limit, quantity.unit, basis, why);
  const Deviation& shown_at = at->*quantity.deviation;  // what an engine makes there is not to be trusted either way
  const bool beyond_use = quantity.size && !std::isnan(shown.value) && shown_at.limit - shown_at.given > useful;
  if (beyond_use || (check.verdict == Verdict::pass && !(widest_rounding <= useful)))
    check =
        notJudgeable(Reason::limit_useless, quantity.name, shown.value, widest_rounding, quantity.unit, basis,
                     fmt::format("{}; at t = {:.6g} s the limit exceeds {:g} of the quantity's size: {}", why,
                                 widest->motion.t * units.time, useful_share, causeOfRounding(widest->conditioning)));
  check.largest = {shown.largest, shown.largest_t * units.time, nameOf(shown.largest_where)};
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
       "kappa(legs) kappa(B) x ||T|| x 1.5 / step", &S::jacobian_difference, true, nullptr,
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
