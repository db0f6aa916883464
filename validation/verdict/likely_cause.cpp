#include "validation/verdict/likely_cause.h"

#include <stdexcept>

namespace ursula {

const char* name(CauseKind kind) {
  switch (kind) {
    case CauseKind::scale:
      return "scale";
    case CauseKind::sign:
      return "sign";
    case CauseKind::order:
      return "order";
    case CauseKind::units:
      return "units";
    case CauseKind::offset:
      return "offset";
    case CauseKind::delay:
      return "delay";
    case CauseKind::digits:
      return "digits";
    case CauseKind::state:
      return "state";
    case CauseKind::parameter:
      return "parameter";
    case CauseKind::reference_point:
      return "reference_point";
    case CauseKind::missing_term:
      return "missing_term";
    case CauseKind::frame:
      return "frame";
    case CauseKind::jacobian:
      return "jacobian";
    case CauseKind::closure:
      return "closure";
    case CauseKind::window:
      return "window";
  }
  throw std::logic_error("a kind of cause without a name");
}

}  // namespace ursula
