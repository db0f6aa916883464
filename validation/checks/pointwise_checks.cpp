#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>

#include "validation/checks/judges.h"
#include "validation/limits/conditioning.h"
#include "validation/limits/engine_view.h"
#include "validation/samples/pointwise.h"

namespace ursula {
namespace {

/// Every limit is a derived shape times a level.
enum class Level { measured, derived };

struct Quantity {
  std::string name, unit, what;
  const char* shape;  ///< of the limit, in words; multiplied by eps and a level
  Deviation PointwiseSample::*deviation;
  bool of_body;
  Rounded rounded, about;    ///< itself, and what must be there to be compared
  const char* further = "";  ///< further terms of the limit, in words
};

/// The level is measured (RoundingProfile) or derived (rounding_depth).
std::string basisOf(const Quantity& quantity, Level level) {
  return level == Level::measured
             ? fmt::format("eps {} x {:g} x the spread measured over changed inputs{}", quantity.shape, rounding_safety,
                           quantity.further)
             : fmt::format("eps {} x {:g}, what roundings add up to at most", quantity.shape, rounding_depth);
}

/// Whether a held pose has nothing of it.
bool isOfMotion(Rounded quantity) {
  using R = Rounded;
  static constexpr R those[] = {R::rates, R::accelerations, R::twists, R::twist_rates, R::jacobian, R::jacobian_rate};
  return std::find(std::begin(those), std::end(those), quantity) != std::end(those);
}

/// Stands for the unit of the machine's efforts; `where` is then a motor.
constexpr const char* of_efforts = "";

Check judgeQuantity(const std::vector<PointwiseSample>& samples, Quantity quantity, const Units& units,
                    const MotionSizes& sizes, Level level = Level::measured) {
  const bool is_effort = quantity.unit == of_efforts;
  if (is_effort) quantity.unit = units.efforts.unit;
  const auto nameOf = [&](int where) {
    return is_effort ? motorName(units, where) : placeName(where, quantity.of_body);
  };
  WorstShare worst;
  CheckedQuantity of{quantity.name, quantity.unit, sizes.of(quantity.rounded)};
  of.seen = 0, of.along = sizes.of(quantity.about), of.of_motion = isOfMotion(quantity.about);
  for (const PointwiseSample& sample : samples) {
    if (!sample.refused.empty()) return notMade(quantity.name, quantity.unit, "no answer: " + sample.refused);
    const Deviation& deviation = sample.*quantity.deviation;
    if (is_effort)
      worst.addEach(sample.torques - sample.torques_simbody, sample.torqueLimits(), sample.motion.t);
    else
      worst.add(deviation.error, deviation.limit, sample.motion.t, deviation.where);
    of.size = std::max(of.size, sample.conditioning.size(quantity.rounded));
    of.seen = std::max(of.seen, sample.conditioning.size(quantity.about));
    of.given = std::max(of.given, is_effort ? sample.torques_given.maxCoeff() : deviation.given);
  }
  if (!worst.any) return notMade(quantity.name, quantity.unit, "no instant was compared");
  const Conditioning& c = samples[indexFrom(samples, worst.shown(of.useful()).t)].conditioning;
  const std::string basis =
      fmt::format("{}; there kappa(B) = {:.3g}, kappa(legs) = {:.3g}, eps = {:.3g}", basisOf(quantity, level),
                  c.kappa_B, c.kappa_legs, Eigen::NumTraits<double>::epsilon());
  return judgedShown(of, worst, units,
                     {basis, fmt::format("{}, at {} instants", quantity.what, samples.size()), nameOf,
                      causeOfRounding(samples, worst.widest_t)});
}

const std::vector<Quantity>& kinematicQuantities() {
  using S = PointwiseSample;
  using R = Rounded;
  static const std::vector<Quantity> quantities = {
      {"kinematics.joint_angles", "rad", "joint coordinates against Simbody's loop placed by geometry",
       "kappa(legs) x largest coordinate / length", &S::joint_angles, false, R::angles, R::angles},
      {"kinematics.joint_rates", "rad/s", "their rates against Simbody's constraint Jacobian",
       "kappa(legs) kappa(B) x velocity / length", &S::joint_rates, false, R::rates, R::rates},
      {"kinematics.joint_accelerations", "rad/s^2", "their accelerations against Simbody's constraints",
       "kappa(legs)^2 kappa(B) x acceleration / length", &S::joint_accelerations, false, R::accelerations,
       R::accelerations},
      {"kinematics.positions", "m", "mass centres and orientations of all bodies, Simbody put into the joint state",
       "kappa(legs) x largest coordinate", &S::position, true, R::positions, R::positions},
      {"kinematics.twists", "m/s", "twists of all bodies, (16), (41)", "kappa(legs) kappa(B) x velocity", &S::twist,
       true, R::twists, R::twists},
      {"kinematics.accelerations", "m/s^2", "twist rates of all bodies, (17), (43)",
       "kappa(legs)^2 kappa(B) x acceleration", &S::twist_rate, true, R::twist_rates, R::twist_rates},
      {"kinematics.jacobian", "m/s", "t_P = T phi_dot (24) with Simbody's joint rates",
       "kappa(legs) kappa(B)^2 x velocity", &S::jacobian, true, R::jacobian, R::jacobian},
      {"kinematics.jacobian_rate", "m/s^2", "T phi_ddot + T_dot phi_dot (25) with Simbody's joint motion",
       "kappa(legs)^2 kappa(B)^2 x acceleration", &S::jacobian_rate, true, R::jacobian_rate, R::jacobian_rate},
      {"kinematics.jacobian_difference", "m/s", "T_dot against five-point differences of T along the motion",
       "kappa(legs) kappa(B) x ||T|| x 1.5 / step", &S::jacobian_difference, true, R::shaping_rate, R::twists,
       ", and what doubling the step changes"},
  };
  return quantities;
}

const std::vector<Quantity>& dynamicQuantities() {
  using S = PointwiseSample;
  using R = Rounded;
  static const std::vector<Quantity> quantities = {
      {"torque.pointwise", of_efforts, "torques against Simbody's own inverse dynamics",
       "kappa(B) kappa(legs) x || |T|' |w| ||", &S::torque, false, R::torque, R::torque},
      {"acceleration.pointwise", "m/s^2", "Simbody's accelerations of the platform under the torques, commanded state",
       "(|| T_P inv(I) || x the torque's and the platform's compliance x the forces that close the loops)",
       &S::acceleration, true, R::acceleration, R::acceleration},
  };
  return quantities;
}

bool isOfJointsOrTorque(const Quantity& quantity) {
  using S = PointwiseSample;
  const Deviation S::*const those[] = {&S::joint_angles, &S::joint_rates, &S::joint_accelerations, &S::torque};
  return std::find(std::begin(those), std::end(those), quantity.deviation) != std::end(those);
}

}  // namespace

Check judgedShown(const CheckedQuantity& quantity, const WorstShare& worst, const Units& units,
                  const ShownWords& words) {
  const JudgedValue shown = worst.shown(quantity.useful());
  const auto place = [&words](int where) { return words.place ? words.place(where) : ""; };
  const std::string why = fmt::format("{}; shown for t = {:.6g} s{}{}{}", words.what, shown.t * units.time,
                                      words.place ? ", " : "", place(shown.where), words.further);
  Check check = judgedIfUseful(quantity, worst, words.basis, why, words.cause);
  check.largest = {worst.largest, worst.largest_t * units.time, place(worst.largest_where)};
  return check;
}

std::function<std::string(int where)> motorsOf(const Units& units) {
  return [&units](int where) { return motorName(units, where); };
}

std::vector<Check> judgeJointsAndTorques(const std::vector<PointwiseSample>& samples, const Units& units,
                                         const MotionSizes& sizes) {
  std::vector<Check> checks;
  for (const auto* quantities : {&kinematicQuantities(), &dynamicQuantities()})
    for (const Quantity& quantity : *quantities)
      if (isOfJointsOrTorque(quantity))
        checks.push_back(judgeQuantity(samples, quantity, units, sizes, Level::derived));
  return checks;
}

std::vector<Check> judgePointwise(const std::vector<PointwiseSample>& samples, bool has_kinematics, const Units& units,
                                  const MotionSizes& sizes) {
  std::vector<Check> checks;
  if (has_kinematics)
    for (const Quantity& quantity : kinematicQuantities())
      checks.push_back(judgeQuantity(samples, quantity, units, sizes));
  for (const Quantity& quantity : dynamicQuantities()) checks.push_back(judgeQuantity(samples, quantity, units, sizes));
  return checks;
}

std::vector<Check> judgeComplement(const std::vector<ComplementSample>& samples, const Units& units) {
  static constexpr const char *orthogonality = "complement.orthogonality", *rank = "complement.rank";
  if (samples.empty())
    return {notMade(orthogonality, "", "no instant was compared"), notMade(rank, "", "no instant was compared")};
  WorstShare worst;
  int missing = 0;
  double at = samples.front().t;
  const ComplementSample* shown = &samples.front();
  for (const ComplementSample& sample : samples) {
    const bool empty = !(sample.size_D > 0) || !(sample.size_T > 0);  // zeros are orthogonal to everything
    const double product = empty ? std::nan("") : sample.product / (sample.size_D * sample.size_T);
    worst.add(product, sample.limit / (sample.size_D * sample.size_T), sample.t, -1);
    const int here = std::abs(sample.rank_D - sample.wanted_D) + std::abs(sample.rank_T - sample.wanted_T);
    if (here <= missing) continue;
    missing = here;
    at = sample.t;
    shown = &sample;
  }
  const Check product = judgedShown({orthogonality, "", 1}, worst, units,
                                    {"eps x kappa(B) kappa(legs) x what roundings add up to at most, of ||D|| ||T||",
                                     fmt::format("|| D T || over || D || || T || (33), at {} instants", samples.size()),
                                     nullptr, "a singular pose or a stretched leg is near"});
  Check ranks = judged(rank, missing, 0, "", "D leaves six freedoms, T spans them",
                       fmt::format("D has rank {} of {}, T has rank {} of {}, at t = {:.6g} s", shown->rank_D,
                                   shown->wanted_D, shown->rank_T, shown->wanted_T, at * units.time));
  ranks.largest = {static_cast<double>(missing), at * units.time, ""};
  return {product, ranks};
}

Check judgeReactions(const std::vector<ReactionSample>& reactions, const std::vector<PointwiseSample>& samples,
                     const RoundingProfile& profile, const Units& units) {
  RemeasuredLimits look(profile);
  const double along = profile.sizes().of(Rounded::reactions);
  double size = 0;
  WorstShare worst;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const PointwiseSample& sample = samples[k];
    const Conditioning& at = sample.conditioning;
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      const LegReactions& recovered = reactions.at(k).recovered[leg];
      size = std::max(size, distance(recovered, LegReactions{}, at.length));
      const double error = reactions[k].errors[leg];
      worst.add(error, look.limit(error, at, Rounded::reactions, sample.motion), sample.motion.t,
                static_cast<int>(leg));
    }
  }
  if (!worst.any) return notMade("reactions.pointwise", "N", "no instant was compared");
  return judgedShown(
      {"reactions.pointwise", "N", std::max(size, along), 0, size, along}, worst, units,
      {fmt::format(
           "eps (kappa(B)^2 kappa(legs) x || |T|' |w| || / length + largest mass x the acceleration's) x {:g} x "
           "the spread measured over changed inputs",
           rounding_safety),
       fmt::format("forces, and moments over the machine's length, at all joints against Simbody's mobilizer and "
                   "constraint reactions, at {} instants",
                   samples.size()),
       [](int leg) { return placeName(leg, false); }, causeOfRounding(samples, worst.widest_t),
       fmt::format("; the largest is {:.6g} N", size * units.force())});
}

}  // namespace ursula
