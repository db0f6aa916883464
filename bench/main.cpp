// All benchmarks in one process. First all engines must agree; if one does not, nothing is timed.

#include <algorithm>
#include <iostream>
#include <string>

#include "base/provenance.h"
#include "bench/benchmarks.h"

namespace ursula::bench {
namespace {

bool listsOnly(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](const std::string& argument) {
    return argument.rfind("--benchmark_list_tests", 0) == 0 && argument != "--benchmark_list_tests=false";
  });
}

bool allAgree(const Peers& peers) {
  std::vector<Agreement> all = agreementsOf(peers, helix());
  for (const Answers& answers : ownAnswers())
    for (Agreement& agreement : agreementsOf(answers, helix())) all.push_back(std::move(agreement));
  for (const Agreement& agreement : all) {
    std::cerr << toText(agreement) << '\n';
    benchmark::AddCustomContext("agreement/" + agreement.name + "/" + agreement.task, toText(agreement));
  }
  return std::all_of(all.begin(), all.end(), [](const Agreement& agreement) { return agreement.holds(); });
}

void describeBuild(const Peers& peers) {
  const BuildProvenance& build = buildProvenance();
  benchmark::AddCustomContext("commit", build.commit);
  benchmark::AddCustomContext("compiler", build.compiler);
  benchmark::AddCustomContext("flags", build.flags);
  benchmark::AddCustomContext("best_instructions", nameOf(bestInstructionSet()));
  benchmark::AddCustomContext("library/Eigen", build.eigen);
  for (const std::unique_ptr<Peer>& peer : peers)
    benchmark::AddCustomContext("library/" + peer->name(), peer->version());
}

int run(int argc, char** argv) {
  const bool lists_only = listsOnly(argc, argv);
  const Peers peers = makePeers(helix().manipulator());
  registerSideBySide(peers);
  registerBatches();
  registerLegKinds();
  registerMechanisms();
  registerDirectKinematics();
  registerDerivatives();
  registerSimulations();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  if (!lists_only) {
    for (const std::string& name : missingPeers())
      std::cerr << name << " is not installed: it is LEFT OUT of what follows\n";
    describeBuild(peers);
    if (!allAgree(peers)) {
      std::cerr << "not all agree: nothing is timed\n";
      return 1;
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace ursula::bench

int main(int argc, char** argv) {
  try {
    return ursula::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
