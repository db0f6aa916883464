#include "validation/checks/external_check.h"

#include <fmt/format.h>

#include "validation/samples/place_name.h"
#include "validation/verdict/worst_share.h"

namespace ursula {

Check judgeAgainstNoc(const ExternalTorques& torques, const Units& units) {
  Worst shown;
  for (std::size_t k = 0; k < torques.against_noc.size(); ++k) {
    const Deviation& each = torques.against_noc[k];
    shown.add(each.error, each.limit, torques.file.t[k], each.where);
  }
  if (!shown.any) return notMade("torque.against_noc", units.efforts.unit, "no instant was compared");
  Check check = judged("torque.against_noc", shown.value, shown.limit, units.efforts.unit, "as for torque.pointwise",
                       fmt::format("torques against this program's NOC, at {} instants; shown for t = {:.6g} s, leg {}",
                                   torques.file.rows(), shown.t * units.time, units.legOf(shown.where) + 1));
  check.largest = {shown.largest, shown.largest_t * units.time, placeName(units.legOf(shown.largest_where), false)};
  return check;
}

}  // namespace ursula
