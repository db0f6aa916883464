#include "base/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace ursula {
namespace {

constexpr int digits_in_all = 17;

char* byLibrary(double value, char* to) { return fmt::format_to(to, "{:.17g}", value); }

#if defined(__SIZEOF_INT128__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define URSULA_NUMBERS_IN_REGISTERS

__extension__ using Wide = unsigned __int128;

/// 5^27 is the last power of five that 64 bits hold.
constexpr std::array<std::uint64_t, 28> powersOfFive() {
  std::array<std::uint64_t, 28> out{};
  out[0] = 1;
  for (std::size_t k = 1; k < out.size(); ++k) out[k] = 5 * out[k - 1];
  return out;
}

/// m 2^e 10^k rounded to the nearest integer, ties to even; k from 0 to 27. Exact, since m 5^k has fewer than 128 bits.
std::uint64_t scaled(std::uint64_t m, int e, int k) {
  static constexpr std::array<std::uint64_t, 28> five = powersOfFive();
  const Wide product = static_cast<Wide>(m) * five[static_cast<std::size_t>(k)];
  const int down = -(e + k);
  if (down <= 0) return static_cast<std::uint64_t>(product << -down);
  const auto floor = static_cast<std::uint64_t>(product >> down);
  const Wide rest = product - (static_cast<Wide>(floor) << down), half = static_cast<Wide>(1) << (down - 1);
  return floor + (rest > half || (rest == half && (floor & 1) != 0) ? 1 : 0);
}

/// A number below 10⁸ as eight characters, the first in the lowest byte. It is split into halves, quarters and digits.
std::uint64_t eightDigits(std::uint64_t number) {
  constexpr std::uint64_t zeros = 0x3030303030303030;
  const std::uint64_t fours = number / 10000 | (number % 10000) << 32;
  const std::uint64_t hundreds = (fours * 10486 >> 20) & 0x0000007f0000007f;
  const std::uint64_t pairs = hundreds | (fours - 100 * hundreds) << 16;
  const std::uint64_t tens = (pairs * 103 >> 10) & 0x000f000f000f000f;
  return zeros | tens | (pairs - 10 * tens) << 8;
}

/// 17 digits as characters, held in registers.
struct Digits {
  std::uint64_t first, next, last;  ///< one character, eight and eight

  explicit Digits(std::uint64_t number) {
    constexpr std::uint64_t eight = 100'000'000;
    const std::uint64_t high = number / eight;
    first = '0' + high / eight;
    next = eightDigits(high % eight);
    last = eightDigits(number % eight);
  }

  /// The number of digits without trailing zeros.
  int count() const {
    constexpr std::uint64_t no_letter = 0x0f0f0f0f0f0f0f0f;
    const auto zeros = [](std::uint64_t digits) { return __builtin_clzll(digits) / 8; };
    if ((last & no_letter) != 0) return digits_in_all - zeros(last & no_letter);
    return (next & no_letter) != 0 ? 9 - zeros(next & no_letter) : 1;
  }

  /// Writes all but the first.
  void putRest(char* to) const {
    put(next, to);
    put(last, to + 8);
  }
  void putAll(char* to) const {
    to[0] = static_cast<char>(first);
    putRest(to + 1);
  }
  static void put(std::uint64_t letters, char* to) { std::memcpy(to, &letters, sizeof(letters)); }
};

/// Writes the digits with the point behind the first `whole`.
char* withPoint(const Digits& digits, int whole, int count, char* to) {
  if (count <= whole) {
    digits.putAll(to);
    return to + whole;
  }
  if (whole <= 7) {
    const std::uint64_t eight = digits.first | digits.next << 8, before = (std::uint64_t{1} << (8 * whole)) - 1;
    digits.putRest(to + 2);
    Digits::put((eight & before) | std::uint64_t{'.'} << (8 * whole) | (eight & ~before) << 8, to);
    return to + count + 1;
  }
  char all[digits_in_all];
  digits.putAll(all);
  std::memcpy(to, all, static_cast<std::size_t>(whole));
  to[whole] = '.';
  std::memcpy(to + whole + 1, all + whole, static_cast<std::size_t>(count - whole));
  return to + count + 1;
}

/// Writes d.ddd × 10^exponent like "%g": no trailing zeros, and an exponent below 1e-4.
char* laidOut(const Digits& digits, int exponent, char* to) {
  const int count = digits.count();
  if (exponent >= 0) return withPoint(digits, exponent + 1, count, to);
  if (exponent >= -4) {
    std::memcpy(to, "0.000", 5);
    to += 1 - exponent;
    digits.putAll(to);
    return to + count;
  }
  to[0] = static_cast<char>(digits.first);
  to[1] = '.';
  digits.putRest(to + 2);
  to += count > 1 ? count + 1 : 1;
  to[0] = 'e';
  to[1] = '-';
  to[2] = static_cast<char>('0' + -exponent / 10);
  to[3] = static_cast<char>('0' + -exponent % 10);
  return to + 4;
}

/// `bits` are those of the absolute value; `binary` is its exponent, from −36 to 55.
char* bySeventeenDigits(std::uint64_t bits, int binary, char* to) {
  constexpr std::uint64_t hidden = std::uint64_t{1} << 52, too_large = 100'000'000'000'000'000;
  const std::uint64_t m = (bits & (hidden - 1)) | hidden;
  int exponent = (binary * 78913) >> 18;  // ⌊binary log10 2⌋: the number's exponent, or one less
  std::uint64_t number = scaled(m, binary - 52, digits_in_all - 1 - exponent);
  if (number >= too_large) {
    ++exponent;
    number = scaled(m, binary - 52, digits_in_all - 1 - exponent);
  }
  return laidOut(Digits(number), exponent, to);
}

#endif

}  // namespace

char* writeNumber(double value, char* to) {
#ifdef URSULA_NUMBERS_IN_REGISTERS
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  const std::uint64_t size = bits & ~sign;
  const int binary = static_cast<int>(size >> 52) - 1023;
  if (size == 0 || (binary >= -36 && binary <= 55)) {
    if ((bits & sign) != 0) *to++ = '-';
    if (size != 0) return bySeventeenDigits(size, binary, to);
    *to++ = '0';
    return to;
  }
#endif
  return byLibrary(value, to);
}

}  // namespace ursula
