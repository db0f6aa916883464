#include <memory>

#include "apps/verbs.h"
#include "model/csv.h"
#include "model/instants.h"
#include "model/scenario_input.h"
#include "nocsolver/solver.h"
#include "validation/findings/timeseries.h"
#include "validation/subject/subject.h"
#include "validation/validate.h"

namespace ursula {
namespace {

struct InverseOptions {
  std::string scenario, out = "-";
  int samples = 301;
};

TimeSeries inverseAlong(const Scenario& scenario, int samples) {
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  std::vector<Motion<double>> motions;
  std::vector<JointMotion> joints;
  std::vector<Vector6d> torques;
  for (double t : equallySpaced(scenario.trajectory->duration(), samples)) {
    motions.push_back(scenario.trajectory->at(t));
    torques.push_back(solver.inverseDynamics(motions.back(), work, loadAtP(scenario.load.get(), motions.back())));
    solver.inverseKinematics(motions.back(), work);
    joints.push_back({solver.angles(work), solver.rates(work), solver.accelerations(work)});
  }
  return inverseSeries(*scenario.manipulator, motions, joints, torques);
}

int inverse(const InverseOptions& options) {
  const Scenario scenario = readScenarioOrInput(options.scenario);
  const TimeSeries series = alongMotion(scenario, [&] { return inverseAlong(scenario, options.samples); });
  writeOutput(options.out, csvText(series.names, series.columns));
  return exit_passed;
}

}  // namespace

void addInverse(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<InverseOptions>();
  CLI::App* verb = app.add_subcommand("inverse", "Motion, joint variables and torques along the trajectory, as CSV");
  verb->add_option("scenario", options->scenario, "Scenario file (TOML), - for standard input")->required();
  verb->add_option("--samples", options->samples, "Equally spaced instants from 0 to t_f")
      ->check(CLI::Range(2, 10000000))
      ->capture_default_str();
  verb->add_option("--out", options->out, "CSV file; - for standard output")->capture_default_str();
  verb->callback([options, &run] { run = [options] { return inverse(*options); }; });
}

}  // namespace ursula
