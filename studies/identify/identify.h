#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/number_tolerances.h"
#include "model/scenario.h"
#include "studies/identify/measured_log.h"
#include "validation/verdict/result.h"

namespace ursula {

struct IdentifyOptions {
  bool prior = false;                ///< the scenario's tolerances are what is known of its numbers before the log is
  NumberTolerances tolerances = {};  ///< in place of those that the scenario states, where there are some
  std::function<void(double share, const std::string& what)> progress = {};
};

/// What may make measured efforts differ from the model's: a number of the machine, or something of the log.
struct MeasuredCause {
  std::string kind;  ///< "parameter", "effort_offset", "effort_scale", "encoder_offset", "elastic_joint", "backlash",
                     ///< "load_dependent_friction", "order", "units", "sign"
  std::string parameter;  ///< the scenario's path; empty for what is no number of it
  std::string what, unit;
  int motor = 0;  ///< 1-based; 0: of none
  double expected = 0, found = 0, uncertainty = 0;
  double tolerances = 0;             ///< by how many of its tolerances it is off; 0 where none is stated
  double score = 0;                  ///< change over what tolerances and noise allow
  double explained = 0;              ///< share of the deviation's square
  bool outside = false;              ///< no combination of masses, inertias and friction does the same
  std::vector<std::string> as_well;  ///< what cannot be told from it
};

/// A number, or a combination of numbers, as a log has it. The interval is of 95 %.
struct MeasuredNumber {
  std::string name;   ///< path, or the combination in words
  std::string group;  ///< "mass", "center", "inertia", "friction", "rotor", "offset", "delay"
  std::string unit;
  double nominal = 0, value = 0, uncertainty = 0, low = 0, high = 0;
  double tolerance = -1;   ///< stated; negative: none
  bool identified = true;  ///< of single numbers: the log says of it ten times what its own size does
  std::vector<std::pair<std::string, double>> terms;  ///< of a combination: names and factors
};

/// How well a motor's measured efforts agree with the model.
struct MotorAgreement {
  std::string unit;
  double effort = 0;     ///< root mean square measured
  double deviation = 0;  ///< of E = S − D, root mean square
  double largest = 0, largest_at_s = 0;
  double u_num = 0, u_input = 0, u_D = 0, u_val = 0;  ///< standard uncertainties, root mean squares
  double within = 0;                                  ///< share of instants with |E| ≤ 1.96 u_val
  double noise = 0;                                   ///< deviation of one raw sample
  double left = 0;                                    ///< of the fitted model, root mean square
  double expected = 0;                                ///< what noise alone would leave; 0: unknown
};

struct IdentifyResult {
  Scenario scenario;
  std::string file, read_as, version;
  std::vector<std::string> ignored;
  Verdict verdict = Verdict::inconclusive;
  std::string sentence;
  std::vector<LogFinding> findings;
  std::vector<MeasuredCause> causes;
  double step = 0, duration = 0;  ///< s, of the log
  std::size_t rows = 0;
  int periods = 1;
  double bandwidth = 0, state_cut = 0, effort_cut = 0;  ///< Hz
  Eigen::Index instants = 0;                            ///< judged
  int noise_order = 0;                                  ///< of the autoregressions
  double delay = 0, delay_uncertainty = 0;              ///< s, of efforts behind the motion
  double squares = 0, squares_limit = 0, threshold = 0;
  std::array<MotorAgreement, motor_count> motors;
  std::vector<MeasuredNumber> combinations, numbers;
  std::vector<std::string> unseen;  ///< numbers that the motion shows nothing of
  double validation_given = 0, validation_fitted = 0, validation_from_s = 0;
  std::string identified_scenario;  ///< TOML
  TimeSeries series;                ///< t_s; tau_i, model_i, fitted_i, u_val_i of each motor
  TimeSeries spectra;               ///< f_Hz; residual_i: density of what the fitted model leaves, effort²/Hz
};

/// Measured efforts against the model: what the log says of the machine's numbers. Throws CsvError and ScenarioError as
/// readMeasuredLog does, and where the machine cannot follow.
IdentifyResult identify(const Scenario& scenario, MeasuredLog log, const IdentifyOptions& options = {});

/// `summary.json`.
std::string identifySummary(const IdentifyResult& result);
/// `parameters.csv`: a row for each combination and number.
std::string identifyTable(const IdentifyResult& result);
/// For a terminal.
std::string identifyText(const IdentifyResult& result);
/// `report.html`.
std::string identifyPage(const IdentifyResult& result);

}  // namespace ursula
