// usage: injected_causes
// Prints the table of docs/diagnosis.md: what was put into exact torques, and what the diagnosis said.

#include <algorithm>
#include <cstdio>

#include "tests/validation/injected_causes.h"

int main() {
  using ursula::InjectedCause;
  const std::vector<InjectedCause> causes = ursula::diagnoseInjectedCauses();
  std::fputs(ursula::markdownTable(causes).c_str(), stdout);
  const auto count = [&](bool (InjectedCause::*is)() const) {
    return std::count_if(causes.begin(), causes.end(), [is](const InjectedCause& one) { return (one.*is)(); });
  };
  std::fprintf(stderr, "%zu causes: %td named first, %td wrongly named with confidence\n", causes.size(),
               count(&InjectedCause::isNamedFirst), count(&InjectedCause::isWrong));
}
