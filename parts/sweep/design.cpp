#include "parts/sweep/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/random/sobol.hpp>
#include <random>
#include <stdexcept>
#include <utility>

#include "model/scenario.h"

namespace ursula {
namespace {

/// An index that no point has, for the shift of sobol.
constexpr std::uint64_t index_of_shift = ~std::uint64_t{0};

std::mt19937_64 generatorOf(std::uint64_t seed, std::uint64_t index) {
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  std::seed_seq words{low(seed), low(seed >> 32U), low(index), low(index >> 32U)};
  return std::mt19937_64(words);
}

/// Returns the middle of one of 2^53 cells of (0, 1).
double deviateOf(std::uint64_t bits) { return (static_cast<double>(bits >> 11U) + 0.5) * 0x1p-53; }

double valueOf(const VariedNumber& number, double u) {
  const Variation& by = number.by;
  const auto normal = [u] { return quantile(boost::math::normal_distribution<double>(), u); };
  switch (by.kind) {
    case Variation::Kind::values:
      return by
          .values[std::min(static_cast<std::size_t>(u * static_cast<double>(by.values.size())), by.values.size() - 1)];
    case Variation::Kind::uniform:
      return by.a + (by.b - by.a) * u;
    case Variation::Kind::normal:
      return by.a + by.b * normal();
    case Variation::Kind::relative:
      return number.nominal * (1 + by.a * normal());
    case Variation::Kind::plus_minus:
      return number.nominal + by.a * (2 * u - 1);
  }
  throw std::logic_error("no such way to vary");
}

}  // namespace

SweepPoints::SweepPoints(const SweepFile& sweep, std::vector<VariedNumber> numbers)
    : design_(sweep.design), seed_(sweep.seed), numbers_(std::move(numbers)) {
  if (design_ == SweepDesign::grid) {
    for (const VariedNumber& number : numbers_) {
      const auto size = static_cast<std::int64_t>(number.by.values.size());
      if (count_ > most_points / size)
        throw ScenarioError(fmt::format("{}: error: the grid has more than {} points, expected fewer",
                                        sweep.file.string(), most_points));
      count_ *= size;
    }
    return;
  }
  count_ = sweep.count;
  if (design_ != SweepDesign::sobol) return;
  std::mt19937_64 shifts = generatorOf(seed_, index_of_shift);
  for (std::size_t k = 0; k < numbers_.size(); ++k) shifts_.push_back(shifts());
  constexpr std::size_t most = boost::random::default_sobol_table::max_dimension;
  if (numbers_.size() > most)
    throw ScenarioError(fmt::format("{}: error: {} numbers vary, expected at most {} with design 'sobol'",
                                    sweep.file.string(), numbers_.size(), most));
}

std::vector<double> SweepPoints::uniforms(std::int64_t i) const {
  std::vector<double> out(numbers_.size());
  if (design_ == SweepDesign::random) {
    std::mt19937_64 generator = generatorOf(seed_, static_cast<std::uint64_t>(i));
    for (double& u : out) u = deviateOf(generator());
    return out;
  }
  boost::random::sobol engine(numbers_.size());  // it omits the first point, zero
  if (i > 0) engine.seed(static_cast<std::uint64_t>(i - 1));
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = deviateOf((i > 0 ? engine() : 0) ^ shifts_[k]);
  return out;
}

std::vector<double> SweepPoints::at(std::int64_t i) const {
  std::vector<double> out(numbers_.size());
  if (design_ == SweepDesign::grid) {
    for (std::size_t k = out.size(); k-- > 0;) {
      const auto size = static_cast<std::int64_t>(numbers_[k].by.values.size());
      out[k] = numbers_[k].by.values[i % size];
      i /= size;
    }
    return out;
  }
  const std::vector<double> u = uniforms(i);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = valueOf(numbers_[k], u[k]);
  return out;
}

}  // namespace ursula
