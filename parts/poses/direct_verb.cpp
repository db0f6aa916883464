#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/validate_options.h"
#include "apps/verbs.h"
#include "base/csv.h"
#include "parts/poses/direct_kinematics.h"
#include "parts/poses/direct_mechanism.h"
#include "parts/poses/ups_poses.h"

namespace ursula {
namespace {

struct DirectOptions {
  std::string scenario, motion, phi, d, coordinates, out = "-";
  std::vector<std::string> map;
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  return first == text.npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// An option with six numbers, one per leg.
struct NumbersOption {
  const char* option;  ///< "--phi"
  const char* symbol;  ///< "phi"
  const char* unit;
};
constexpr NumbersOption phi_option = {"--phi", "phi", "rad"}, d_option = {"--d", "d", "m"},
                        coordinates_option = {"--coordinates", "coordinate", "rad or m"};

double readNumber(const NumbersOption& option, std::string_view cell, int index) {
  const std::string_view text = trimmed(cell);
  const std::string_view digits = text.substr(text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
    throw UsageError(fmt::format("{}: {}_{} is '{}', expected a finite number, {}", option.option, option.symbol, index,
                                 text, option.unit));
  return value;
}

/// Six comma-separated numbers.
Vector6d readNumbers(const NumbersOption& option, std::string_view text) {
  Vector6d values;
  int count = 0;
  for (std::size_t start = 0; start <= text.size(); ++count) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const double value = readNumber(option, text.substr(start, end - start), count + 1);
    if (count < leg_count) values(count) = value;
    start = end + 1;
  }
  if (count != leg_count)
    throw UsageError(fmt::format("{}: {} number{}, expected six in {}, separated by commas", option.option, count,
                                 count == 1 ? "" : "s", option.unit));
  return values;
}

/// A table of columns with one row per pose.
struct PoseTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  template <class Value>
  void add(const std::string& name, const PlatformPoses& poses, Value&& value) {
    names.push_back(name);
    columns.emplace_back();
    for (const PlatformPose& pose : poses) columns.back().push_back(value(pose));
  }

