// Wrong terms of noc/ and of the paper's leg: as printed, omitted, or slightly off for one leg, in one frame or in one
// system of units.

#include <Eigen/Geometry>
#include <algorithm>

#include "studies/prove/defect_helpers.h"

namespace ursula {

Defect wrongFormula(const std::string& name, const char* group, const WithFormulaErrors& fault) {
  return {name, group, [fault](const Scenario& s) { return wrongNocSubject(*s.manipulator, s.load, fault); }};
}

namespace {

using Read = MachineParameters<double>;

Defect formula_error(const char* name, const char* group, FormulaError which) {
  return wrongFormula(name, group, WithFormulaErrors(which));
}

Defect formulaErrorInDirect(const char* name, FormulaError which) {
  Defect out = formula_error(name, "direct", which);
  out.engines = 1;
  return out;
}

Defect read(const char* name, const char* group, const std::function<void(Read&)>& change) {
  WithFormulaErrors fault;
  fault.change_read = change;
  return wrongFormula(name, group, fault);
}

/// An error in only one frame or system of units; only a change of them reveals it.
Defect readElsewhere(const char* name, const std::function<void(Read&)>& change) {
  Defect out = read(name, "one frame", change);
  out.engines = 1;
  return out;
}

Defect formulaErrorInConstraints(const char* name, FormulaError which) {
  Defect out = formula_error(name, "complement", which);
  out.engines = 1;
  return out;
}

/// This is large relative to rounding, but invisible in a plot.
constexpr double off = 1e-6;

bool has(const Manipulator& machine, LegKind kind) {
  const std::vector<LegKind> kinds = kindsOf(machine);
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// The formulas of the paper's leg.
std::vector<Defect> ofPapersLeg(const Manipulator& machine) {
  std::vector<Defect> out = {formula_error("(2) as printed: frame without tilt", "formula", FormulaError::eq2),
                             formula_error("(4c) as printed: q^2", "formula", FormulaError::eq4c),
                             formula_error("(5) as printed: +a", "formula", FormulaError::eq5),
                             formula_error("(14a) as printed: phi in [0, pi]", "formula", FormulaError::eq14a),
                             formula_error("(14b) as printed: -k_y", "formula", FormulaError::eq14b),
                             formula_error("(15a) as printed", "formula", FormulaError::eq15a),
                             formula_error("(15b) as printed: theta", "formula", FormulaError::eq15b),
                             formula_error("(16) as printed: -omega", "formula", FormulaError::eq16),
                             formula_error("(17) as printed: -omega_dot", "formula", FormulaError::eq17),
                             formula_error("(19a) as printed", "formula", FormulaError::eq19a),
                             formula_error("(19b) as printed", "formula", FormulaError::eq19b),
                             formula_error("(43b) as printed: Omega_dot^2", "formula", FormulaError::eq43b_omega_dot),
                             formula_error("(43b) as printed: sigma + s", "formula", FormulaError::eq43b_sigma),
                             formula_error("(43b) as printed: doubled", "formula", FormulaError::eq43b_doubled)};
  if (machine.isOfThePaper())
    append(out, {formula_error("(23) as printed: a_ii", "formula", FormulaError::eq23),
                 formula_error("(26) as printed: a_ii_dot", "formula", FormulaError::eq26_a_dot)});
  else
    for (Defect& defect : out) defect.name = "URS: " + defect.name;
  return out;
}

/// Every equation of section 3, and the parts of section 2 that all legs share.
std::vector<Defect> ofSectionThree(const Manipulator& machine) {
  std::vector<Defect> out = {
      formula_error("(26) as printed: B_dot", "formula", FormulaError::eq26_b_dot),
      formula_error("(25): A_dot and B_dot left out", "formula", FormulaError::drop_row_rates),
      formula_error("(28), (38): no gyroscopic terms, links", "term", FormulaError::drop_gyroscopic_legs),
      formula_error("(28), (38): no gyroscopic terms, platform", "term", FormulaError::drop_gyroscopic_platform),
      formula_error("(29): M of the platform without its inertia", "term", FormulaError::mass_for_inertia),
      formula_error("(29): M without the masses of the distal links", "term", FormulaError::drop_mass_distal),
      formulaErrorInConstraints("(33): D with the spherical joints at the distal links' first ends",
                                FormulaError::wrong_D),
      formulaErrorInConstraints("(33): D with one row twice", FormulaError::lost_constraint),
      formulaErrorInDirect("(34): C without M T_dot", FormulaError::drop_T_rate),
      formulaErrorInDirect("(34): C without W M T", FormulaError::drop_W),
      formula_error("(35): no friction", "term", FormulaError::drop_friction),
      formula_error("(35): no load", "term", FormulaError::drop_load),
      formulaErrorInDirect("(36): without tau_g", FormulaError::drop_tau_g),
      formulaErrorInDirect("(36): without tau_d", FormulaError::drop_tau_d),
      formula_error("(37): without the inertia wrench", "formula", FormulaError::drop_inertia),
      formula_error("(37) times 1.001", "formula", FormulaError::scaled_efforts),
      formula_error("(37) of motor 1 times 1 + 1e-7", "formula", FormulaError::scaled_first_effort),
      formula_error("(43): no centrifugal terms", "term", FormulaError::drop_centrifugal),
      formula_error("(43): no Coriolis terms", "term", FormulaError::drop_coriolis),
      formula_error("(43c): no centripetal term, platform", "term", FormulaError::drop_platform_centripetal),
      formula_error("(45): no gravity on links", "term", FormulaError::drop_gravity_legs),
      formula_error("(45): no gravity on platform", "term", FormulaError::drop_gravity_platform),
      formula_error("(46a,b): tensors of links not turned", "frame", FormulaError::untwisted_tensors),
      formula_error("(46c): tensor of the platform not turned", "frame", FormulaError::untwisted_platform),
      formula_error("(47) as in the text: Qb - rho", "formula", FormulaError::eq47),
      formula_error("(48) without the driven joints' own rates", "formula", FormulaError::drop_own_column),
      formula_error("(48) without the rates of the other joints", "formula", FormulaError::drop_passive_rates),
      formula_error("(41), (43): no coupling through the middle joint", "term", FormulaError::drop_link_coupling),
      {"load left out", "term", [](const Scenario& s) { return nocSubject(*s.manipulator, nullptr); }}};
  if (machine.isOfThePaper()) return out;
  append(out, {formula_error("accelerations of joints without A_dot and n_dot", "formula", FormulaError::drop_bias),
               formula_error("(23): half of A", "formula", FormulaError::eq23)});
  if (has(machine, LegKind::UPS))
    out.push_back(formula_error("Coriolis terms of what slides once for twice", "term", FormulaError::half_coriolis));
  return out;
}

bool upright(const Read& machine) {
  const double g = machine.gravity.norm();
  return g > 0 && machine.gravity.z() <= -0.99 * g;
}

/// Terms that are off by 1e-6 for one leg, in one frame, or in one system of units.
std::vector<Defect> ofLegFrameAndUnit() {
  const auto first = [](Read& m) -> LegModel<double>& { return m.legs.front(); };
  return {read("leg 1 alone: distal mass", "leg", [=](Read& m) { first(m).mass_2 *= 1 + off; }),
          read("leg 1 alone: proximal length", "leg", [=](Read& m) { first(m).l *= 1 + off; }),
          read("leg 1 alone: distal tensor's largest entry", "leg", [=](Read& m) { first(m).I_2 *= 1 + off; }),
          read("leg 1 alone: platform point", "leg", [=](Read& m) { first(m).b *= 1 + off; }),
          read("leg 1 alone: axis tilted", "leg",
               [=](Read& m) {
                 LegModel<double>& leg = first(m);
                 const Vector3d tilted = (leg.u + off * leg.x_hat).normalized();
                 leg.x_hat = (leg.x_hat - off * leg.u).normalized();
                 leg.u = tilted;
                 leg.z_hat = leg.x_hat.cross(leg.u);
               }),
          read("gravity's z", "frame", [](Read& m) { m.gravity.z() *= 1 + off; }),
          read("a product of the platform's inertia", "frame",
               [](Read& m) {
                 const double more = off * m.I_M.norm();
                 m.I_M(0, 1) += more;
                 m.I_M(1, 0) += more;
               }),
          readElsewhere("platform's mass, unless gravity is along -z",
                        [](Read& m) {
                          if (!upright(m)) m.mass *= 1 + off;
                        }),
          readElsewhere("platform's mass, where gravity points up",
                        [](Read& m) {
                          if (m.gravity.z() > 0) m.mass *= 1 + off;
                        }),
          readElsewhere("platform's mass, where platform points are off its xy plane",
                        [](Read& m) {
                          const Vector3d& b = m.legs.front().b;
                          if (std::abs(b.z()) > 0.3 * b.norm()) m.mass *= 1 + off;
                        }),
          readElsewhere("platform's mass, where lengths are under 0.1",
                        [](Read& m) {
                          if (m.length < 0.1) m.mass *= 1 + off;
                        }),
          readElsewhere("platform's mass, where lengths are over 30",
                        [](Read& m) {
                          if (m.length > 30) m.mass *= 1 + off;
                        }),
          readElsewhere("platform's mass, where leg 1 begins at y > 0", [](Read& m) {
            if (m.legs.front().a.y() > 0.1 * m.length) m.mass *= 1 + off;
          })};
}

/// Gives each motor the next one's rotor; equal motors would hide the change.
void passRotorsOn(Read& machine) {
  const auto rotorOf = [&machine](const Motor& motor) -> double& {
    LegModel<double>& leg = machine.legs[static_cast<std::size_t>(motor.leg)];
    leg.has_rotor = true;
    return leg.rotor[static_cast<std::size_t>(motor.joint)];
  };
  for (std::size_t m = 0; m + 1 < machine.motors.size(); ++m)
    std::swap(rotorOf(machine.motors[m]), rotorOf(machine.motors[m + 1]));
}

std::vector<Defect> ofRotors() {
  return {formula_error("(36), (37): rotor inertia left out", "term", FormulaError::drop_rotor),
          read("rotor inertia on the wrong motor", "index", passRotorsOn)};
}

}  // namespace

std::vector<Defect> formulaDefects(const Manipulator& machine) {
  std::vector<Defect> out;
  if (has(machine, LegKind::URS)) out = ofPapersLeg(machine);
  append(out, ofSectionThree(machine));
  append(out, ofLegFrameAndUnit());
  if (hasRotors(machine)) append(out, ofRotors());
  append(out, {control(wrongFormula("no fault", "control", WithFormulaErrors()))});
  return out;
}

}  // namespace ursula
