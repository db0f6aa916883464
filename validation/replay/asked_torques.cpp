#include "validation/replay/asked_torques.h"

#include <algorithm>
#include <exception>

#include "base/deadline.h"
#include "validation/subject/same_bits.h"

namespace ursula {

SimbodyLoop::TorqueHistory AskedTorques::recorded(const SimbodyLoop::TorqueHistory& torques) {
  return [this, &torques](double t) {
    answers_.push_back({t, Vector6d::Zero(), false});
    const Vector6d answer = torques(t);
    answers_.back() = {t, answer, true};
    return answer;
  };
}

void AskedTorques::add(const AskedTorques& more) {
  answers_.insert(answers_.end(), more.answers_.begin(), more.answers_.end());
}

bool AskedTorques::sameFrom(const SimbodyLoop::TorqueHistory& torques) const {
  try {
    return !answers_.empty() && std::all_of(answers_.begin(), answers_.end(), [&torques](const Answer& answer) {
      return answer.given && sameBits(answer.torques, torques(answer.t));
    });
  } catch (const OutOfTime&) {
    throw;
  } catch (const std::exception&) {
    return false;  // the caller meets the same error
  }
}

}  // namespace ursula
