// Compiled as a file that a unit of several includes, once with the kernel in an unnamed namespace: GCC must warn.
#include "base/real50.h"
#include "model/exact_trajectory.h"

#ifdef URSULA_UNNAMED
namespace {
#else
namespace ursula {
#endif
template <class S>
struct Kernel {
  ursula::Motion<S> at(const S& t) const { return {t}; }
};
#ifndef URSULA_UNNAMED
using Kernels = KernelTrajectory<Kernel>;
#else
using Kernels = ursula::KernelTrajectory<Kernel>;
#endif
const std::size_t size = sizeof(Kernels);
}  // namespace
