// Terms of noc/ and of the paper's leg that are wrong: as printed, left out, or off by little for one leg, in one frame
// or in one system of units.

#include <Eigen/Geometry>
#include <algorithm>

#include "validation/prove/defects_kit.h"

namespace ursula {

Defect wrongFormula(const std::string& name, const char* group, const WithSlips& fault) {
  return {name, group, [fault](const Scenario& s) { return wrongNocSubject(*s.manipulator, s.load, fault); }};
}

namespace {

using Read = MachineParameters<double>;

Defect slip(const char* name, const char* group, Slip which) { return wrongFormula(name, group, WithSlips(which)); }

Defect slipInDirect(const char* name, Slip which) {
  Defect out = slip(name, "direct", which);
  out.roads = 1;
  return out;
}

Defect read(const char* name, const char* group, const std::function<void(Read&)>& change) {
  WithSlips fault;
  fault.change_read = change;
  return wrongFormula(name, group, fault);
}

/// What is wrong in one frame or in one system of units alone, only a change of them shows.
Defect readElsewhere(const char* name, const std::function<void(Read&)>& change) {
  Defect out = read(name, "one frame", change);
  out.roads = 1;
  return out;
}

Defect slipInConstraints(const char* name, Slip which) {
  Defect out = slip(name, "complement", which);
  out.roads = 1;
  return out;
}

/// Large against rounding, small against anything that a person would see in a plot.
constexpr double off = 1e-6;

bool has(const Manipulator& machine, LegKind kind) {
  const std::vector<LegKind> kinds = kindsOf(machine);
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// The formulas of the paper's leg.
std::vector<Defect> ofPapersLeg(const Manipulator& machine) {
  std::vector<Defect> out = {slip("(2) as printed: frame without tilt", "formula", Slip::eq2),
                             slip("(4c) as printed: q^2", "formula", Slip::eq4c),
                             slip("(5) as printed: +a", "formula", Slip::eq5),
                             slip("(14a) as printed: phi in [0, pi]", "formula", Slip::eq14a),
                             slip("(14b) as printed: -k_y", "formula", Slip::eq14b),
                             slip("(15a) as printed", "formula", Slip::eq15a),
                             slip("(15b) as printed: theta", "formula", Slip::eq15b),
                             slip("(16) as printed: -omega", "formula", Slip::eq16),
                             slip("(17) as printed: -omega_dot", "formula", Slip::eq17),
                             slip("(19a) as printed", "formula", Slip::eq19a),
                             slip("(19b) as printed", "formula", Slip::eq19b),
                             slip("(43b) as printed: Omega_dot^2", "formula", Slip::eq43b_omega_dot),
                             slip("(43b) as printed: sigma + s", "formula", Slip::eq43b_sigma),
                             slip("(43b) as printed: doubled", "formula", Slip::eq43b_doubled)};
  if (machine.isOfThePaper())
    append(out, {slip("(23) as printed: a_ii", "formula", Slip::eq23),
                 slip("(26) as printed: a_ii_dot", "formula", Slip::eq26_a_dot)});
  else
    for (Defect& defect : out) defect.name = "URS: " + defect.name;
  return out;
}

/// Every equation of section 3, and what of section 2 is the same for all legs.
std::vector<Defect> ofSectionThree(const Manipulator& machine) {
  std::vector<Defect> out = {
      slip("(26) as printed: B_dot", "formula", Slip::eq26_b_dot),
      slip("(25): A_dot and B_dot left out", "formula", Slip::drop_row_rates),
      slip("(28), (38): no gyroscopic terms, links", "term", Slip::drop_gyroscopic_legs),
      slip("(28), (38): no gyroscopic terms, platform", "term", Slip::drop_gyroscopic_platform),
      slip("(29): M of the platform without its inertia", "term", Slip::mass_for_inertia),
      slip("(29): M without the masses of the distal links", "term", Slip::drop_mass_distal),
      slipInConstraints("(33): D with the spherical joints at the distal links' first ends", Slip::wrong_D),
      slipInConstraints("(33): D with one row twice", Slip::lost_constraint),
      slipInDirect("(34): C without M T_dot", Slip::drop_T_rate),
      slipInDirect("(34): C without W M T", Slip::drop_W),
      slip("(35): no friction", "term", Slip::drop_friction),
      slip("(35): no load", "term", Slip::drop_load),
      slipInDirect("(36): without tau_g", Slip::drop_tau_g),
      slipInDirect("(36): without tau_d", Slip::drop_tau_d),
      slip("(37): without the inertia wrench", "formula", Slip::drop_inertia),
      slip("(37) times 1.001", "formula", Slip::scaled_efforts),
      slip("(37) of motor 1 times 1 + 1e-7", "formula", Slip::scaled_first_effort),
      slip("(43): no centrifugal terms", "term", Slip::drop_centrifugal),
      slip("(43): no Coriolis terms", "term", Slip::drop_coriolis),
      slip("(43c): no centripetal term, platform", "term", Slip::drop_platform_centripetal),
      slip("(45): no gravity on links", "term", Slip::drop_gravity_legs),
      slip("(45): no gravity on platform", "term", Slip::drop_gravity_platform),
      slip("(46a,b): tensors of links not turned", "frame", Slip::untwisted_tensors),
      slip("(46c): tensor of the platform not turned", "frame", Slip::untwisted_platform),
      slip("(47) as in the text: Qb - rho", "formula", Slip::eq47),
      slip("(48) without the driven joints' own rates", "formula", Slip::drop_own_column),
      slip("(48) without the rates of the other joints", "formula", Slip::drop_passive_rates),
      slip("(41), (43): no coupling through the middle joint", "term", Slip::drop_link_coupling),
      {"load left out", "term", [](const Scenario& s) { return nocSubject(*s.manipulator, nullptr); }}};
  if (machine.isOfThePaper()) return out;
  append(out, {slip("accelerations of joints without A_dot and n_dot", "formula", Slip::drop_bias),
               slip("(23): half of A", "formula", Slip::eq23)});
  if (has(machine, LegKind::UPS))
    out.push_back(slip("Coriolis terms of what slides once for twice", "term", Slip::half_coriolis));
  return out;
}

bool upright(const Read& machine) {
  const double g = machine.gravity.norm();
  return g > 0 && machine.gravity.z() <= -0.99 * g;
}

/// Off by 1e-6 for one leg, in one frame, in one system of units.
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

}  // namespace

std::vector<Defect> formulaDefects(const Manipulator& machine) {
  std::vector<Defect> out;
  if (has(machine, LegKind::URS)) out = ofPapersLeg(machine);
  append(out, ofSectionThree(machine));
  append(out, ofLegFrameAndUnit());
  append(out, {control(wrongFormula("no fault", "control", WithSlips()))});
  return out;
}

}  // namespace ursula
