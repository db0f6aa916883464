#include "parts/causes/hypotheses.h"
#include "model/effort_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/scalar.h"
#include "parts/causes/fits.h"
#include "parts/causes/tried_causes.h"

namespace ursula {
namespace {

using Rows = std::vector<Vector6d>;

/// 1 + c, with extra digits if c is small.
std::string factorText(double c) {
  if (std::abs(c) < 5e-4) return fmt::format("1 {} {:.4g}", c < 0 ? '-' : '+', std::abs(c));
  return fmt::format("{:.6g}", 1 + c);
}

Rows minus(const Rows& a, const Rows& b, double factor) {
  Rows out(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) out[k] = a[k] - factor * b[k];
  return out;
}

Hypothesis hypothesis(const TorqueResidual& data, const std::string& text, const Rows& left, int free_numbers) {
  Hypothesis out{text, norm(left) / data.norm(), free_numbers};
  out.beyond = data.beyond(left);
  return out;
}

/// " (9.80665 m/s^2, standard gravity)" for common values.
std::string knownGravity(double value) {
  const std::pair<double, const char*> known[] = {
      {9.80665, "9.80665 m/s^2, standard gravity"}, {9.81, "9.81 m/s^2"}, {9.8, "9.8 m/s^2"}, {10, "10 m/s^2"}};
  for (const auto& [one, text] : known)
    if (std::abs(value / one - 1) < 2e-6) return fmt::format(" ({})", text);
  return "";
}

/// " (degrees for radians, squared)" of a term in rates that were taken in degrees.
std::string inDegrees(double factor) {
  const double once = std::abs(factor / degrees_per_radian - 1);
  const double twice = std::abs(factor / (degrees_per_radian * degrees_per_radian) - 1);
  if (once < 1e-4) return " (degrees for radians)";
  return twice < 1e-4 ? " (degrees for radians, squared)" : "";
}

/// Names (1 + c) times a term: omitted, wrong sign, or scaled; gravity also has a value.
std::optional<NamedCause> namedScale(const TorqueTerm& term, double factor) {
  if (term.term.empty()) return std::nullopt;
  if (std::abs(factor) < 1e-3) return NamedCause{CauseKind::missing_term, term.term, term.body};
  if (std::abs(factor + 1) < 1e-3) return NamedCause{CauseKind::sign, term.term, term.body};
  if (term.gravity > 0)
    return NamedCause{CauseKind::parameter, "gravity", "all", "manipulator.gravity", "m/s^2", term.gravity,
                      term.gravity * factor};
  const CauseKind kind = inDegrees(factor).empty() ? CauseKind::scale : CauseKind::units;
  return NamedCause{kind, term.term, term.body, "", "", 1, factor};
}

/// residual = c · term: the torques contain (1 + c) times the term.
std::optional<Hypothesis> scaledTerm(const TorqueResidual& data, const TorqueTerm& term) {
  const double size = norm(term.torques);
  if (!(size > 1e-9 * norm(data.exact))) return std::nullopt;  // no effect on this motion
  const double c = term.fixed ? *term.fixed : dot(data.residual, term.torques) / (size * size);
  const double factor = 1 + c;
  const Rows left = minus(data.residual, term.torques, c);
  if (term.fixed) return hypothesis(data, term.name, left, 0);
  std::string text = fmt::format("{} scaled by {}", term.name, factorText(c));
  if (std::abs(factor) < 1e-3) text = term.name + " left out";
  if (std::abs(factor + 1) < 1e-3) text = term.name + " with the wrong sign";
  if (term.gravity > 0) text += knownGravity(term.gravity * factor);
  text += inDegrees(factor);
  Hypothesis out = hypothesis(data, text, left, 1);
  out.named = namedScale(term, factor);
  return out;
}

std::optional<Hypothesis> scaled(const TorqueResidual& data) {
  const double c = dot(data.residual, data.exact) / std::max(dot(data.exact, data.exact), 1e-300);
  if (std::abs(c + 2) < 1e-9) return std::nullopt;  // the sign of every leg has its own hypothesis
  const std::string unit = unitOf(1 + c, data.motors);
  Hypothesis out = hypothesis(
      data,
      fmt::format("every torque scaled by {}{}", factorText(c), unit.empty() ? inDegrees(1 + c) : " (" + unit + ")"),
      minus(data.residual, data.exact, c), 1);
  out.beyond /= std::max(1.0, std::abs(1 + c));  // rounding grows with the torques
  out.named = NamedCause{unit.empty() ? CauseKind::scale : CauseKind::units, "", "all", "", "", 1, 1 + c};
  return out;
}

/// The result of a fit with one number per motor, naming the motors where it matters.
Hypothesis perLeg(const TorqueResidual& data, const Vector6d& fitted, const Rows& predicted,
                  const std::function<std::string(double, int)>& show, const std::string& what, NamedCause named) {
  std::string text;
  std::vector<int> legs;
  for (int i = 0; i < motor_count; ++i)
    if (std::abs(fitted(i)) > 0.01 * fitted.cwiseAbs().maxCoeff()) legs.push_back(i);
  for (int i : legs) text += fmt::format("{}{} on {}", text.empty() ? "" : ", ", show(fitted(i), i), data.motors(i));
  Hypothesis out = hypothesis(data, what + text, minus(data.residual, predicted, 1), motor_count);
  nameMotors(legs, named);
  if (legs.size() == 1) {
    named.found = *named.expected + fitted(legs.front());
  } else {
    named.expected.reset();
  }
  out.named = named;
  return out;
}

std::optional<Hypothesis> offsets(const TorqueResidual& data) {
  Vector6d mean = Vector6d::Zero();
  for (const Vector6d& row : data.residual) mean += row / static_cast<double>(data.residual.size());
  return perLeg(
      data, mean, Rows(data.residual.size(), mean),
      [&data](double value, int i) { return fmt::format("{:+.6g} {}", value, data.motors.unit(i)); },
      "a constant offset: ", NamedCause{CauseKind::offset, "", "", "", "", 0.0});
}

/// Names the unit if it is that of all moments or of all forces alone.
void nameUnit(const MotorNames& motors, const Vector6d& c, Hypothesis& out) {
  constexpr double little = 1e-6;
  for (const bool forces : {false, true}) {
    MotorNames of = motors;
    of.slides.fill(forces);
    const auto first = std::find(motors.slides.begin(), motors.slides.end(), forces) - motors.slides.begin();
    if (first == motor_count || motors.slides == of.slides) continue;
    const double factor = 1 + c(first);
    bool alike = true;
    for (int i = 0; i < motor_count; ++i) {
      const double right = motors.slides[i] == forces ? factor : 1;
      alike = alike && std::abs(1 + c(i) - right) <= little * std::abs(right);
    }
    if (const std::string unit = unitOf(factor, of); alike && !unit.empty()) {
      out.text += " (" + unit + ")";
      out.named->kind = CauseKind::units;
      out.named->expected = 1;
      out.named->found = factor;
    }
  }
}

std::optional<Hypothesis> gains(const TorqueResidual& data) {
  Vector6d over = Vector6d::Zero(), under = Vector6d::Zero();
  for (std::size_t k = 0; k < data.exact.size(); ++k) {
    over += data.residual[k].cwiseProduct(data.exact[k]);
    under += data.exact[k].cwiseProduct(data.exact[k]);
  }
  const Vector6d c = (under.array() > 0).select(over.cwiseQuotient(under), 0);
  Rows predicted;
  for (const Vector6d& row : data.exact) predicted.push_back(c.cwiseProduct(row));
  TorqueResidual wider = data;  // rounding grows with the torques
  for (Vector6d& row : wider.limit) row.array() *= (1 + c.array()).abs().cwiseMax(1.0);
  Hypothesis out = perLeg(
      wider, c, predicted, [](double value, int) { return "a factor of " + factorText(value); }, "",
      NamedCause{CauseKind::scale, "", "", "", "", 1.0});
  nameUnit(data.motors, c, out);
  return out;
}

}  // namespace

MotorNames motorNames(const Manipulator& machine) {
  MotorNames out;
  for (int k = 0; k < motor_count; ++k) {
    const Motor& motor = machine.motors()[k];
    out.one_a_leg = out.one_a_leg && motor.leg == k;
    out.slides[k] = motor.slides();
  }
  return out;
}

void TorqueResidual::add(const Motion<double>& motion, const Vector6d& right, const Vector6d& found,
                         const Vector6d& within) {
  motions.push_back(motion);
  exact.push_back(right);
  residual.push_back(found - right);
  limit.push_back(within);
}

void TorqueResidual::add(const TorqueResidual& other, std::size_t row) {
  motions.push_back(other.motions[row]);
  exact.push_back(other.exact[row]);
  residual.push_back(other.residual[row]);
  limit.push_back(other.limit[row]);
}

TorqueResidual TorqueResidual::alongMotion() const {
  TorqueResidual out = *this;
  out.motions.resize(commanded);
  for (auto* rows : {&out.exact, &out.residual, &out.limit}) rows->resize(commanded);
  return out;
}

TorqueResidual TorqueResidual::picked(std::size_t most) const {
  TorqueResidual out;
  out.motors = motors;
  const auto pick = [&](std::size_t first, std::size_t last, std::size_t at_most) {
    const std::size_t rows = last - first, count = std::min(rows, at_most);
    for (std::size_t i = 0; i < count; ++i) out.add(*this, first + (count == 1 ? 0 : i * (rows - 1) / (count - 1)));
  };
  const std::size_t rows = exact.size(), apart = rows - commanded;
  pick(0, commanded, most - std::min(apart, most / 2));
  out.commanded = out.exact.size();
  pick(commanded, rows, most / 2);
  return out;
}

double TorqueResidual::norm() const { return ursula::norm(residual); }

double TorqueResidual::growth() const {
  double most = 0, right = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    most = std::max(most, found(k).cwiseAbs().maxCoeff());
    right = std::max(right, exact[k].cwiseAbs().maxCoeff());
  }
  return right > 0 ? std::max(1.0, most / right) : 1;
}

