#pragma once

#include <string>

#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

/// "2,000"
std::string grouped(std::int64_t count);

/// "passed", "out of reach", …: what became of points of that verdict.
std::string verdictWords(const std::string& verdict);

/// What an output is called: "Effort of motor 3", the check's title, …
std::string titleOf(const SweepOutput& output);
/// A value of it with its unit.
std::string valueOf(const SweepOutput& output, double value);
/// The same with what it is of: "12.3 kN·m", "0.84 of its limit".
std::string saidOf(const SweepOutput& output, double value);

/// HTML of a name with dots, that may be broken after each.
std::string breakable(const std::string& name);

/// A correlation or an index: "+0.78", "0.62"; "–" where there is none.
std::string signedNumber(double value);
std::string shareNumber(double value);

/// What drives an output, as the end of a sentence: "driven by KEY, which alone makes 62 % of its variance".
std::string drivenBy(const SweepSummary& summary, const SweepOutput& output);

/// Why an output has no first-order index, in a sentence.
std::string reasonOf(NoIndex reason);

/// The page's sentence, and what stands below it.
std::string sweepSentence(const SweepSummary& summary);
std::vector<std::string> sweepRemarks(const SweepSummary& summary);

/// The command that writes a point's scenario.
std::string showCommand(const SweepSummary& summary, std::int64_t id);

/// Verdicts, outputs and their drivers in Markdown.
std::string markdownOf(const SweepSummary& summary);

}  // namespace ursula