  template <class Value>
  void addLegs(const char* format, const PlatformPoses& poses, Value&& value) {
    for (std::size_t i = 0; i < leg_count; ++i)
      add(fmt::format(fmt::runtime(format), i + 1), poses,
          [&](const PlatformPose& pose) { return value(pose.legs[i]); });
  }
};

PoseTable tabulate(const PlatformPoses& poses) {
  PoseTable table;
  table.add("pose", poses, [&](const PlatformPose& pose) { return static_cast<double>(&pose - poses.begin() + 1); });
  for (int k = 0; k < 3; ++k) table.add(fmt::format("p_{}_m", "xyz"[k]), poses, [k](auto& pose) { return pose.p(k); });
  for (int k = 0; k < 4; ++k) table.add(fmt::format("q_{}", "wxyz"[k]), poses, [k](auto& pose) { return pose.q(k); });
  table.add("multiplicity", poses, [](const PlatformPose& pose) { return pose.multiplicity; });
  table.add("assembles", poses, [](const PlatformPose& pose) { return pose.assembles; });
  table.add("residual_m", poses, [](const PlatformPose& pose) { return pose.residual; });
  table.addLegs("reach_{}", poses, [](const LegAtPose& leg) { return leg.in_reach; });
  table.addLegs("side_{}", poses, [](const LegAtPose& leg) { return leg.front; });
  table.addLegs("distance_{}_m", poses, [](const LegAtPose& leg) { return leg.distance; });
  table.addLegs("psi_{}_rad", poses, [](const LegAtPose& leg) { return leg.psi; });
  table.addLegs("theta_{}_rad", poses, [](const LegAtPose& leg) { return leg.theta; });
  return table;
}

/// The legs that satisfy the condition, as "legs 2, 5".
template <class Condition>
std::string legsThat(const PlatformPose& pose, Condition&& condition) {
  std::vector<std::size_t> legs;
  for (std::size_t i = 0; i < leg_count; ++i)
    if (condition(pose.legs[i])) legs.push_back(i + 1);
  return legs.empty() ? "" : fmt::format("leg{} {}", legs.size() == 1 ? "" : "s", fmt::join(legs, ", "));
}

/// Says numbers that add up to all solutions found, of `all` that exist. `counted` are real and complex ones, with
/// their multiplicities.
template <class Poses>
void sayCounts(const Poses& poses, int all, int counted, int at_infinity) {
  int differing = 0, real = 0;
  for (const auto& pose : poses) ++differing, real += pose.multiplicity;
  const int sum = counted + at_infinity;
  const std::string merged = real == differing ? "" : fmt::format(" ({} with their multiplicities)", real);
  say("{}: {} real pose{}{}, {} complex{}\n",
      sum == all ? fmt::format("{} solutions", all) : fmt::format("{} of {} solutions found", sum, all), differing,
      differing == 1 ? "" : "s", merged, counted - real,
      at_infinity > 0 ? fmt::format(", {} at infinity", at_infinity) : "");
}

void summarise(const PlatformPoses& poses) {
  int index = 0;
  sayCounts(poses, 8, poses.counted, 0);
  for (const PlatformPose& pose : poses) {
    const std::string far = legsThat(pose, [](const LegAtPose& leg) { return !leg.in_reach; });
    const std::string behind = legsThat(pose, [](const LegAtPose& leg) { return !leg.front; });
    say("pose {}: P at ({:.6f}, {:.6f}, {:.6f}) m, {}{}{}\n", ++index, pose.p.x(), pose.p.y(), pose.p.z(),
        far.empty() ? "assembles" : far + " out of reach",
        behind.empty() ? "" : "; " + behind + " behind the axis: inverse kinematics returns phi ± pi",
        pose.multiplicity > 1 ? fmt::format("; {} poses coincide: singular", pose.multiplicity) : "");
  }
}

int directOfPaper(const Scenario& scenario, const std::string& text, const DirectOptions& options) {
  const Vector6d phi = readNumbers(phi_option, text);
  PlatformPoses poses;
  try {
    poses = DirectKinematics(*scenario.manipulator).poses(phi);
  } catch (const UndeterminedPose& undetermined) {
    say("these angles do not determine the platform's poses: {}\n", undetermined.what());
    return exit_inconclusive;
  }
  const PoseTable table = tabulate(poses);
  writeOutput(options.out, csvText(table.names, table.columns));
  summarise(poses);
  if (poses.counted != 8) return exit_inconclusive;  // one may be missing
  return exit_passed;                                // that there is no real pose is also an answer
}

std::string csvOf(const Manipulator& machine, const Vector6d& driven, const UpsPoses& poses) {
  std::vector<std::string> names = {"pose", "p_x_m", "p_y_m", "p_z_m",        "q_w",
                                    "q_x",  "q_y",   "q_z",   "multiplicity", "residual_m"};
  for (int i = 1; i <= leg_count; ++i) names.push_back(fmt::format("side_{}", i));
  std::vector<std::vector<double>> columns(names.size());
  for (std::size_t k = 0; k < poses.list.size(); ++k) {
    const UpsPose& pose = poses.list[k];
    std::vector<double> row = {static_cast<double>(k + 1)};
    row.insert(row.end(), pose.p.begin(), pose.p.end());
    row.insert(row.end(), pose.q.begin(), pose.q.end());
    row.insert(row.end(), {static_cast<double>(pose.multiplicity), pose.residual});
    for (int i = 0; i < leg_count; ++i) row.push_back(isOnItsBranch(machine.leg(i), driven(i), pose));
    for (std::size_t column = 0; column < row.size(); ++column) columns[column].push_back(row[column]);
  }
  return csvText(names, columns);
}

int directOnSpheres(const Scenario& scenario, const NumbersOption& option, const std::string& text,
                    const DirectOptions& options) {
  const Manipulator& machine = *scenario.manipulator;
  const Vector6d driven = readNumbers(option, text);
  for (int i = 0; i < leg_count; ++i)
    if (machine.leg(i).kind == LegKind::UPS && driven(i) < 0)
      throw UsageError(fmt::format("{}: a length is negative, expected >= 0 m", option.option));
  UpsPoses poses;
  try {
    poses = upsPoses(machine, driven);
  } catch (const UndeterminedPose& undetermined) {
    say("these coordinates do not determine the platform's poses: {}\n", undetermined.what());
    return exit_inconclusive;
  }
  writeOutput(options.out, csvOf(machine, driven, poses));
  sayCounts(poses.list, 40, poses.counted, poses.at_infinity);
  if (const int leg = beyondStroke(machine, driven); leg >= 0)
    say("leg {}: {:g} m is not within its stroke, expected more than {:g} m and less than {:g} m\n", leg + 1,
        driven(leg), machine.leg(leg).distal.length, machine.leg(leg).distal.length + machine.leg(leg).proximal.length);
  return poses.complete() ? exit_passed : exit_inconclusive;
}

/// "six UPS legs driven by d", or "6 legs: URS legs driven by phi; UPS legs driven by d".
std::string inWords(const Manipulator& machine) {
  std::vector<std::string> kinds;
  for (const Leg& leg : machine.parameters().legs) {
    std::vector<std::string> driven;
    for (std::size_t j = 0; j < 3; ++j)
      if (leg.actuated[j]) driven.emplace_back(nameOf(rowOf(leg.kind).coordinates[j]));
    const std::string kind =
        fmt::format("{} legs {}", rowOf(leg.kind).name,
                    driven.empty() ? "without a motor" : fmt::format("driven by {}", fmt::join(driven, " and ")));
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
  }
  if (kinds.size() == 1 && machine.legCount() == leg_count) return "six " + kinds.front();
  return fmt::format("{} legs: {}", machine.legCount(), fmt::join(kinds, "; "));
}

/// The option that takes the driven coordinates of this machine.
const NumbersOption& optionFor(const Manipulator& machine) {
  const Motors motors = machine.motors();
  return allSlide(motors) ? d_option : anySlides(motors) ? coordinates_option : phi_option;
}

int directOfMechanism(const MechanismScenario& scenario, const DirectOptions& options) {
  if (options.motion.empty() || !options.phi.empty() || !options.d.empty() || !options.coordinates.empty())
    throw UsageError(
        fmt::format("{} has [mechanism], expected FILE.csv with the motors' coordinates and no --phi, --d or "
                    "--coordinates",
                    scenario.file.string()));
  return directOfMechanism(scenario, options.motion, options.out, options.map);
}

/// Refuses an option that does not suit the machine.
int direct(const DirectOptions& options) {
  const AnyScenario any = readAny(options.scenario, {options.out}, options.map);
  if (any.mechanism) return directOfMechanism(*any.mechanism, options);
  requireUsed(options.map, any);
  const Scenario& scenario = *any.manipulator;
  if (!options.motion.empty())
    throw UsageError(fmt::format("{}: {} has [manipulator], expected one pose: --phi, --d or --coordinates",
                                 options.motion, scenario.file.string()));
  const Manipulator& machine = *scenario.manipulator;
  const bool of_paper = machine.isOfThePaper();
  if (!of_paper && !tipsAreOnSpheres(machine))
    throw UsageError(fmt::format(
        "{} has {}, expected six URS legs driven by phi, or six UPS, RUS or PUS legs, each driven by d, phi or d",
        scenario.file.string(), inWords(machine)));
  const NumbersOption& option = optionFor(machine);
  const int count = !options.phi.empty() + !options.d.empty() + !options.coordinates.empty();
  const std::string& own = &option == &phi_option ? options.phi
                           : &option == &d_option ? options.d
                                                  : options.coordinates;
  const std::string& text = own.empty() ? options.coordinates : own;
  if (count != 1 || text.empty())
    throw UsageError(fmt::format("{} has {}, expected {} {}_1,...,{}_6", scenario.file.string(), inWords(machine),
                                 option.option, option.symbol, option.symbol));
  return of_paper ? directOfPaper(scenario, text, options) : directOnSpheres(scenario, option, text, options);
}

}  // namespace

void addDirect(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<DirectOptions>();
  CLI::App* verb = app.add_subcommand(
      "direct",
      "Computes every real pose of the platform for given leg angles or lengths, or the assemblies of a mechanism");
  verb->group(computing);
  verb->add_option("scenario", options->scenario, "Scenario file (TOML), - for standard input")->required();
  verb->add_option(
      "motion", options->motion,
      "For a scenario with [mechanism]: CSV file with the motors' coordinates, q_k_rad or q_k_m or by the\n"
      "joint's name, and optionally t_s. Each row continues the assembly of the row before, the first that\n"
      "at the motion's start");
  verb->add_option("--phi", options->phi,
                   "Angles of six URS or six RUS legs, rad, separated by commas: phi_1,...,phi_6");
  verb->add_option("--d", options->d, "Lengths or strokes of six UPS or PUS legs, m, separated by commas: d_1,...,d_6");
  verb->add_option("--coordinates", options->coordinates,
                   "Driven coordinates, rad or m, in the motors' order, separated by commas: of six legs that are UPS\n"
                   "driven by d, RUS driven by phi or PUS driven by d, in any mix; or of six URS legs driven by phi");
  addMapOption(*verb, options->map);
  verb->add_option("--out", options->out, "CSV file; - for standard output")->capture_default_str();
  verb->footer(
      "Example: ursula direct my.toml --phi 0.1,0.2,0.1,0.2,0.1,0.2\n"
      "Each row is one pose. URS legs have at most eight poses, those that assemble come first; other legs at most "
      "40.\n"
      "A pose that leg i cannot reach has assembles = 0, reach_i = 0 and psi_i, theta_i = nan. If side_i = 1, inverse\n"
      "kinematics returns phi_i for B_i; if it is 0, inverse kinematics returns phi_i ± pi. psi and theta are for the\n"
      "manipulator's own bend of each knee; the other bend also reaches. For other legs side_i = 0 says that the leg "
      "is\n"
      "beyond its stroke (UPS) or bends the other way (RUS, PUS).\n"
      "Exit code: 0 if every real pose was found (if there is none, only the header is written), 2 for bad input,\n"
      "3 if the platform is free to move or a pose may be missing.");
  verb->callback([options, &run] { run = [options] { return direct(*options); }; });
}

}  // namespace ursula
