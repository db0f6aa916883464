#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "model/manipulator.h"

namespace ursula {

/// A fact about a log or model that its user has to know.
struct LogFinding {
  /// What the fact makes of the verdict by itself.
  enum class Decides { nothing, undecided, fail };

  std::string kind;  ///< "drop_outs", "saturation", "quantisation", "jitter", "swapped", "units", …
  int channel = -1;  ///< 0-based motor; −1 for none
  double value = 0;  ///< size, in `unit`
  std::string unit;
  std::string what;  ///< the fact in a sentence
  Decides decides = Decides::nothing;
};

/// Options for reading a log.
struct LogOptions {
  std::filesystem::path file;
  std::vector<std::string> map;   ///< NAME=COLUMN
  std::vector<double> constants;  ///< motors' constants, N·m/A or N/A: none, one for all motors, or six
};

/// A log on a grid of equal steps. Missing rows are interpolated and marked.
struct MeasuredLog {
  std::filesystem::path file;
  std::string read_as;
  std::vector<std::string> ignored;
  double start = 0, step = 0;  ///< first instant and step of these rows, s
  double file_step = 0;        ///< step of the file's rows, s
  std::size_t file_rows = 0;
  int every = 1;                  ///< this row of the file and its multiples are taken
  bool has_poses = false;         ///< `motion` has p (m) and q [w, x, y, z]; otherwise driven coordinates, rad or m
  Eigen::MatrixXd motion;         ///< an instant in each row, 6 or 7 columns
  Eigen::MatrixXd efforts;        ///< N·m or N, an instant in each row, a motor in each column
  Eigen::MatrixXd load;           ///< [moment about P; force] in B, an instant in each row; no columns without a load
  std::vector<bool> filled = {};  ///< rows of short gaps, which a cubic fills; empty without any
  std::vector<bool> missing;
  std::vector<LogFinding> findings;

  Eigen::Index rows() const { return efforts.rows(); }
  double time(double row) const { return start + row * step; }
};

/// Largest number of rows in memory. Beyond it, every second row is taken, then every fourth, up to a step of 0.01 s.
/// Averages would filter motion and efforts alike, but not what they make of each other.
constexpr std::size_t most_log_rows = std::size_t{1} << 20;

/// Reads a log row by row with the columns of findLogColumns. It unwraps turning coordinates and makes quaternions of
/// one sign. Empty and nan cells are missing. Throws CsvError with the place for text that is no number, instants that
/// do not increase, gaps beyond a tenth of the log, and fewer than 16 rows.
MeasuredLog readMeasuredLog(const LogOptions& options, const Manipulator& machine);

/// Makes a log of arrays; `motion` has 6 or 7 columns, and `t` increases.
MeasuredLog measuredLogOf(const std::vector<double>& t, const Eigen::MatrixXd& motion, const Eigen::MatrixXd& efforts,
                          const Manipulator& machine);

}  // namespace ursula
