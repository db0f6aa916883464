#pragma once

namespace ursula {

/// Number of calls of malloc and related functions, including operator new, on this thread since its start. A program
/// linked with allocation_counter.cpp counts its own calls and those of its libraries.
long allocations();

/// The number of such calls during `call`.
template <class F>
long allocationsIn(F&& call) {
  const long before = allocations();
  call();
  return allocations() - before;
}

}  // namespace ursula
