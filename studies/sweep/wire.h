#pragma once

#include <string>
#include <string_view>

#include "studies/sweep/sweep_database.h"

namespace ursula {

/// A point as bytes between two processes of one program on one machine, its length first.
std::string packed(const SweepPoint& point);

/// Takes whole points from the front of what arrived, in order.
class Unpacker {
 public:
  void add(std::string_view bytes) { bytes_ += bytes; }
  /// False where no whole point is there yet.
  bool next(SweepPoint& point);

 private:
  std::string bytes_;
  std::size_t taken_ = 0;
};

}  // namespace ursula
