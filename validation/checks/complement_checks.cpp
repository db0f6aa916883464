#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "validation/verdict/worst_share.h"

namespace ursula {

std::vector<Check> judgeComplement(const std::vector<ComplementSample>& samples, const Units& units) {
  static constexpr const char *orthogonality = "complement.orthogonality", *rank = "complement.rank";
  if (samples.empty())
    return {notMade(orthogonality, "", "no instant was compared"), notMade(rank, "", "no instant was compared")};
  WorstShare worst;
  int missing = 0;
  double at = samples.front().t;
  const ComplementSample* shown = &samples.front();
  for (const ComplementSample& sample : samples) {
    const bool empty = !(sample.size_D > 0) || !(sample.size_T > 0);  // zeros are orthogonal to everything
    const double product = empty ? std::nan("") : sample.product / (sample.size_D * sample.size_T);
    worst.add(product, sample.limit / (sample.size_D * sample.size_T), sample.t, -1);
    const int here = std::abs(sample.rank_D - sample.wanted_D) + std::abs(sample.rank_T - sample.wanted_T);
    if (here <= missing) continue;
    missing = here;
    at = sample.t;
    shown = &sample;
  }
  const CheckedQuantity quantity{orthogonality, "", 1};
  Check product =
      judgedIfUseful(quantity, worst, "eps x kappa(B) kappa(legs) x what roundings add up to at most, of ||D|| ||T||",
                     fmt::format("|| D T || over || D || || T || (33), at {} instants; shown for t = {:.6g} s",
                                 samples.size(), worst.shown(quantity.useful()).t * units.time),
                     "a singular pose or a stretched leg is near");
  product.largest = {worst.largest, worst.largest_t * units.time, ""};
  Check ranks = judged(rank, missing, 0, "", "D leaves six freedoms, T spans them",
                       fmt::format("D has rank {} of {}, T has rank {} of {}, at t = {:.6g} s", shown->rank_D,
                                   shown->wanted_D, shown->rank_T, shown->wanted_T, at * units.time));
  ranks.largest = {static_cast<double>(missing), at * units.time, ""};
  return {product, ranks};
}

}  // namespace ursula
