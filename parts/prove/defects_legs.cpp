// Defects in a leg of each kind: its angles, its links, its rows of A and B.

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "parts/prove/defects.h"

namespace ursula {
namespace {

using Model = LegModel<double>;
using ChangeState = void (*)(const Model&, LegState<double>&);

/// Sets axes and points of a leg from these sines, cosines and stroke, like its kernel.
void stand(const Model& model, LegState<double>& leg) {
  const auto planeAt = [&model](double sine, double cosine) -> std::pair<Vector3d, Vector3d> {
    return {cosine * model.x_hat + sine * model.z_hat, cosine * model.z_hat - sine * model.x_hat};
  };
  const auto& s = leg.sine;
  const auto& c = leg.cosine;
  const bool carriage = model.kind == LegKind::PUS, crank = model.kind == LegKind::RUS;
  auto [x_1, z] = carriage ? planeAt(s[1], c[1]) : planeAt(s[0], c[0]);
  Vector3d x_2 = x_1, along_1 = c[1] * model.u + s[1] * z, along_2 = along_1;
  if (crank) {
    const auto [x, z_2] = planeAt(s[0] * c[1] + c[0] * s[1], c[0] * c[1] - s[0] * s[1]);
    x_2 = x;
    along_1 = z;
    along_2 = s[2] * model.u + c[2] * z_2;
  } else if (carriage) {
    along_1 = model.u;
    along_2 = c[2] * model.u + s[2] * z;
  } else if (model.kind == LegKind::URS) {
    along_2 = -(c[1] * c[2] - s[1] * s[2]) * model.u - (s[1] * c[2] + c[1] * s[2]) * z;
  }
  leg.x_1 = leg.x = x_1;
  leg.z = z;
  leg.x_2 = x_2;
  leg.e = along_1;
  leg.along = along_2;
  leg.sin_sum = s[1] * c[2] + c[1] * s[2];
  leg.cos_sum = c[1] * c[2] - s[1] * s[2];
  leg.R_1 << x_1, along_1.cross(x_1), along_1;
  leg.R_2 << x_2, along_2.cross(x_2), along_2;
  if (carriage) leg.R_1 << model.x_hat, model.u, model.z_hat;
  leg.arm_1 = model.rho * along_1;
  leg.arm_2 = model.sigma * along_2;
  leg.O_1 = carriage ? Vector3d(c[0] * model.u) : Vector3d(Vector3d::Zero());
  leg.O_2 = carriage ? leg.O_1 : Vector3d(model.l * along_1);
  if (model.kind == LegKind::UPS) leg.O_2 = (c[2] - model.s) * along_1;
  leg.axis = {-model.u, x_1, x_1};
  if (model.kind == LegKind::UPS) leg.axis[2] = along_1;
  if (crank) leg.axis = {-model.u, -model.u, -x_2};
  if (carriage) leg.axis = {model.u, -model.u, x_1};
}

/// Returns a row of the leg's map q̇ = k · v_B, k = n / A.
Vector3d mapOf(const LegState<double>& leg, std::size_t j) { return leg.row[j].n / leg.row[j].A; }
void setMap(LegState<double>& leg, std::size_t j, const Vector3d& k) {
  leg.row[j].A = 1;
  leg.row[j].n = k;
}

/// One error in a leg of a kind, before or after its map is computed.
struct WrongLeg {
  LegKind kind;
  const char* what;
  ChangeState change;
  enum { angles, place, map } when = angles;
};

const std::vector<WrongLeg>& wrongLegs() {
  using K = LegKind;
  using W = WrongLeg;
  static const std::vector<WrongLeg> all = {
      {K::UPS, "phi by atan2(k_x, k_z)", [](const Model&, auto& leg) { leg.sine[0] *= -1; }},
      {K::UPS, "psi from the plane across the axis",
       [](const Model&, auto& leg) { std::swap(leg.sine[1], leg.cosine[1]); }},
      {K::UPS, "psi from -u", [](const Model&, auto& leg) { leg.cosine[1] *= -1; }},
      {K::UPS, "d from the rod's inner end", [](const Model& model, auto& leg) { leg.cosine[2] -= model.s; }},
      {K::UPS, "rod's inner end at d", [](const Model&, auto& leg) { leg.O_2 = leg.cosine[2] * leg.axis[2]; },
       W::place},
      {K::UPS, "rod's mass centre does not slide along",
       [](const Model& model, auto& leg) { leg.arm_2 = model.sigma * leg.axis[2] - leg.O_2; }, W::place},
      {K::UPS, "cylinder slides along with its rod", [](const Model&, auto& leg) { leg.arm_1 += leg.O_2; }, W::place},
      {K::UPS, "x of the plane reversed", [](const Model&, auto& leg) { leg.x *= -1; }, W::place},
      {K::UPS, "rod's tensor does not turn", [](const Model&, auto& leg) { leg.R_2.setIdentity(); }, W::place},
      {K::UPS, "phi's rate with d for its lever",
       [](const Model&, auto& leg) { setMap(leg, 0, mapOf(leg, 0) * leg.sine[1]); }, W::map},
      {K::UPS, "psi's rate with the stroke for d",
       [](const Model& model, auto& leg) {
         setMap(leg, 1, mapOf(leg, 1) * (leg.cosine[2] / (leg.cosine[2] - model.s)));
       },
       W::map},
      {K::UPS, "sign of d's rate", [](const Model&, auto& leg) { setMap(leg, 2, mapOf(leg, 2) * -1); }, W::map},
      {K::RUS, "crank along the line to B",
       [](const Model& model, auto& leg) {
         const double k_x = model.x_hat.dot(leg.AB), k_z = model.z_hat.dot(leg.AB), r = std::hypot(k_x, k_z);
         leg.sine[0] = -k_x / r;
         leg.cosine[0] = k_z / r;
       }},
      {K::RUS, "phi by atan2(k_x, k_z)", [](const Model&, auto& leg) { leg.sine[0] *= -1; }},
      {K::RUS, "sign of psi", [](const Model&, auto& leg) { leg.sine[1] *= -1; }},
      {K::RUS, "sign of theta", [](const Model&, auto& leg) { leg.sine[2] *= -1; }},
      {K::RUS, "theta from the axis", [](const Model&, auto& leg) { std::swap(leg.sine[2], leg.cosine[2]); }},
      {K::RUS, "rod turns about the crank's x", [](const Model&, auto& leg) { leg.x_2 = leg.x; }, W::place},
      {K::RUS, "rod's tensor in the crank's axes", [](const Model&, auto& leg) { leg.R_2 = leg.R_1; }, W::place},
      {K::RUS, "rod from A", [](const Model&, auto& leg) { leg.O_2.setZero(); }, W::place},
      {K::RUS, "phi's rate without cos theta",
       [](const Model&, auto& leg) { setMap(leg, 0, mapOf(leg, 0) * leg.cosine[2]); }, W::map},
      {K::RUS, "psi's rate that of phi + psi",
       [](const Model&, auto& leg) { setMap(leg, 1, mapOf(leg, 1) + mapOf(leg, 0)); }, W::map},
      {K::RUS, "theta's rate without cos theta",
       [](const Model&, auto& leg) { setMap(leg, 2, mapOf(leg, 2) * leg.cosine[2]); }, W::map},
      {K::PUS, "d by k_y + s cos theta",
       [](const Model& model, auto& leg) { leg.cosine[0] += 2 * model.s * leg.cosine[2]; }},
      {K::PUS, "psi by atan2(k_x, k_z)", [](const Model&, auto& leg) { leg.sine[1] *= -1; }},
      {K::PUS, "theta from the plane across the rail",
       [](const Model&, auto& leg) { std::swap(leg.sine[2], leg.cosine[2]); }},
      {K::PUS, "sign of cos theta", [](const Model&, auto& leg) { leg.cosine[2] *= -1; }},
      {K::PUS, "rod's tensor in the carriage's axes", [](const Model&, auto& leg) { leg.R_2 = leg.R_1; }, W::place},
      {K::PUS, "d's rate with the other sign of tan theta",
       [](const Model& model, auto& leg) { setMap(leg, 0, 2 * model.u - mapOf(leg, 0)); }, W::map},
      {K::PUS, "psi's rate without sin theta",
       [](const Model&, auto& leg) { setMap(leg, 1, mapOf(leg, 1) * leg.sine[2]); }, W::map},
      {K::PUS, "theta's rate without cos theta",
       [](const Model&, auto& leg) { setMap(leg, 2, mapOf(leg, 2) * leg.cosine[2]); }, W::map},
      {K::URS, "phi by atan2(k_x, k_z)", [](const Model&, auto& leg) { leg.sine[0] *= -1; }},
      {K::URS, "psi from -u", [](const Model&, auto& leg) { leg.cosine[1] *= -1; }},
      {K::URS, "sign of theta", [](const Model&, auto& leg) { leg.sine[2] *= -1; }},
      {K::URS, "distal tensor in the proximal link's axes", [](const Model&, auto& leg) { leg.R_2 = leg.R_1; },
       W::place}};
  return all;
}

WithFormulaErrors faultOf(const WrongLeg& wrong) {
  WithFormulaErrors fault;
  const auto change = [wrong](const Model& model, LegState<double>& leg) {
    if (model.kind != wrong.kind) return;
    wrong.change(model, leg);
    if (wrong.when == WrongLeg::angles) stand(model, leg);
  };
  (wrong.when == WrongLeg::map ? fault.change_rows : fault.change_leg) = change;
  return fault;
}

}  // namespace

std::vector<Defect> legDefects(const Manipulator& machine) {
  std::vector<Defect> out;
  for (const LegKind kind : kindsOf(machine)) {
    if (kind == LegKind::URS && machine.isOfThePaper()) continue;  // its printed formulas cover more
    for (const WrongLeg& wrong : wrongLegs())
      if (wrong.kind == kind)
        out.push_back(wrongFormula(fmt::format("{}: {}", rowOf(kind).name, wrong.what), "formula", faultOf(wrong)));
  }
  return out;
}

}  // namespace ursula
