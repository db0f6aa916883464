#include "validation/findings/run_provenance.h"

#include <fmt/format.h>

#include <boost/uuid/detail/sha1.hpp>

#include "model/loops/mujoco/mujoco_loop.h"
#include "nocsolver/instruction_set.h"
#include "validation/findings/provenance.h"
#include "validation/replay/replay.h"

namespace ursula {
namespace {

std::string sha1(const std::string& text) {
  boost::uuids::detail::sha1 hash;
  hash.process_bytes(text.data(), text.size());
  boost::uuids::detail::sha1::digest_type digest;
  hash.get_digest(digest);
  std::string out;
  for (unsigned word : digest) out += fmt::format("{:08x}", word);
  return out;
}

}  // namespace

void addProvenance(const Scenario& scenario, const std::string& subject, ValidationResult& result) {
  const BuildProvenance& build = buildProvenance();
  result.provenance = {{"scenario file", scenario.file.filename().string()},
                       {"scenario sha1", sha1(scenario.text)},
                       {"subject", subject},
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
}

}  // namespace ursula
