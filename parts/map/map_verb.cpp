#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "apps/output.h"
#include "apps/progress.h"
#include "apps/verbs.h"
#include "parts/map/pose_map.h"

namespace ursula {
namespace {

struct MapOptions {
  std::string scenario, out, picture;
  std::array<std::string, grid_axes> axes;
  double at = 0;
  RowFormat format = RowFormat::csv;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

PoseGrid gridOf(const MapOptions& options, const Scenario& scenario) {
  std::array<GridAxis, grid_axes> axes;
  for (std::size_t i = 0; i < grid_axes; ++i)
    if (!options.axes[i].empty()) axes[i] = gridAxis(grid_axis_names[i], options.axes[i]);
  return {scenario, axes, options.at};
}

int map(const MapOptions& options) {
  const bool draws = !options.picture.empty();
  const bool writes = !options.out.empty() || !draws;
  if (draws && options.picture == "-" && options.out == "-")
    throw UsageError("--out - and --picture -: expected standard output for one of them");
  const Scenario scenario = openScenario(options.scenario, {options.out, options.picture});
  const PoseGrid grid = gridOf(options, scenario);
  if (draws && grid.size() > most_drawn)
    throw UsageError(fmt::format("--picture: {} poses, expected at most {}", grid.size(), most_drawn));
  DrawnMap drawn;
  drawn.kept = draws;
  const BlockTable table = mapBlocks(scenario, grid, drawn);
  Progress progress(scenario.name);
  const auto written = [&](double share) {
    progress.at(share, fmt::format("{:.0f} of {} poses", share * static_cast<double>(grid.size()), grid.size()));
  };
  std::optional<Output> out;
  if (writes) out.emplace(options.out);
  streamBlocks(table, {options.format, options.jobs, written}, [&out](std::string_view rows) {
    if (out) out->write(rows);
  });
  if (draws) writePicture(options.picture, mapPicture(scenario, grid, drawn));
  if (out) out->commit();
  sayText(fmt::format("{}: {} of {} poses are in reach{}\n", scenario.name, drawn.reached, grid.size(),
                      drawn.reached == 0 ? "; give other ranges by --x, --y, --z" : ""));
  return exit_passed;
}

}  // namespace

void addMap(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* verb = app.add_subcommand(
      "map", "Computes reach, condition number, leg margins and largest static effort over a grid of poses");
  verb->group(computing);
  verb->add_option("scenario", options->scenario, "Scenario file (TOML), - for standard input")->required();
  for (std::size_t i = 0; i < grid_axes; ++i)
    verb->add_option(std::string("--") + grid_axis_names[i], options->axes[i],
                     std::string(i < 3 ? "Position of P in B, m" : "Angle, degrees: Q = Rz(yaw) Ry(pitch) Rx(roll)"));
  verb->add_option("--at", options->at, "Instant, s; its pose gives the coordinates that are not given")
      ->capture_default_str();
  verb->add_option("--out", options->out, "CSV file; - for standard output, the default without --picture");
  verb->add_option("--picture", options->picture,
                   "Heat maps of every quantity: SVG or PNG file; - for standard output, as SVG. PNG needs "
                   "rsvg-convert, of Debian's librsvg2-bin");
  addRowOptions(*verb, options->format, options->jobs);
  verb->footer(
      "Example: ursula map my.toml --out map.csv\n"
      "Each of --x to --yaw takes FROM,TO,COUNT, or one value. Two or three of them vary; by default x, y and z vary\n"
      "around the path.");
  verb->callback([options, &run] { run = [options] { return map(*options); }; });
}

}  // namespace ursula
