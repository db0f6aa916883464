#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "studies/sweep/sweep_database.h"
#include "studies/sweep_report/relations.h"

namespace ursula {

/// What is looked at of each point: a result, or what is made of several.
enum class OutputKind {
  largest_effort,  ///< of the motors of one unit
  effort,          ///< of one motor
  kappa,           ///< condition number of B
  sine,            ///< least margin of the legs: |sin θ|, or what takes its place
  largest_share,   ///< the largest share that a check takes of its limit
  check_share,     ///< value over limit of one check
  not_passed,      ///< 0 where the verdict is "pass", else 1
  other
};

/// Why there are no first-order indices.
enum class NoIndex { none, too_few, grid_not_complete, constant };

struct SweepOutput {
  OutputKind kind = OutputKind::other;
  std::string name;  ///< the result's; empty of what is made of several
  std::string unit;  ///< as columns write it
  int motor = -1;    ///< 0-based, of an effort
  Spread spread;
  Histogram histogram;
  std::int64_t worst_point = -1;    ///< id of the largest value; of a sine, the smallest
  std::vector<Relation> relations;  ///< one for each parameter
  NoIndex no_index = NoIndex::none;
};

struct SweepParameter {
  std::string key;
  Spread spread;
  std::size_t levels = 0;  ///< different values, up to one more than most_levels
};
constexpr std::size_t most_levels = 1000;

/// A pair that is drawn, a row for each point; no more than most_scattered of them.
struct Scatter {
  std::size_t parameter = 0, output = 0;
  std::vector<double> x, y;
};
constexpr std::size_t most_scattered = 2000;

/// An output over a grid of two parameters: `values`, the first parameter the fastest, NaN where a point has none.
struct GridMap {
  std::size_t output = 0;
  std::vector<double> x, y;  ///< ascending levels of the two
  std::vector<double> values;
};

struct WorstPoint {
  std::int64_t id = 0;
  std::string verdict, error;
  std::vector<double> parameters;
  double score = 0;         ///< of the primary output; NaN where the point has none
  std::size_t because = 0;  ///< index of the output that has it: the motor, the check
};
constexpr std::size_t most_worst = 10;

/// What a sweep found, as typed facts: words are made of them last.
struct SweepSummary {
  SweepIdentity identity;  ///< without the scenario's text
  std::int64_t points_done = 0;
  std::map<std::string, std::int64_t> verdicts;  ///< how many points of each
  std::array<std::int64_t, 6> refused_by_leg{};  ///< points that a leg could not take
  std::vector<SweepParameter> parameters;
  std::vector<SweepOutput> outputs;  ///< those without any number are left out
  std::size_t primary = 0;           ///< the output that the page leads with; outputs.size(): none
  std::size_t pairs = 0;  ///< of parameters and outputs: one in a hundred sweeps of unrelated numbers has any
                          ///< that is told from chance
  std::vector<Scatter> scatters;
  std::vector<GridMap> maps;
  std::vector<WorstPoint> worst;
};

/// Reads a database twice, in memory for some ten columns of it. Throws DatabaseError.
SweepSummary summarise(Sqlite& database);

/// How much a parameter drives an output, from 0 to 1, for the order of pairs: the larger of |rank correlation| and the
/// root of the first-order index, as far as they are told from chance.
double strength(const Relation& relation);
/// The parameter of the largest strength; the number of parameters where none is told from chance.
std::size_t driver(const SweepOutput& output);

}  // namespace ursula
