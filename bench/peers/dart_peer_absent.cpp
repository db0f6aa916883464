// Stands in for the peer in a build without DART.

#include "bench/peers/peer.h"

namespace ursula::bench {

std::unique_ptr<Peer> makeDartPeer(const Manipulator&) { return nullptr; }

bool dartAvailable() { return false; }

}  // namespace ursula::bench