double TorqueResidual::beyond(const std::vector<Vector6d>& left) const {
  double largest = 0;
  for (std::size_t k = 0; k < left.size(); ++k)
    for (int i = 0; i < motor_count; ++i) {
      const double share = std::abs(left[k](i)) / limit[k](i);
      if (!(share <= largest)) largest = share;  // NaN counts as the largest
    }
  return largest;
}

std::string unitOf(double factor, const MotorNames& motors) {
  using Known = std::vector<std::pair<double, const char*>>;
  static const Known tens = {
      {1e-1, "a power of ten"}, {1e1, "a power of ten"}, {1e-2, "a power of ten"}, {1e2, "a power of ten"}};
  static const Known of_moments = {{1e-3, "kN m for N m"},
                                   {1e3, "N mm or mN m for N m"},
                                   {1e-6, "MN m for N m"},
                                   {1e6, "uN m for N m"},
                                   {1e2, "N cm for N m"},
                                   {1e5, "dyn m for N m"},
                                   {1e7, "dyn cm for N m"},
                                   {0.017453292519943295, "degrees for radians"},
                                   {57.29577951308232, "degrees for radians"}};
  static const Known of_forces = {
      {1e-3, "kN for N"}, {1e3, "mN for N"}, {1e-6, "MN for N"}, {1e6, "uN for N"}, {1e5, "dyn for N"}};
  for (const Known* known : {motors.allSlide() ? &of_forces : &of_moments, &tens})
    for (const auto& [value, text] : *known)
      if (std::abs(factor / value - 1) < 1e-4) return text;
  const std::string right = motors.allSlide() ? "N" : "N m";
  for (const EffortUnit& unit : effortUnits()) {
    if (unit.multiplier == 1 || (unit.kind == EffortKind::force) != motors.allSlide()) continue;
    if (std::abs(factor * unit.inSI() - 1) < 1e-4) return unit.name + (" for " + right);
    if (std::abs(factor / unit.inSI() - 1) < 1e-4) return right + " taken for " + unit.name;
  }
  return factor < 0 && !unitOf(-factor, motors).empty() ? unitOf(-factor, motors) + ", with the wrong sign" : "";
}

