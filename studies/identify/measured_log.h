#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "model/manipulator.h"

namespace ursula {

/// Something of a log, or of a model, that its user has to know. `kind` is one of a fixed set of words.
struct LogFinding {
  std::string kind;  ///< "drop_outs", "saturation", "quantisation", "jitter", "swapped", "units", …
  int channel = -1;  ///< 0-based motor; −1: of no motor
  double value = 0;  ///< how much, in `unit`
  std::string unit;
  std::string what;  ///< in a sentence
};

/// How a log is to be read.
struct LogOptions {
  std::filesystem::path file;
  std::vector<std::string> map;   ///< NAME=COLUMN
  std::vector<double> constants;  ///< N·m/A, or N/A: none, one for all motors, or six
};

/// A log on a grid of equal steps. Rows that are missing are there, filled between their neighbours and marked.
struct MeasuredLog {
  std::filesystem::path file;
  std::string read_as;
  std::vector<std::string> ignored;
  double start = 0, step = 0;  ///< s, of the rows here
  double file_step = 0;        ///< s, of the file's rows
  std::size_t file_rows = 0;
  int averaged = 1;        ///< neighbouring rows of the file in one here
  bool has_poses = false;  ///< `motion` has p, m, and q [w, x, y, z], else driven coordinates, rad or m
  bool by_currents = false;
  Eigen::MatrixXd motion;   ///< a row an instant, 6 or 7 columns
  Eigen::MatrixXd efforts;  ///< a row an instant, N·m or N
  Eigen::MatrixXd load;     ///< a row an instant, [moment about P; force] in B; no column where there is none
  std::vector<bool> missing;
  std::vector<LogFinding> findings;

  Eigen::Index rows() const { return efforts.rows(); }
  double time(double row) const { return start + row * step; }
};

/// A log has no more rows in memory: beyond, neighbours are averaged in pairs, motion and efforts alike.
constexpr std::size_t most_log_rows = std::size_t{1} << 20;

/// Reads a log as findLogColumns has it, row by row. Turning coordinates are made continuous, quaternions of one sign.
/// Cells that are empty or nan are missing. Throws CsvError with the place for what is no number, instants that do not
/// increase, gaps beyond a tenth of the log, and fewer than 16 rows.
MeasuredLog readMeasuredLog(const LogOptions& options, const Manipulator& machine);

/// The same of arrays; `motion` has 6 or 7 columns. `t` increases.
MeasuredLog measuredLogOf(const std::vector<double>& t, const Eigen::MatrixXd& motion, const Eigen::MatrixXd& efforts,
                          const Manipulator& machine);

}  // namespace ursula
