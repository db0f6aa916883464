#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/number_tolerances.h"
#include "model/scenario.h"
#include "parts/identify/measured_log.h"
#include "validation/verdict/result.h"

namespace ursula {

struct IdentifyOptions {
  bool prior = false;                ///< the scenario's tolerances are its numbers' prior uncertainty
  NumberTolerances tolerances = {};  ///< replace those that the scenario states, unless empty
  std::function<void(double share, const std::string& what)> progress = {};
};

/// A possible cause of a difference between measured and modelled efforts: a number of the machine, or a property of
/// the log.
struct MeasuredCause {
  std::string kind;  ///< "parameter", "effort_offset", "effort_scale", "encoder_offset", "elastic_joint", "backlash",
                     ///< "load_dependent_friction", "order", "units", "sign"
  std::string parameter;  ///< the scenario's path; empty if the cause is no number of it
  std::string what, unit;
  int motor = 0;  ///< 1-based; 0 for none
  double expected = 0, found = 0, uncertainty = 0;
  double tolerances = 0;                  ///< deviation in units of its tolerance; 0 without one
  double score = 0;                       ///< change divided by what tolerances and noise allow
  double explained = 0;                   ///< share of the deviation's square that it explains
  bool misread = false;                   ///< the log is misread; no number of the model is wrong
  bool outside = false;                   ///< no combination of masses, inertias and friction does the same
  std::vector<std::string> as_well = {};  ///< causes that cannot be told from it
};

/// The log's value of a number or combination, with its 95 % interval.
struct MeasuredNumber {
  std::string name;   ///< path, or the combination in words
  std::string group;  ///< "mass", "center", "inertia", "friction", "rotor", "offset", "delay"
  std::string unit;
  double nominal = 0, value = 0, uncertainty = 0, low = 0, high = 0;
  double tolerance = -1;   ///< stated tolerance; negative for none
  double least_found = 0;  ///< smallest deviation that the log tells from tolerances and noise in 95 % of all cases; 0
                           ///< if there is no such or no tolerance
  bool identified = true;  ///< whether a single number's uncertainty is below a tenth of its assumed size
  std::vector<std::pair<std::string, double>> terms = {};  ///< names and factors of a combination
};

/// Agreement of a motor's measured efforts with the model.
struct MotorAgreement {
  std::string unit;
  double effort = 0;     ///< measured root mean square
  double deviation = 0;  ///< root mean square of E = S − D
  double largest = 0, largest_at_s = 0;
  double u_num = 0, u_input = 0, u_D = 0, u_val = 0;  ///< standard uncertainties, root mean squares
  double within = 0;                                  ///< share of instants with |E| ≤ 1.96 u_val
  double noise = 0;                                   ///< standard deviation of one raw sample
  double left = 0;                                    ///< residual of the fitted model, root mean square
  double expected = 0;                                ///< residual that noise alone explains; 0 if unknown
};

struct IdentifyResult {
  Scenario scenario;
  std::string file, read_as, version;
  std::vector<std::string> ignored;
  Verdict verdict = Verdict::inconclusive;
  std::string sentence;
  std::vector<LogFinding> findings;
  std::vector<MeasuredCause> causes;
  double step = 0, duration = 0;  ///< step and duration of the log, s
  std::size_t rows = 0;
  int periods = 1;
  double bandwidth = 0, state_cut = 0, effort_cut = 0;  ///< Hz
  Eigen::Index instants = 0;                            ///< number of judged instants
  double delay = 0, delay_uncertainty = 0;              ///< delay of efforts behind the motion, s
  double squares = 0, squares_limit = 0, threshold = 0;
  PerMotor<MotorAgreement> motors;
  std::vector<MeasuredNumber> combinations, numbers;
  std::vector<std::string> unseen;  ///< numbers without effect on this motion's efforts
  double validation_given = 0, validation_fitted = 0, validation_from_s = 0;
  std::string identified_scenario;  ///< TOML
  TimeSeries series;                ///< t_s; tau_i, model_i, fitted_i and u_val_i for each motor
  TimeSeries spectra;               ///< f_Hz; residual_i is the fitted model's residual density, effort²/Hz
};

/// Compares measured efforts with the model, and estimates the machine's numbers. Throws CsvError if the machine cannot
/// follow the log's motion.
IdentifyResult identify(const Scenario& scenario, MeasuredLog log, const IdentifyOptions& options = {});

/// Returns the text of `summary.json`.
std::string identifySummary(const IdentifyResult& result);
/// Returns the text of `parameters.csv`, with a row for each combination and number.
std::string identifyTable(const IdentifyResult& result);
/// Returns text for a terminal.
std::string identifyText(const IdentifyResult& result);
/// Returns the text of `report.html`.
std::string identifyPage(const IdentifyResult& result);

}  // namespace ursula
