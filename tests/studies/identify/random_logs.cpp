#include "tests/studies/identify/random_logs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "parts/identify/comparison.h"

namespace ursula {
namespace {

const char* const kinds[] = {"paper-helix", "hexa", "hexaglide", "flight-simulator", "mixture", "three-legs"};

bool hasTolerance(const MachineNumber& number) {
  return number.group() == NumberGroup::mass || number.group() == NumberGroup::center ||
         number.quantity == Quantity::platform_inertia || number.quantity == Quantity::friction ||
         number.quantity == Quantity::coulomb;
}

/// Adds friction of a size that a motor feels.
void rub(ManipulatorParameters& machine, double effort, std::mt19937& dice) {
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  for (Leg& leg : machine.legs)
    for (const Coordinate coordinate : rowOf(leg.kind).coordinates) {
      leg.friction.on(coordinate) = 0.05 * effort * uniform(dice);
      leg.coulomb.on(coordinate) = 0.02 * effort * uniform(dice);
    }
}

}  // namespace

std::vector<std::string> massesAndCenters(const RandomLog& log) {
  std::vector<std::string> out;
  for (const MachineNumber& number : machineNumbers(log.truth))
    if ((number.group() == NumberGroup::mass || number.group() == NumberGroup::center) &&
        log.tolerances.count(number.path) > 0)
      out.push_back(number.path);
  return out;
}

RandomLog randomLog(unsigned seed, const std::vector<std::string>& wrong_among) {
  std::mt19937 dice(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  RandomLog out;
  out.model = readScenario(std::string(URSULA_SCENARIOS) + "/" + kinds[seed % std::size(kinds)] + ".toml");
  out.model.load = nullptr;
  ManipulatorParameters nominal = out.model.manipulator->parameters();
  for (Leg& leg : nominal.legs) leg.spins = false;
  for (const MachineNumber& number : machineNumbers(nominal))
    if (number.group() == NumberGroup::mass) number.set(nominal, number.get(nominal) * (0.7 + 0.6 * uniform(dice)));
  double weight = nominal.platform.mass * nominal.gravity.norm() / 6;
  rub(nominal, weight * 0.3, dice);
  out.model.manipulator = std::make_shared<Manipulator>(nominal);
  out.truth = nominal;
  for (const MachineNumber& number : machineNumbers(nominal)) {
    if (!hasTolerance(number)) continue;
    const double size = number.group() == NumberGroup::friction ? number.get(nominal) : number.size(nominal);
    const double tolerance = (number.group() == NumberGroup::friction ? 0.1 : 0.01) * size;
    if (!(tolerance > 0)) continue;
    const bool product = number.entries == 6 && number.entry > 2;
    if (product) continue;  // drawn products might belong to no body
    out.tolerances[number.path] = tolerance;
    number.set(out.truth, number.get(nominal) + tolerance * std::clamp(normal(dice), -2.5, 2.5));
  }
  if (!wrong_among.empty()) {
    out.wrong = wrong_among[dice() % wrong_among.size()];
    const double change = (uniform(dice) < 0.5 ? -5 : 5) * out.tolerances.at(out.wrong);
    for (const MachineNumber& number : machineNumbers(nominal))
      if (number.path == out.wrong) number.set(out.truth, number.get(nominal) + change);
  }
  out.how.seed = seed;
  out.how.size = 0.7 + 0.8 * uniform(dice);
  out.how.period = 3 + 2 * uniform(dice);
  out.how.delay = (20 * uniform(dice) - 10) / out.how.rate;
  out.rows = syntheticRows(out.model, out.truth, out.how);
  return out;
}

void LogStatistics::add(const RandomLog& log, const IdentifyResult& result) {
  const EffortDerivatives truth((Manipulator(identification::withRotors(log.truth))));
  const Eigen::VectorXd values = truth.regressorValues();
  const auto& names = truth.regressorNames();
  for (const MeasuredNumber& each : result.combinations) {
    double value = each.group == "delay" ? log.how.delay : 0;
    for (const auto& [name, factor] : each.terms)
      if (const auto at = std::find(names.begin(), names.end(), name); at != names.end())
        value += factor * values(at - names.begin());
    Share& share = each.group == "delay" ? delay_within : within[each.group];
    share.of += 1;
    share.hits += value >= each.low && value <= each.high ? 1 : 0;
  }
  delay_near.of += 1;
  delay_near.hits += std::abs(result.delay - log.how.delay) <= 0.1 * result.step ? 1 : 0;
  if (result.delay_uncertainty <= 0.05 * result.step) {
    delay_near_known.of += 1;
    delay_near_known.hits += std::abs(result.delay - log.how.delay) <= 0.1 * result.step ? 1 : 0;
  }
  if (log.wrong.empty()) {
    right_passed.of += 1;
    right_passed.hits += result.verdict == Verdict::fail ? 0 : 1;
    return;
  }
  wrong_named.of += 1;
  wrong_failed.of += 1;
  wrong_failed.hits += result.verdict == Verdict::fail ? 1 : 0;
  const auto names_it = [&](const MeasuredCause& cause) {
    return cause.parameter == log.wrong ||
           std::find(cause.as_well.begin(), cause.as_well.end(), log.wrong) != cause.as_well.end();
  };
  wrong_named.hits += std::any_of(result.causes.begin(), result.causes.end(), names_it) ? 1 : 0;
}

std::string LogStatistics::text() const {
  std::string out;
  const auto line = [&out](const std::string& what, const Share& share) {
    if (share.of > 0)
      out += fmt::format("{:<28} {:>6} of {:>6}  {:.1f} %\n", what, share.hits, share.of, 100 * share.share());
  };
  for (const auto& [group, share] : within) line("95 % interval, " + group, share);
  line("95 % interval, delay", delay_within);
  line("delay to 0.1 sample", delay_near);
  line("the same if it is known so well", delay_near_known);
  line("right model not failed", right_passed);
  line("wrong model failed", wrong_failed);
  line("wrong number named", wrong_named);
  return out;
}

}  // namespace ursula
