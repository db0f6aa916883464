#pragma once

#include <string>
#include <vector>

#include "bench/peers/helix.h"
#include "bench/peers/peer.h"

namespace ursula::bench {

/// What somebody made of all poses. Nothing where it was not asked for.
struct Answers {
  std::string name;
  std::vector<Vector6d> efforts;       ///< for the motions
  std::vector<Vector6d> twist_rates;   ///< [ω̇; p̈] for the poses' efforts
  std::vector<Peer::Deviation> known;  ///< of the twist rates; empty where they are exact
};

Answers answersOf(Peer& peer, const Poses& poses);

/// How far answers are from the paper's equations, and how far they may be.
struct Agreement {
  std::string name;
  const char* task;   ///< "inverse" or "direct"
  double value;       ///< the largest difference, over the largest effort, or length-scaled acceleration
  double limit;       ///< of `value`, or of what remains of it without what is known to be left out
  double remainder;   ///< that is held against the limit
  std::string basis;  ///< of the limit

  bool holds() const { return remainder <= limit; }
};

/// Efforts against the paper's, twist rates against those commanded. NaN never holds. Throws std::invalid_argument
/// where there is not an answer for each pose.
std::vector<Agreement> agreementsOf(const Answers& answers, const Poses& poses);

/// Of all peers.
std::vector<Agreement> agreementsOf(const std::vector<std::unique_ptr<Peer>>& peers, const Poses& poses);

/// One line.
std::string toText(const Agreement& agreement);

}  // namespace ursula::bench
