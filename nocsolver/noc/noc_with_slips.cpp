#include "nocsolver/noc/noc_joints_impl.h"

namespace ursula {
template class Noc<double, WithSlips>;
}  // namespace ursula
