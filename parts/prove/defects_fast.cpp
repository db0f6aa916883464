// This file has defects in the users' kernels: in a kernel's input, and in the answers of one kernel or one instruction
// set. It also has wrong terms of noc/ and of the paper's leg: as printed, omitted, or slightly off for one leg, in one
// frame or in one system of units.

#include <Eigen/Geometry>
#include <algorithm>

#include "parts/fast/fast_samples.h"
#include "parts/prove/defects.h"

namespace ursula {
namespace {

using FastModel = kernel::MachineModel<double>;
using FastLeg = kernel::PlaneModel<double>;

Defect wrongFast(const std::string& name, const FastFault& fault) {
  Defect out{name, "fast"};
  out.fault.witness = std::make_shared<FastFault>(fault);
  out.formulations_wanted = 1;
  return out;
}

Defect numbers(const char* name, const std::function<void(FastModel&)>& change) {
  FastFault fault;
  fault.model = change;
  return wrongFast(name, fault);
}

Defect ofLegs(const char* name, const std::function<void(FastLeg&)>& change) {
  return numbers(name, [change](FastModel& machine) {
    for (int i = 0; i < machine.legs_in_all; ++i) change(machine.legs[i]);
  });
}

using Answers = std::vector<Vector6d> FastAnswers::*;

/// Changes one kind of answer of one instruction set, from the pose `first` on; has no effect if the processor lacks
/// the set.
Defect answers(const std::string& name, InstructionSet set, Answers of, const std::function<void(Vector6d&)>& change,
               std::size_t first = 0) {
  FastFault fault;
  fault.answers = [set, of, change, first](FastAnswers& found) {
    for (std::size_t k = first; found.set == set && k < (found.*of).size(); ++k) change((found.*of)[k]);
  };
  return wrongFast(name, fault);
}

}  // namespace

std::vector<Defect> fastDefects(const Manipulator&) {
  std::vector<Defect> out = {
      ofLegs("fast: displacement with another base point", [](FastLeg& leg) { leg.a *= 1 + 1e-6; }),
      ofLegs("fast: displacement with another distal length", [](FastLeg& leg) { leg.s *= 1 + 1e-6; }),
      ofLegs("fast: rates with another 1/l, 1/s",
             [](FastLeg& leg) { leg.per_l *= 1 + 1e-6, leg.per_s *= 1 + 1e-6, leg.a *= 1 + 1e-6; }),
      ofLegs("fast: links' forces without gravity", [](FastLeg& leg) { leg.minus_gravity.setZero(); }),
      ofLegs("fast: links' forces with m rho for the first moment",
             [](FastLeg& leg) { leg.first_1 *= 1 + 1e-6, leg.first_2 *= 1 + 1e-6; }),
      ofLegs("fast: distal tensor about the mass centre", [](FastLeg& leg) { leg.J_2 = leg.I_2, leg.I_2 *= 2; }),
      ofLegs("fast: proximal tensor doubled", [](FastLeg& leg) { leg.J_1 *= 2; }),
      ofLegs("fast: friction left out", [](FastLeg& leg) { leg.has_friction = leg.has_coulomb = false; }),
      ofLegs("fast: products of inertia left out",
             [](FastLeg& leg) { leg.principal = true, leg.J_1 = Matrix3d(leg.J_1.diagonal().asDiagonal()); }),
      numbers("fast: platform without gravity", [](FastModel& m) { m.gravity.setZero(); }),
      numbers("fast: platform's mass centre", [](FastModel& m) { m.rho *= 1 + 1e-6; }),
      numbers("fast: platform's mass", [](FastModel& m) { m.mass *= 1 + 1e-6; }),
      numbers("fast: platform's tensor off in one entry", [](FastModel& m) { m.I_M(0, 0) *= 1 + 1e-5; })};
  const auto scaled = [](Vector6d& v) { v *= 1.001; };
  const auto first = [](Vector6d& v) { v(0) *= 1 + 1e-7; };
  const auto lost = [](Vector6d& v) { v.setConstant(std::nan("")); };
  for (const InstructionSet set :
       {InstructionSet::portable, InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!isSupported(set)) continue;
    const std::string with = std::string("fast, ") + nameOf(set) + ": ";
    append(out, {answers(with + "efforts times 1.001", set, &FastAnswers::torques, scaled),
                 answers(with + "accelerations times 1.001", set, &FastAnswers::accelerations, scaled),
                 answers(with + "batch's efforts times 1.001 from pose 5,000 on", set, &FastAnswers::torques_in_batch,
                         scaled, 5000),
                 answers(with + "batch's effort of motor 1 times 1 + 1e-7", set, &FastAnswers::torques_in_batch, first),
                 answers(with + "batch's accelerations times 1.001", set, &FastAnswers::accelerations_in_batch, scaled),
                 answers(with + "batch without answers", set, &FastAnswers::torques_in_batch, lost)});
  }
  FastFault none;
  none.model = [](FastModel&) {};
  none.answers = [](FastAnswers&) {};
  append(out, {control(wrongFast("fast: no fault", none))});
  return out;
}

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
  out.formulations_wanted = 1;
  return out;
}

Defect read(const char* name, const char* group, const std::function<void(Read&)>& change) {
  WithFormulaErrors fault;
  fault.change_read = change;
  return wrongFormula(name, group, fault);
}

/// Makes an error in only one frame or system of units, so that only a change of them reveals it.
Defect readElsewhere(const char* name, const std::function<void(Read&)>& change) {
  Defect out = read(name, "one frame", change);
  out.formulations_wanted = 1;
  return out;
}

Defect formulaErrorInConstraints(const char* name, FormulaError which) {
  Defect out = formula_error(name, "complement", which);
  out.formulations_wanted = 1;
  return out;
}

/// This is large relative to rounding, but invisible in a plot.
constexpr double off = 1e-6;

bool has(const Manipulator& machine, LegKind kind) {
  const std::vector<LegKind> kinds = kindsOf(machine);
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// Returns the defects in the formulas of the paper's leg.
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

/// Returns the defects in the equations of section 3, and in the parts of section 2 that all legs share.
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

/// Returns the defects whose terms are off by 1e-6 for one leg, in one frame, or in one system of units.
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
    LegModel<double>& leg = machine.legs[motor.leg];
    leg.has_rotor = true;
    return leg.rotor[motor.joint];
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
