#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "parts/sweep/report/relations.h"
#include "parts/sweep/sweep_database.h"

namespace ursula {

/// A quantity of each point: one result, or a combination of several.
enum class OutputKind {
  largest_effort,  ///< over the motors of one unit
  effort,          ///< of one motor
  kappa,           ///< condition number of B
  sine,            ///< smallest margin of the legs: |sin θ|, or its equivalent
  largest_share,   ///< the largest share of its limit that a check reaches
  check_share,     ///< value over limit of one check
  not_passed,      ///< 0 if the verdict is "pass", else 1
  other
};

/// Why there are no first-order indices.
enum class NoIndex { none, too_few, grid_not_complete, constant };

struct SweepOutput {
  OutputKind kind = OutputKind::other;
  std::string name = {};  ///< the result's name; empty for a combination
  std::string unit = {};  ///< as in columns
  int motor = -1;         ///< 0-based, for an effort
  Spread spread = {};
  Histogram histogram = {};
  std::int64_t worst_point = -1;         ///< id of the largest value; for a sine, of the smallest
  std::vector<Relation> relations = {};  ///< one per parameter
  NoIndex no_index = NoIndex::none;
};

struct SweepParameter {
  std::string key;
  Spread spread;
  std::size_t levels = 0;  ///< number of different values, up to most_levels + 1
};
constexpr std::size_t most_levels = 1000;

/// A drawn pair with a row per point, at most most_scattered.
struct Scatter {
  std::size_t parameter = 0, output = 0;
  std::vector<double> x, y;
};
constexpr std::size_t most_scattered = 2000;

/// An output over a grid of two parameters: `values`, with the first parameter fastest and NaN for missing ones.
struct GridMap {
  std::size_t output = 0;
  std::vector<double> x, y;  ///< ascending levels of the two parameters
  std::vector<double> values;
};

struct WorstPoint {
  std::int64_t id = 0;
  std::string verdict, error;
  std::vector<double> parameters;
  double score = 0;         ///< value of the primary output; NaN if the point has none
  std::size_t because = 0;  ///< index of the output with that value: the motor, the check
};
constexpr std::size_t most_worst = 10;

/// The facts of a sweep's results, from which texts are made.
struct SweepSummary {
  SweepIdentity identity;  ///< without the scenario's text
  std::int64_t points_done = 0;
  std::map<std::string, std::int64_t> verdicts;  ///< number of points per verdict
  std::array<std::int64_t, 6> refused_by_leg{};  ///< number of points that a leg could not take
  std::vector<SweepParameter> parameters;
  std::vector<SweepOutput> outputs;  ///< outputs without any number are omitted
  std::size_t primary = 0;           ///< the main output of the page; outputs.size() if there is none
  std::size_t pairs =
      0;  ///< number of tested pairs; one in a hundred sweeps with unrelated numbers has a significant pair
  std::vector<Scatter> scatters;
  std::vector<GridMap> maps;
  std::vector<WorstPoint> worst;
};

/// Reads a database twice, with some ten of its columns in memory. Throws DatabaseError.
SweepSummary summarise(Sqlite& database);

/// How strongly a parameter drives an output, from 0 to 1, to sort pairs. It is the larger significant one of |rank
/// correlation| and the root of the first-order index.
double strength(const Relation& relation);
/// Returns the parameter with the largest strength; the number of parameters if none is significant.
std::size_t driver(const SweepOutput& output);

}  // namespace ursula
