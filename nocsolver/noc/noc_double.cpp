#include "nocsolver/noc/noc_impl.h"

namespace ursula {
template class Noc<double>;
}  // namespace ursula
