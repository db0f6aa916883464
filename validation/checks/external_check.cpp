#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/samples/place_name.h"
#include "validation/verdict/worst_share.h"

namespace ursula {

Check judgeAgainstNoc(const ExternalTorques& torques, const Units& units) {
  WorstShare worst;
  CheckedQuantity quantity{"torque.against_noc", units.efforts.unit};
  for (std::size_t k = 0; k < torques.against_noc.size(); ++k) {
    const Deviation& each = torques.against_noc[k];
    worst.add(each.error, each.limit, torques.file.t[k], each.where);
    quantity.given = std::max(quantity.given, each.given);
  }
  for (const PointwiseSample& sample : torques.samples)
    quantity.size = std::max(quantity.size, sample.torques_simbody.cwiseAbs().maxCoeff());
  if (!worst.any) return notMade(quantity.name, quantity.unit, "no instant was compared");
  const JudgedValue shown = worst.shown(quantity.useful());
  Check check =
      judgedIfUseful(quantity, worst, "as for torque.pointwise",
                     fmt::format("torques against this program's NOC, at {} instants; shown for t = {:.6g} s, {}",
                                 torques.file.rows(), shown.t * units.time, motorName(units, shown.where)),
                     causeOfRounding(torques.samples, worst.widest_t));
  check.largest = {worst.largest, worst.largest_t * units.time, motorName(units, worst.largest_where)};
  return check;
}

}  // namespace ursula
