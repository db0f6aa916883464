// The formulas as printed in 50 digits, only for tests.

#include "base/real50.h"
#include "parts/wrong_formulas/wrong_noc_impl.h"

namespace ursula {
template class WrongNoc<Real50>;
}  // namespace ursula
