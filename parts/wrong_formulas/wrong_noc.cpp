#include "parts/wrong_formulas/wrong_noc_impl.h"
#include "validation/subject/noc_subject_impl.h"

namespace ursula {

template class WrongNoc<double>;

Subject wrongNocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load,
                        const WithFormulaErrors& fault) {
  return noc_subject::makeSubject<double>("noc with a fault", manipulator, load, [fault](const Manipulator& machine) {
    return std::make_shared<const WrongNoc<double>>(machine, fault);
  });
}

}  // namespace ursula
