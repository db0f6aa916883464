#include "nocsolver/errors.h"

#include <locale>
#include <sstream>

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

}  // namespace ursula
