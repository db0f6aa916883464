// Stands in for the peers in a build without MuJoCo.

#include "bench/peers/peer.h"

namespace ursula::bench {

std::unique_ptr<Peer> makeMujocoPeer(const Manipulator&) { return nullptr; }

std::unique_ptr<Peer> makeSoftMujocoPeer(const Manipulator&) { return nullptr; }

}  // namespace ursula::bench
