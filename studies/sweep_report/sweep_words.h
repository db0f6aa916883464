#pragma once

#include <string>

#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

/// "2,000"
std::string grouped(std::int64_t count);

/// Returns words for the points of that verdict: "passed", "out of reach", ….
std::string verdictWords(const std::string& verdict);

/// Returns an output's title: "Effort of motor 3", the check's title, …
std::string titleOf(const SweepOutput& output);
/// Returns one of its values with the unit.
std::string valueOf(const SweepOutput& output, double value);
/// Returns the value as a sentence says it: "12.3 kN·m", "0.84 of its limit".
std::string saidOf(const SweepOutput& output, double value);

/// Returns a dotted name as HTML that may break after each dot.
std::string breakable(const std::string& name);

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

}  // namespace ursula
