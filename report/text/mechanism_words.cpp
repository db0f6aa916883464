#include "report/text/mechanism_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/check_catalogue.h"
#include "model/mechanism_picture.h"
#include "report/page/sections.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula::report {
namespace {

struct MechanismRow {
  const char *check, *title, *proves;
};

/// The checks whose words in the catalogue are those of a manipulator.
constexpr std::array mechanism_rows = {
    MechanismRow{"acceleration.pointwise", "Simbody's acceleration under the efforts",
                 "Simbody, given the efforts under test, accelerates the motors as commanded."},
    MechanismRow{"torque.twin", "Simbody, another spanning tree",
                 "A second Simbody model, which cuts the loops at other joints, needs the same efforts."},
    MechanismRow{
        "torque.maximal", "Maximal coordinates",
        "The equations of Newton and Euler for free bodies, with a multiplier for each thing that a joint holds, "
        "need the same efforts."},
    MechanismRow{
        "complement.orthogonality", "T across D",
        "D T = 0 (33): no motion that T allows breaks a joint. D is made only from the joints' axes and points."},
    MechanismRow{"complement.rank", "Rank of T", "T has as many independent columns as the machine has motors."},
    MechanismRow{"invariance.axes", "Axes moved",
                 "The efforts are the same if bodies have other frames and positions count from another origin."},
    MechanismRow{"invariance.labels", "Motors relabelled",
                 "Efforts follow their motors when bodies, joints and motors are listed in another order."},
    MechanismRow{"reactions.pointwise", "Joint reactions", "Forces and moments at the joints equal those of Simbody."},
    MechanismRow{
        "torque.between", "Between the samples",
        "At instants between the samples, the efforts equal Simbody's; those of another solver equal the NOC's."},
    MechanismRow{"replay.position", "Position along the motion",
                 "Simbody's closed loop, driven by the efforts alone, keeps the output body on its path."},
    MechanismRow{"replay.orientation", "Orientation along the motion",
                 "Simbody's closed loop, driven by the efforts alone, keeps the output body's orientation."},
    MechanismRow{"closure.position", "Loops stay closed",
                 "The loops of the replay stay closed: bodies keep their common points together."}};

/// "off by 30 mN·m (1 % of the largest), "; empty without a number.
std::string offText(const MotorDeviation& motor) {
  if (!std::isfinite(motor.largest)) return "";
  const std::string share = motor.share < 1e-6 ? plainNumber(motor.share, 2) : percentText(motor.share);
  return fmt::format("off by {}{}, ", quantity(motor.largest, motor.unit),
                     motor.share > 0 ? fmt::format(" ({} of the largest)", share) : "");
}

std::string count(std::size_t number, const char* noun, const char* many) {
  return fmt::format("{} {}", number, number == 1 ? noun : many);
}

}  // namespace

std::pair<std::string, std::string> toldApart(const MotorDeviation& motor) {
  const double off = std::abs(motor.given - motor.expected),
               size = std::max(std::abs(motor.given), std::abs(motor.expected));
  const int digits = off > 0 && std::isfinite(size) ? static_cast<int>(std::ceil(std::log10(size / off))) + 1 : 4;
  const SideBySide both = sideBySide({motor.given, motor.expected}, motor.unit, std::clamp(digits, 4, 17));
  const auto text = [&](std::size_t k, double value) { return std::isfinite(value) ? both.text(k) : "no number"; };
  return {text(0, motor.given), text(1, motor.expected)};
}

std::vector<std::string> motorNames(const ValidationResult& result) {
  std::vector<std::string> out;
  if (result.mechanism != nullptr)
    for (const MechanismPicture::Motor& motor : result.mechanism->motors) out.push_back(motor.name);
  return out;
}

std::string motorName(const std::vector<std::string>& names, std::size_t motor) {
  return motor < names.size() ? names[motor] : std::to_string(motor + 1);
}

CheckWords checkWords(const std::string& check, const std::string& kind) {
  const auto row = std::find_if(mechanism_rows.begin(), mechanism_rows.end(),
                                [&check](const MechanismRow& each) { return check == each.check; });
  if (kind == "mechanism" && row != mechanism_rows.end()) return {row->title, row->proves};
  const CheckRow* of_catalogue = checkRow(check);
  return {checkTitle(check), of_catalogue == nullptr ? "" : of_catalogue->proves};
}

std::string worstMotor(const ValidationResult& result) {
  const std::vector<std::string> names = motorNames(result);
  const std::optional<MotorDeviation> worst = worstOf(motorsOff(result));
  if (!worst) return "";
  const auto [given, expected] = toldApart(*worst);
  return fmt::format("{}{} was given {} where {} is expected, {}at t = {:.4g} s", names.empty() ? "motor " : "",
                     motorName(names, static_cast<std::size_t>(worst->motor)), given, expected, offText(*worst),
                     worst->t);
}

std::string mechanismLine(const MechanismPicture& picture) {
  const auto bodies = static_cast<std::size_t>(
      std::count_if(picture.bodies.begin(), picture.bodies.end(), [](const auto& body) { return !body.fixed; }));
  const auto closures = static_cast<std::size_t>(
      std::count_if(picture.joints.begin(), picture.joints.end(), [](const auto& joint) { return joint.closure; }));
  const std::string one = picture.motors.size() == 1 ? "drives" : "drive";
  std::string line = fmt::format("{} {} {} through {}", count(picture.motors.size(), "motor", "motors"), one,
                                 count(bodies, "body", "bodies"), count(picture.joints.size(), "joint", "joints"));
  if (closures > 0) line += fmt::format(", {} of which close{} loops", closures, closures == 1 ? "s" : "");
  return line + fmt::format(" · {} · {}, {}", picture.model_file, picture.motion, quantity(picture.duration, "s"));
}

}  // namespace ursula::report
