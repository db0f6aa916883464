#pragma once

#include <string>
#include <string_view>

#include "studies/sweep/sweep_database.h"

namespace ursula {

/// A point as bytes between two processes of one program on one machine; the length comes first.
std::string packed(const SweepPoint& point);

/// Extracts complete points from the received bytes, in order.
class Unpacker {
 public:
  void add(std::string_view bytes) { bytes_ += bytes; }
  /// Returns false if no complete point has arrived.
  bool next(SweepPoint& point);

 private:
  std::string bytes_;
  std::size_t taken_ = 0;
};

}  // namespace ursula
