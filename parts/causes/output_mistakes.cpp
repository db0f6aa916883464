#include <algorithm>
#include <numeric>

#include "model/effort_units.h"
#include "parts/causes/pursuit.h"

namespace ursula {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index most_permuted = 6;

Index motorsOf(const OutputMistake& of) { return std::max({of.factor.size(), of.gain.size(), of.offset.size()}); }

}  // namespace

VectorXd OutputMistake::of(const VectorXd& efforts, double x) const {
  VectorXd out = efforts;
  const Index n = motorsOf(*this);
  for (Index at = 0; at < efforts.size(); at += n)
    for (Index k = 0; k < n; ++k) {
      double& one = out(at + k);
      if (!from.empty()) one = efforts(at + from[static_cast<std::size_t>(k)]);
      if (factor.size() > 0) one *= factor(k);
      if (gain.size() > 0) one *= 1 + x * gain(k);
      if (offset.size() > 0) one += x * offset(k);
    }
  return out;
}

VectorXd OutputMistake::undone(const VectorXd& efforts) const {
  VectorXd out = efforts;
  const Index n = motorsOf(*this);
  for (Index at = 0; at < efforts.size(); at += n)
    for (Index k = 0; k < n; ++k)
      out(at + (from.empty() ? k : from[static_cast<std::size_t>(k)])) = efforts(at + k) / factor(k);
  return out;
}

std::vector<OutputMistake> outputMistakes(Index n, std::size_t& discrete) {
  std::vector<OutputMistake> outputs;
  const VectorXd ones = VectorXd::Ones(n);
  for (unsigned which = 1; n <= most_permuted && which < 1U << n; ++which) {
    VectorXd signs = ones;
    for (Index k = 0; k < n; ++k)
      if ((which >> k & 1U) != 0) signs(k) = -1;
    outputs.push_back({{}, signs});
  }
  std::vector<double> units = {1e3, 1e6, 1e2, 1e1, 57.29577951308232};  // the last are degrees
  for (const EffortUnit& unit : effortUnits())
    if (unit.multiplier != 1) units.push_back(unit.inSI());
  for (const double unit : units)
    for (const double factor : {unit, 1 / unit}) outputs.push_back({{}, factor * ones});
  std::vector<Index> own(static_cast<std::size_t>(n));
  std::iota(own.begin(), own.end(), Index{0});
  std::vector<Index> from = own;
  while (n <= most_permuted && std::next_permutation(from.begin(), from.end())) outputs.push_back({from, ones});
  for (std::size_t i = 0; n > most_permuted && i < own.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      outputs.push_back({own, ones});
      std::swap(outputs.back().from[i], outputs.back().from[j]);
    }
  discrete = outputs.size();
  for (Index k = 0; k < n; ++k) {
    outputs.push_back({{}, {}, {}, VectorXd::Unit(n, k)});
    if (n > 1) outputs.push_back({{}, {}, VectorXd::Unit(n, k)});
  }
  outputs.push_back({{}, {}, ones});
  return outputs;
}

}  // namespace ursula
