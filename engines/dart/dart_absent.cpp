// Stands in for DART where this is built without it.

#include <stdexcept>

#include "engines/loop_engine.h"

namespace ursula {

bool dartCallsAvailable() { return false; }

std::string dartVersion() { return "none"; }

std::unique_ptr<LoopEngine> makeDartCalls(const Manipulator&, std::shared_ptr<const Load>) {
  throw std::runtime_error("this was built without DART");
}

}  // namespace ursula
