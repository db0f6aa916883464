#pragma once

#include <string>

namespace ursula::report {

/// A unit as people write it: "N m" → "N·m", "m/s^2" → "m/s²"; columns' units too: "Nm", "m_s2".
std::string prettyUnit(const std::string& unit);

/// A value with its unit and a prefix: 7.7e-12 "m" → "7.7 pm". Pure numbers and powers of ten beyond the prefixes stay
/// as they are. Words where the value is not finite.
std::string quantity(double value, const std::string& unit, int digits = 3);

/// 3.2e-15 → "3.2 × 10⁻¹⁵"; from 0.001 to 99999 plain.
std::string plainNumber(double value, int digits = 3);

/// Significant digits, at least four, that tell numbers between low and high apart to a hundredth of the range.
int digitsToTell(double low, double high);

/// "one", "two", … "twelve", then digits.
std::string inWords(int count);

}  // namespace ursula::report
