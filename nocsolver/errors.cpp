#include "nocsolver/errors.h"

#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace ursula {
namespace {

std::string describe(const std::string& what, int leg, double instant, double measure, double bound,
                     const std::string& unit) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);
  if (leg >= 0) text << "leg " << leg + 1 << ' ';
  text << what << " at t = " << instant << " s: " << measure << unit << ", bound " << bound << unit;
  return text.str();
}

}  // namespace

PoseError::PoseError(const std::string& what, int leg, double instant, double measure, double bound,
                     const std::string& unit)
    : std::runtime_error(describe(what, leg, instant, measure, bound, unit)),
      leg_(leg),
      instant_(instant),
      measure_(measure),
      bound_(bound) {}

void requireFinite(const double* values, std::size_t count, const char* what, double instant) {
  for (std::size_t k = 0; k < count; ++k) {
    if (std::isfinite(values[k])) continue;
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(9);
    text << what;
    if (count > 1) text << ' ' << k + 1;
    text << " = " << values[k] << " at t = " << instant
         << " s, expected a finite number: the numbers of motion or machine are too large or too small for doubles";
    throw std::domain_error(text.str());
  }
}

void requireFinite(const Motion<double>& motion) {
  requireFinite(motion.p.data(), 3, "position", motion.t);
  requireFinite(motion.Q.data(), 9, "orientation", motion.t);
  requireFinite(motion.p_dot.data(), 3, "velocity", motion.t);
  requireFinite(motion.omega.data(), 3, "angular velocity", motion.t);
  requireFinite(motion.p_ddot.data(), 3, "acceleration", motion.t);
  requireFinite(motion.omega_dot.data(), 3, "angular acceleration", motion.t);
}

}  // namespace ursula
