// The NOC's formulas in long double, to measure rounding in doubles.

#include "nocsolver/legs/leg_model_impl.h"
#include "nocsolver/noc/noc_impl.h"
#include "parts/prove/effect.h"
#include "validation/subject/noc_subject_impl.h"

namespace ursula {

template struct MachineParameters<long double>;
template class Noc<long double>;

Subject longNocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load) {
  return noc_subject::makeSubject<long double>("noc in long double", manipulator, load, [](const Manipulator& machine) {
    return std::make_shared<const Noc<long double>>(machine);
  });
}

}  // namespace ursula
