#include "report/files/written_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/text/text.h"

namespace ursula::report {
namespace {

struct Counts {
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;

  Counts& operator+=(const Counts& other) {
    tests += other.tests;
    failures += other.failures;
    errors += other.errors;
    skipped += other.skipped;
    return *this;
  }
  std::string attributes() const {
    return fmt::format(R"(tests="{}" failures="{}" errors="{}")", tests, failures, errors);
  }
};

std::string valueAndLimit(const Check& check) {
  const std::string unit = check.unit.empty() ? "" : " " + check.unit;
  return fmt::format("value {}{}, limit {}{}", number(check.value, 6), unit, number(check.limit, 6), unit);
}

std::string outcome(const Check& check) {
  const std::string basis = check.basis.empty() ? "" : "\nlimit from: " + check.basis;
  const std::string text = escaped(whyInFull(check) + "\n" + valueAndLimit(check) + basis);
  switch (check.verdict) {
    case Verdict::fail:
      return fmt::format("<failure type=\"check\" message=\"{}\">{}</failure>",
                         escaped(valueAndLimit(check) + ": " + whyInFull(check)), text);
    case Verdict::inconclusive:
      return fmt::format("<skipped message=\"inconclusive: {}\"/><system-out>{}</system-out>",
                         escaped(whyInFull(check)), text);
    case Verdict::not_applicable:
      return fmt::format("<skipped message=\"not applicable: {}\"/>", escaped(whyInFull(check)));
    case Verdict::pass:
      break;
  }
  return fmt::format("<system-out>{}</system-out>", text);
}

std::string testCase(const std::string& scenario, const std::string& name, const std::string& content) {
  return fmt::format("    <testcase classname=\"{}\" name=\"{}\">{}</testcase>\n", escaped(scenario), escaped(name),
                     content);
}

std::string suiteCases(const SuiteEntry& entry, Counts& counts) {
  std::vector<Check> checks = entry.checks;
  const bool accounted = !checks.empty() && overall(checks) == entry.verdict;
  if (!accounted && entry.verdict != Verdict::pass && entry.error.empty()) {
    checks.push_back(notMade("verdict", "", reason(entry.verdict, entry.checks)));
    checks.back().verdict = entry.verdict;
  }
  std::string cases;
  for (const Check& check : checks) {
    ++counts.tests;
    counts.failures += check.verdict == Verdict::fail;
    counts.skipped += check.verdict == Verdict::inconclusive || check.verdict == Verdict::not_applicable;
    cases += testCase(entry.scenario, check.name, outcome(check));
  }
  if (!entry.error.empty()) {
    ++counts.tests;
    ++counts.errors;
    cases += testCase(entry.scenario, "scenario",
                      fmt::format(R"(<error type="error" message="{}"/>)", escaped(entry.error)));
  }
  return cases;
}

/// The time is the suite's, because its checks share their experiments.
std::string when(const RunTime& time) {
  if (time.started.empty()) return "";
  return fmt::format(R"( time="{:.3f}" timestamp="{}")", time.seconds, escaped(time.started));
}

std::string properties(const SuiteEntry& entry) {
  if (entry.properties.empty()) return "";
  std::string out;
  for (const auto& [key, value] : entry.properties)
    out += fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", escaped(key), escaped(value));
  return "    <properties>\n" + out + "    </properties>\n";
}

}  // namespace

std::string junitXml(const std::vector<SuiteEntry>& entries) {
  Counts total;
  std::string suites;
  for (const SuiteEntry& entry : entries) {
    Counts counts;
    const std::string cases = suiteCases(entry, counts);
    suites +=
        fmt::format("  <testsuite name=\"{}\" {} skipped=\"{}\"{}>\n{}{}  </testsuite>\n", escaped(entry.scenario),
                    counts.attributes(), counts.skipped, when(entry.time), properties(entry), cases);
    total += counts;
  }
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"ursula\" {}>\n{}</testsuites>\n",
                     total.attributes(), suites);
}

}  // namespace ursula::report
