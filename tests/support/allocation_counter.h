#pragma once

namespace ursula {

/// Calls of malloc and its kin, operator new among them, on this thread since it began. A program that links
/// allocation_counter.cpp counts all of its own and its libraries' calls.
long allocations();

/// The same of what `call` does.
template <class F>
long allocationsIn(F&& call) {
  const long before = allocations();
  call();
  return allocations() - before;
}

}  // namespace ursula