std::vector<Hypothesis> fitHypotheses(const Scenario& scenario, const TorqueResidual& data) {
  std::vector<Hypothesis> out;
  Rows found;
  for (std::size_t k = 0; k < data.exact.size(); ++k) found.push_back(data.found(k));
  const double growth = data.norm() / std::max(norm(found), 1e-300);
  const auto add = [&out, growth](std::optional<Hypothesis> fitted) {
    if (!fitted || !std::isfinite(fitted->unexplained)) return;
    fitted->of_found = fitted->unexplained * growth;
    out.push_back(*fitted);
  };
  add(signsAndOrder(data));
  const std::vector<TorqueTerm> terms = torqueTerms(scenario, data.motions, data.exact);
  for (const TorqueTerm& term : terms)
    if (!term.fixed) add(scaledTerm(data, term));
  add(scaled(data));
  if (data.commanded >= 2) add(timeShift(scenario, data.alongMotion()));
  if (data.exact.size() >= 3) {
    add(offsets(data));
    add(gains(data));
  }
  for (const TorqueTerm& term : terms)
    if (term.fixed) add(scaledTerm(data, term));
  if (data.exact.size() >= 3) add(softLoops(scenario, data));
  TriedCauses tried{scenario};
  addEveryCause(tried);
  if (data.commanded == data.motions.size())  // and the solver was not asked at other instants
    addDifferenceCauses(data.instants, tried);
  for (const Hypothesis& fitted : fitCauses(tried.causes, data)) add(fitted);
  if (data.exact.size() >= 3)
    for (const Hypothesis& fitted : fitVectors(scenario, data)) add(fitted);
  return out;
}

}  // namespace ursula
