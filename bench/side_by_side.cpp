// Inverse and direct dynamics along the paper's helix, by every formulation of the solver and by every peer.

#include "bench/benchmarks.h"

namespace ursula::bench {

void countPoses(benchmark::State& state, double poses) {
  using benchmark::Counter;
  state.counters["per_pose"] = Counter(poses, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

std::vector<InstructionSet> instructionSets() {
  std::vector<InstructionSet> out;
  for (const InstructionSet set :
       {InstructionSet::portable, InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512})
    if (isSupported(set)) out.push_back(set);
  return out;
}

namespace {

/// Times the way from pose, twist and twist rate of the platform to six efforts, and from pose, twist and efforts to
/// the twist rate.
template <class Solving>
void registerScalar(const std::string& name, const Solving& solving) {
  benchmark::RegisterBenchmark(("inverse/" + name).c_str(), [solving](benchmark::State& state) {
    roundPoses(state, [&](std::size_t k) { return solving.inverse(k); });
  });
  benchmark::RegisterBenchmark(("direct/" + name).c_str(), [solving](benchmark::State& state) {
    roundPoses(state, [&](std::size_t k) { return solving.direct(k); });
  });
}

struct Fast {
  std::shared_ptr<FastDynamics<double>> dynamics = std::make_shared<FastDynamics<double>>(helix().manipulator());

  Vector6d inverse(std::size_t k) const { return dynamics->inverseDynamics(helix().motions[k]); }
  Vector6d direct(std::size_t k) const { return dynamics->directDynamics(helix().motions[k], helix().efforts[k]); }
};

struct ByNoc {
  std::shared_ptr<Noc<double>> noc = std::make_shared<Noc<double>>(helix().manipulator());
  std::shared_ptr<NocWorkspace<double>> work = std::make_shared<NocWorkspace<double>>();

  Vector6d inverse(std::size_t k) const { return noc->inverseDynamics(helix().motions[k], *work); }
  Vector6d direct(std::size_t k) const { return noc->directDynamics(helix().motions[k], helix().efforts[k], *work); }
};

template <class Solving>
Answers scalarAnswers(const std::string& name, const Solving& solving) {
  Answers out{name, {}, {}, {}};
  for (std::size_t k = 0; k < Poses::count; ++k) {
    out.efforts.push_back(solving.inverse(k));
    out.twist_rates.push_back(solving.direct(k));
  }
  return out;
}

Answers batchAnswers(InstructionSet set) {
  const Poses& poses = helix();
  const BatchDynamics dynamics(poses.manipulator(), set);
  const std::size_t count = poses.motions.size();
  Answers out{
      std::string("ursula, batch ") + nameOf(set), std::vector<Vector6d>(count), std::vector<Vector6d>(count), {}};
  std::vector<PoseFault> faults(count);
  dynamics.inverseDynamics(poses.motions.data(), count, out.efforts.data(), faults.data());
  dynamics.directDynamics(poses.motions.data(), poses.efforts.data(), count, out.twist_rates.data(), faults.data());
  return out;
}

std::vector<TreeCoordinates> coordinatesOf(const Peer& peer) {
  std::vector<TreeCoordinates> out(Poses::count);
  for (std::size_t k = 0; k < out.size(); ++k) peer.coordinates(helix().motions[k], helix().joints[k], out[k]);
  return out;
}

/// Times a peer from the joints' motion, without and with the time in which the closed forms find that.
void registerPeer(Peer& peer) {
  const auto at = std::make_shared<std::vector<TreeCoordinates>>(coordinatesOf(peer));
  if (peer.hasInverse()) {
    benchmark::RegisterBenchmark(("inverse/" + peer.name()).c_str(), [&peer, at](benchmark::State& state) {
      roundPoses(state, [&](std::size_t k) { return peer.inverseDynamics((*at)[k]); });
    });
    benchmark::RegisterBenchmark(("inverse_with_kinematics/" + peer.name()).c_str(), [&peer](benchmark::State& state) {
      Workspace<double> work;
      TreeCoordinates here;
      roundPoses(state, [&](std::size_t k) {
        const Motion<double>& motion = helix().motions[k];
        peer.coordinates(motion, jointMotion(helix().solver, motion, work), here);
        return peer.inverseDynamics(here);
      });
    });
  }
  benchmark::RegisterBenchmark(("direct/" + peer.name()).c_str(), [&peer, at](benchmark::State& state) {
    roundPoses(state, [&](std::size_t k) { return peer.directDynamics((*at)[k], helix().efforts[k]); });
  });
}

}  // namespace

void registerSideBySide(const Peers& peers) {
  registerScalar("ursula", Fast());
  registerScalar("ursula, T formed", ByNoc());
  benchmark::RegisterBenchmark("kinematics/ursula", [](benchmark::State& state) {
    Workspace<double> work;
    roundPoses(state, [&](std::size_t k) { return jointMotion(helix().solver, helix().motions[k], work); });
  });
  for (const std::unique_ptr<Peer>& peer : peers) registerPeer(*peer);
}

std::vector<Answers> ownAnswers() {
  std::vector<Answers> out = {scalarAnswers("ursula", Fast()), scalarAnswers("ursula, T formed", ByNoc())};
  for (const InstructionSet set : instructionSets()) out.push_back(batchAnswers(set));
  return out;
}

}  // namespace ursula::bench
