#include "validation/prove/defects_kit.h"

namespace ursula {
namespace {

Defect slip(const char* name, const char* group, Slip which) {
  return {name, group, [which](const Scenario& s) { return slippedSubject(*s.manipulator, s.load, WithSlips(which)); }};
}

}  // namespace

std::vector<Defect> printedFormulas() {
  return {slip("(2) as printed: frame without tilt", "formula", Slip::eq2),
          slip("(4c) as printed: q^2", "formula", Slip::eq4c),
          slip("(5) as printed: +a", "formula", Slip::eq5),
          slip("(14a) as printed: phi in [0, pi]", "formula", Slip::eq14a),
          slip("(14b) as printed: -k_y", "formula", Slip::eq14b),
          slip("(15a) as printed", "formula", Slip::eq15a),
          slip("(16) as printed: -omega", "formula", Slip::eq16),
          slip("(17) as printed: -omega_dot", "formula", Slip::eq17),
          slip("(19a) as printed", "formula", Slip::eq19a),
          slip("(19b) as printed", "formula", Slip::eq19b),
          slip("(23) as printed: a_ii", "formula", Slip::eq23),
          slip("(26) as printed: a_ii_dot", "formula", Slip::eq26_a_dot),
          slip("(26) as printed: B_dot", "formula", Slip::eq26_b_dot),
          slip("(43b) as printed: Omega_dot^2", "formula", Slip::eq43b_omega_dot),
          slip("(43b) as printed: sigma + s", "formula", Slip::eq43b_sigma),
          slip("(43b) as printed: doubled", "formula", Slip::eq43b_doubled),
          slip("(47) as in the text: Qb - rho", "formula", Slip::eq47),
          slip("no centrifugal terms", "term", Slip::drop_centrifugal),
          slip("no Coriolis terms", "term", Slip::drop_coriolis),
          slip("no gyroscopic terms, links", "term", Slip::drop_gyroscopic_legs),
          slip("no gyroscopic terms, platform", "term", Slip::drop_gyroscopic_platform),
          slip("no centripetal term, platform", "term", Slip::drop_platform_centripetal),
          slip("no gravity on links", "term", Slip::drop_gravity_legs),
          slip("no gravity on platform", "term", Slip::drop_gravity_platform),
          slip("no friction", "term", Slip::drop_friction),
          slip("no coupling through the knee", "term", Slip::drop_link_coupling),
          {"load left out", "term", [](const Scenario& s) { return nocSubject(*s.manipulator, nullptr); }}};
}

}  // namespace ursula
