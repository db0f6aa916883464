#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace ursula::report {

/// Formats a unit for people: "N m" → "N·m", "m/s^2" → "m/s²"; also those of columns: "Nm", "m_s2".
std::string prettyUnit(const std::string& unit);

/// Formats a value with unit and prefix: 7.7e-12 "m" → "7.7 pm". Pure numbers and powers of ten beyond the prefixes
/// stay as they are. Values that are not finite become words.
std::string quantity(double value, const std::string& unit, int digits = 3);

/// Numbers that are read side by side, all in the unit that suits the largest.
struct SideBySide {
  std::vector<std::string> numbers;  ///< with the decimals that the largest needs for its digits; smaller ones are 0
  std::string unit;                  ///< with its prefix; may be empty
  /// The k-th number with its unit.
  std::string text(std::size_t k) const;
};
SideBySide sideBySide(const std::vector<double>& values, const std::string& unit, int digits);

/// The size of the prefixed unit that suits a value, and its text: 32000 "N m" → 1000, "kN·m".
std::pair<double, std::string> prefixed(double value, const std::string& unit, int digits = 3);

/// 3.2e-15 → "3.2 × 10⁻¹⁵"; from 0.001 to 99999 plain.
std::string plainNumber(double value, int digits = 3);

/// The text with every 2.75e+13 as 2.75 × 10¹³.
std::string powersInPrint(const std::string& text);

/// The text for a page, in which no line ends within a number or between a number and its unit: "t = 3 s" with spaces
/// that do not break, a minus sign for a hyphen before a number, "m/s^2" as m/s², powers as powersInPrint writes them.
std::string unbroken(const std::string& text);

/// The text of a limit or a finding as in print: "eps kappa(B)^2 x ||T||" → "ε κ(B)² × ‖T‖".
std::string formulaInPrint(const std::string& text);

/// 0.0314 → "3.1 %", 0.31 → "31 %".
std::string percentText(double share);

/// Number of significant digits, at least four, that distinguish numbers between low and high to a hundredth of the
/// range.
int digitsToTell(double low, double high);

/// "one", "two", … "twelve", then digits.
std::string inWords(int count);

}  // namespace ursula::report
