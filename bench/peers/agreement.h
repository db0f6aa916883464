#pragma once

#include <string>
#include <vector>

#include "bench/peers/helix.h"
#include "bench/peers/peer.h"

namespace ursula::bench {

/// The answers of a formulation at all poses; empty if not asked for.
struct Answers {
  std::string name;
  std::vector<Vector6d> efforts;       ///< for the motions
  std::vector<Vector6d> twist_rates;   ///< [ω̇; p̈] for the poses' efforts
  std::vector<Peer::Deviation> known;  ///< known deviations of the twist rates; empty if they are exact
};

Answers answersOf(Peer& peer, const Poses& poses);

/// The deviation of answers from the paper's equations, and its limit.
struct Agreement {
  std::string name;
  const char* task;   ///< "inverse" or "direct"
  double value;       ///< the largest difference, over the largest effort, or length-scaled acceleration
  double limit;       ///< limit of `remainder`
  double remainder;   ///< `value` without a term that the engine is known to leave out; it is compared with the limit
  std::string basis;  ///< of the limit

  bool holds() const { return remainder <= limit; }
};

/// Compares efforts with the paper's, and twist rates with the commanded ones. NaN never holds. Throws
/// std::invalid_argument unless there is an answer for each pose.
std::vector<Agreement> agreementsOf(const Answers& answers, const Poses& poses);

/// The same for all peers.
std::vector<Agreement> agreementsOf(const std::vector<std::unique_ptr<Peer>>& peers, const Poses& poses);

/// Returns one line.
std::string toText(const Agreement& agreement);

}  // namespace ursula::bench
