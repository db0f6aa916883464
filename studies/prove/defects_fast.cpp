// Defects in the users' kernels: in a kernel's input, and in the answers of one kernel or one instruction set.

#include "studies/prove/defect_helpers.h"

namespace ursula {
namespace {

using FastModel = kernel::MachineModel<double>;
using FastLeg = kernel::PlaneModel<double>;

Defect wrongFast(const std::string& name, const FastFault& fault) {
  Defect out{name, "fast"};
  out.fault.fast = fault;
  out.engines = 1;
  return out;
}

Defect numbers(const char* name, const std::function<void(FastModel&)>& change) {
  FastFault fault;
  fault.model = change;
  return wrongFast(name, fault);
}

Defect ofLegs(const char* name, const std::function<void(FastLeg&)>& change) {
  return numbers(name, [change](FastModel& machine) {
    for (int i = 0; i < machine.legs_in_all; ++i) change(machine.legs[static_cast<std::size_t>(i)]);
  });
}

using Answers = std::vector<Vector6d> FastAnswers::*;

/// Changes one kind of answer of one instruction set; has no effect if the processor lacks the set.
Defect answers(const std::string& name, InstructionSet set, Answers of, const std::function<void(Vector6d&)>& change) {
  FastFault fault;
  fault.answers = [set, of, change](FastAnswers& found) {
    if (found.set != set) return;
    for (Vector6d& each : found.*of) change(each);
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
                 answers(with + "batch's efforts times 1.001", set, &FastAnswers::torques_in_batch, scaled),
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

}  // namespace ursula
