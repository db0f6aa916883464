#include "apps/suggest.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/output.h"
#include "apps/verbs.h"
#include "model/scenario_files.h"
#include "model/toml_writer.h"
#include "report/text/terminal.h"
#include "validation/blind_spots.h"

namespace ursula {
namespace {

constexpr double turn = 0.3, shift = 0.1;  // rad; share of a length of the machine
constexpr int halvings = 8;

/// Displacements and turns of the platform at the points of the motion, as shares of the largest: all at once, and
/// unlike each other, so that no term is left out or proportional to another.
constexpr double points[][6] = {{0, 0, 0, 0, 0, 0},
                                {0.6, -0.4, 0.5, 0.5, 0.7, 1},
                                {-0.7, 0.5, -0.3, -0.8, 0.4, -0.6},
                                {0.3, 0.8, 0.6, 0.9, -0.7, 0.8},
                                {-0.5, -0.6, -0.5, -0.4, -0.9, -1},
                                {0.8, 0.2, -0.4, 0.6, 0.5, -0.3},
                                {0, 0, 0, 0, 0, 0}};
constexpr double seconds_between = 0.5;

toml::array numbers(std::initializer_list<double> values) {
  toml::array out;
  for (const double value : values) out.push_back(value);
  return out;
}

/// Waypoints about the middle of the scenario's motion, `share` of the whole size.
toml::table waypoints(const Scenario& scenario, double share) {
  const Motion<double> middle = scenario.trajectory->at(scenario.trajectory->duration() / 2);
  double length = 0;
  for (const Leg& leg : scenario.manipulator->parameters().legs)
    length = std::max(length, (middle.p + middle.Q * leg.platform_point - leg.base_point).norm());
  toml::array all;
  for (std::size_t k = 0; k < std::size(points); ++k) {
    const auto& at = points[k];
    const Vector3d p = middle.p + share * shift * length * Vector3d(at[0], at[1], at[2]);
    const Vector3d angle = share * turn * Vector3d(at[3], at[4], at[5]);
    const Eigen::AngleAxisd by(angle.norm(), angle.norm() > 0 ? Vector3d(angle.normalized()) : Vector3d::UnitZ());
    const Eigen::Quaterniond q(Matrix3d(by.toRotationMatrix() * middle.Q));
    all.push_back(toml::table{{"time", seconds_between * static_cast<double>(k)},
                              {"position", numbers({p.x(), p.y(), p.z()})},
                              {"orientation", numbers({q.w(), q.x(), q.y(), q.z()})}});
  }
  return toml::table{{"kind", "waypoints"}, {"points", all}};
}

/// A series of each motor about the middle of the scenario's motion, with phases of its own.
toml::table fourier(const MechanismScenario& scenario, double share) {
  const Eigen::VectorXd middle = scenario.trajectory->at(scenario.trajectory->duration() / 2).q;
  toml::array all;
  for (std::size_t k = 0; k < scenario.mechanism->motorCount(); ++k) {
    const double size = share * (scenario.mechanism->motor(k).slides() ? shift * scenario.mechanism->length() : turn);
    const double phase = 1 + 0.7 * static_cast<double>(k);
    all.push_back(toml::table{{"offset", middle(static_cast<Eigen::Index>(k))},
                              {"sin", numbers({size * std::sin(phase), 0.4 * size * std::sin(2.3 * phase)})},
                              {"cos", numbers({size * std::cos(phase), 0.4 * size * std::cos(2.3 * phase)})}});
  }
  return toml::table{{"kind", "fourier"}, {"duration", 2.0}, {"period", 2.0}, {"motors", all}};
}

/// The text of the scenario with another motion; the files that it names are absolute.
std::string withMotion(const std::string& text, const std::filesystem::path& file, const toml::table& motion) {
  toml::table document = toml::parse(text);
  document.insert_or_assign("trajectory", motion);
  makeFilesAbsolute(document, file);
  return tomlText(document);
}

/// A scenario that can make its motion.
struct Suggested {
  std::string text;
  std::vector<BlindSpot> blind;
};

/// Returns the largest such motion that the machine can make.
Suggested suggested(const AnyScenario& scenario) {
  for (int k = 0;; ++k) {
    const double share = std::ldexp(1, -k);
    try {
      AnyScenario other;
      std::string text;
      if (scenario.mechanism) {
        const MechanismScenario& its = *scenario.mechanism;
        text = withMotion(its.text, its.file, fourier(its, share));
        other.mechanism = parseMechanism(text, its.file);
      } else {
        const Scenario& its = *scenario.manipulator;
        text = withMotion(its.text, its.file, waypoints(its, share));
        other.manipulator = parseScenario(text, its.file);
        tryMotion(*other.manipulator);
      }
      return {text, *blindSpotsOf(other)};
    } catch (const ScenarioError&) {
      if (k == halvings) throw;
    }
  }
}

}  // namespace

std::optional<std::vector<BlindSpot>> blindSpotsOf(const Scenario* manipulator, const MechanismScenario* mechanism) {
  const BlindSpotFinder* finder = partBlindSpots();
  if (finder == nullptr) return std::nullopt;
  if (manipulator != nullptr) return alongMotion(*manipulator, [&] { return finder->manipulator(*manipulator); });
  return alongLoops(*mechanism, [&] { return finder->mechanism(*mechanism); });
}

void requireSuggestion(const std::string& out) {
  if (partBlindSpots() == nullptr) throw UsageError("--suggest: this build knows no mistakes; ./dev build adds them");
  if (namesFile(out) && std::filesystem::exists(std::filesystem::symlink_status(out)))
    throw UsageError(out + " exists, expected the name of a new file");
}

void suggestMotion(const AnyScenario& scenario, const std::vector<BlindSpot>& blind, const std::string& out) {
  const Suggested other = suggested(scenario);
  const auto stays = [&](const BlindSpot& one) {
    return std::any_of(other.blind.begin(), other.blind.end(),
                       [&](const BlindSpot& each) { return each.mistake == one.mistake; });
  };
  const auto stay = std::count_if(blind.begin(), blind.end(), stays);
  const auto before = static_cast<std::ptrdiff_t>(blind.size());
  if (stay == before) {
    say("no motion that was tried shows more\n");
  } else {
    writeOutput(out, other.text);
    say("{} of {} kinds of mistakes that did not show do with this motion\n", before - stay, before);
  }
  sayText(withoutControls(report::blindText(other.blind)));
  if (namesFile(out) && stay != before) say("wrote {}; next: ursula validate {}\n", out, shellWord(out));
}

}  // namespace ursula
