#pragma once

#include <cmath>
#include <vector>

#include "model/instants.h"
#include "parts/compare/compare.h"

namespace ursula {

inline std::vector<double> wave(const std::vector<double>& t, double shift = 0) {
  std::vector<double> out;
  for (double at : t) out.push_back(10 * std::sin(2 * (at + shift)));
  return out;
}

inline TimeSeries history(const std::vector<double>& t, double shift = 0) {
  return {{"t_s", "tau_1_Nm", "tau_2_Nm"}, {t, wave(t, shift), std::vector<double>(t.size(), 20)}};
}

inline const std::vector<double> t_101 = equallySpaced(1, 101);

}  // namespace ursula
