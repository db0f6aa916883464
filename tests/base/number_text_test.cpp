// 17 digits of our own against {fmt}'s, which are right for every double.

#include "base/number_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace ursula {
namespace {

std::string written(double value) {
  char text[longest_number];
  return {text, writeNumber(value, text)};
}

/// How many of them differ from {fmt}'s, and the first that does.
struct Comparison {
  int compared = 0, wrong = 0;
  std::string first;

  void operator()(double value) {
    ++compared;
    if (written(value) == fmt::format("{:.17g}", value)) return;
    if (wrong++ == 0) first = fmt::format("{:a}: {} for {:.17g}", value, written(value), value);
  }
};

TEST(NumberText, isThatOfTheLibraryForEveryBinaryExponent) {
  std::mt19937_64 random(7);
  Comparison same;
  for (std::uint64_t exponent = 0; exponent < 2048; ++exponent)
    for (int k = 0; k < 300; ++k) {
      const std::uint64_t mantissa = k < 4 ? static_cast<std::uint64_t>(k) : random() >> 12;
      const std::uint64_t bits = (random() & (std::uint64_t{1} << 63)) | exponent << 52 | mantissa;
      double value = 0;
      std::memcpy(&value, &bits, sizeof(value));
      if (!std::isnan(value)) same(value);
    }
  EXPECT_EQ(same.wrong, 0) << same.first;
  EXPECT_GT(same.compared, 600000);
}

TEST(NumberText, isThatOfTheLibraryForNumbersOfMotions) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  Comparison same;
  for (int k = 0; k < 1000000; ++k) same(mantissa(random) * std::pow(10.0, static_cast<int>(random() % 26) - 10));
  EXPECT_EQ(same.wrong, 0) << same.first;
}

/// Powers of ten and their neighbours, where the count of digits changes; few digits, where zeros are left out; halves
/// of the last digit, where ties are broken.
TEST(NumberText, isThatOfTheLibraryAtTheEdges) {
  Comparison same;
  for (int e = -320; e <= 308; ++e)
    for (const int lead : {1, 2, 5, 9, 12, 25, 999}) {
      const double value = std::strtod(fmt::format("{}e{}", lead, e).c_str(), nullptr);
      if (!std::isfinite(value)) continue;
      for (const double each : {value, -value, std::nextafter(value, 0.0), std::nextafter(value, 1e308)}) same(each);
    }
  for (int bits = 40; bits < 62; ++bits)
    for (int k = -40; k <= 40; ++k) same(std::ldexp(1.0, bits) + k / 8.0);
  for (const double each : {0.0, -0.0, 1e17, 99999999999999999.0, 9.9999999999999995e-5, 1e-5, 123456789.0, 0.1})
    same(each);
  const auto limits = std::numeric_limits<double>();
  for (const double each : {limits.infinity(), -limits.infinity(), limits.quiet_NaN(), -limits.quiet_NaN(),
                            limits.denorm_min(), limits.min(), limits.max()})
    same(each);
  EXPECT_EQ(same.wrong, 0) << same.first;
  EXPECT_EQ(written(0.1), "0.10000000000000001");
  EXPECT_EQ(written(-1200), "-1200");
  EXPECT_EQ(written(1e-5), "1.0000000000000001e-05");
}

}  // namespace
}  // namespace ursula
