#pragma once

#include <functional>

#include "nocsolver/chain_state.h"
#include "nocsolver/reading.h"

namespace ursula {

/// A reading of the general road: slips, and legs that stand or move otherwise than they do. For controls that must
/// fail.
struct SpoiltChain : WithSlips {
  using Change = std::function<void(const ChainModel<double>&, ChainState<double>&)>;

  SpoiltChain() = default;
  explicit SpoiltChain(Slip slip) : WithSlips(slip) {}

  void placed(const ChainModel<double>& model, ChainState<double>& leg) const {
    if (place) place(model, leg);
  }
  void mapped(const ChainModel<double>& model, ChainState<double>& leg) const {
    if (map) map(model, leg);
  }

  Change place;  ///< after the displacement, before the map
  Change map;    ///< after the map
};

}  // namespace ursula
