#include <array>

#include "bench/peers/peer.h"
#include "parts/engines/mujoco/mujoco_loop.h"

namespace ursula::bench {

std::vector<std::unique_ptr<Peer>> makePeers(const Manipulator& manipulator) {
  std::vector<std::unique_ptr<Peer>> out;
  for (const auto make : {makeSimbodyPeer, makeMujocoPeer, makeSoftMujocoPeer, makeDartPeer})
    if (std::unique_ptr<Peer> peer = make(manipulator)) out.push_back(std::move(peer));
  return out;
}

std::vector<std::string> missingPeers() {
  std::vector<std::string> out;
  if (!mujocoAvailable()) out.emplace_back("MuJoCo");
  if (!dartAvailable()) out.emplace_back("DART");
  return out;
}

}  // namespace ursula::bench
