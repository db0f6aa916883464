#include "validation/findings/findings.h"

#include <fmt/format.h>

#include "base/provenance.h"
#include "base/sha1.h"
#include "engines/mujoco/mujoco_loop.h"
#include "nocsolver/fast/instruction_set.h"
#include "validation/replay/replay.h"

namespace ursula {

namespace {

const char* formulationInWords(const std::string& formulation) {
  if (formulation == "noc") return "noc: T formed, efforts by (37), accelerations by (36)";
  return formulation == "fast" ? "fast: the kernels that users call" : "external: a solver or file of the user";
}

}  // namespace

void addProvenance(const Scenario& scenario, const std::string& subject, ValidationResult& result) {
  const BuildProvenance& build = buildProvenance();
  result.provenance = {{"scenario file", scenario.file.filename().string()},
                       {"scenario sha1", sha1(scenario.text)},
                       {"subject", subject},
                       {"formulation", formulationInWords(result.formulation)},
                       {"ursula", build.version},
                       {"commit", build.commit},
                       {"compiler", build.compiler},
                       {"flags", build.flags},
                       {"build type", build.build_type},
                       {"Eigen", build.eigen},
                       {"Boost", build.boost},
                       {"Simbody", build.simbody},
                       {"MuJoCo", mujocoVersion()},
                       {"instruction set", nameOf(bestInstructionSet())},
                       {"trajectory", scenario.trajectory->kind()},
                       {"duration", fmt::format("{} s", scenario.trajectory->duration())},
                       {"samples", fmt::format("{}", scenario.simulation.samples)},
                       {"integrator", name(scenario.simulation.integrator)},
                       {"tolerance", fmt::format("{:g}", scenario.simulation.tolerance)}};
  if (!scenario.tolerance) return;
  const auto add = [&result](const char* key, double value) {
    if (value > 0) result.provenance.emplace_back(key, fmt::format("{}", value));
  };
  add("relative tolerance of efforts", scenario.tolerance->relative);
  add("absolute tolerance of efforts", scenario.tolerance->absolute);
  if (scenario.tolerance->any) result.provenance.emplace_back("any tolerance", "yes");
}

}  // namespace ursula
