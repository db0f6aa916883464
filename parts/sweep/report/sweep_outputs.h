#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "parts/sweep/report/sweep_rows.h"
#include "parts/sweep/report/sweep_summary.h"
#include "parts/sweep/sqlite.h"
#include "report/page/plots.h"

namespace ursula {

/// Determines the outputs from the results' names, and their values for a point.
class OutputPlan {
 public:
  OutputPlan(bool validates, const std::vector<std::string>& names);

  /// The outputs without statistics.
  const std::vector<SweepOutput>& outputs() const { return outputs_; }
  /// Computes one number per output, NaN if the point has none.
  void evaluate(const SweepRow& row, std::vector<double>& values) const;
  /// Returns the largest output of the group whose largest value is the first output.
  std::size_t largestOf(const std::vector<double>& values) const;
  /// 1 to 6; 0 if no leg refused the point.
  int refusedLeg(const SweepRow& row) const;

 private:
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

  std::size_t groupOf(OutputKind kind, const std::string& unit);

  std::vector<SweepOutput> outputs_;
  std::vector<std::size_t> place_,
      group_;  ///< for each name: the index of its output, and of the output with its group's largest value
  std::size_t refused_leg_ = nowhere;  ///< index among the names
};

/// Writes a row per point by ascending id: `id`, `verdict`, a column per varied number by its key, and one per result
/// by its name. For checks NAME.limit and NAME.verdict follow; the last column is `error`. Numbers have 17 significant
/// digits; missing values are empty cells. Texts are quoted as in RFC 4180 if needed. Computing times are omitted, so
/// equal points give equal bytes. Throws DatabaseError.
void writeSweepCsv(Sqlite& database, const std::function<void(std::string_view)>& sink);

// Words for the page.

/// "2,000"
std::string grouped(std::int64_t count);

/// Returns words for the points of that verdict: "passed", "out of reach", ….
std::string verdictWords(const std::string& verdict, bool judges = true);

/// Returns an output's title: "Effort of motor 3", the check's title, …
std::string titleOf(const SweepOutput& output);
/// Returns one of its values with the unit.
std::string valueOf(const SweepOutput& output, double value);
/// Returns the value as a sentence says it: "12.3 kN·m", "0.84 of its limit".
std::string saidOf(const SweepOutput& output, double value);

/// Returns a dotted name as HTML that may break after each dot.
std::string breakable(const std::string& name);

/// Returns the key of a number in words: "manipulator.platform.center_of_mass.2" → "platform mass centre z (m)".
std::string keyWords(const std::string& key);

/// Formats a correlation or an index: "+0.78", "0.62"; "–" if there is none.
std::string signedNumber(double value);
std::string shareNumber(double value);

/// Returns what drives an output, as the end of a sentence: "driven by KEY, which alone makes 62 % of its variance".
std::string drivenBy(const SweepSummary& summary, const SweepOutput& output);

/// Returns why an output has no first-order index, in a sentence.
std::string reasonOf(NoIndex reason);

/// Returns the page's sentence, and the remarks below it.
std::string sweepSentence(const SweepSummary& summary);
std::vector<std::string> sweepRemarks(const SweepSummary& summary);

/// Returns the command that writes a point's scenario.
std::string showCommand(const SweepSummary& summary, std::int64_t id);

/// Returns verdicts, outputs and their drivers in Markdown.
std::string markdownOf(const SweepSummary& summary);

/// report.html: one file that needs no network. Its tables and maps need no script.
std::string sweepPage(const SweepSummary& summary);

std::vector<report::Plot> scatterPlots(const SweepSummary& summary);

// Parts of the page in HTML; empty if there is nothing to draw.

std::string histograms(const SweepSummary& summary);
std::string gridMaps(const SweepSummary& summary);

// Parts of the page in HTML; empty if there is nothing to show.

/// The numbers that drive the primary output, with bars.
std::string driversTable(const SweepSummary& summary);
/// Parameters by outputs: rank correlations, and first-order indices.
std::string correlationTable(const SweepSummary& summary);
std::string indexTable(const SweepSummary& summary);
std::string outputsTable(const SweepSummary& summary);
std::string worstTable(const SweepSummary& summary);
std::string parametersTable(const SweepSummary& summary);
std::string pasteBox(const SweepSummary& summary);

/// Returns the pairs to draw, without rows. The two strongest of the primary output come first, then the strongest of
/// other outputs. Each of these appears once, a parameter at most twice. Insignificant relations are omitted.
std::vector<Scatter> pairsToDraw(const SweepSummary& summary, std::size_t most);

/// Returns the rows to draw: all, or most_scattered spread evenly and without a period.
std::vector<std::size_t> rowsToDraw(std::size_t rows);

/// Returns the outputs to draw over a grid of two parameters.
std::vector<std::size_t> outputsToMap(const SweepSummary& summary, std::size_t most);

/// Sorts `values` at the points `x`, `y` into the grid of these ascending levels.
std::vector<double> onGrid(const std::vector<double>& x_levels, const std::vector<double>& y_levels,
                           const std::vector<double>& x, const std::vector<double>& y,
                           const std::vector<double>& values);

}  // namespace ursula
