#pragma once

#include <string>
#include <vector>

namespace ursula {

/// A cause that was put into exact torques, and what the diagnosis made of them.
struct InjectedCause {
  std::string scenario, put_in;
  std::string expected;  ///< stands in the first cause that is named; empty where nothing may be named for sure
  std::string said;      ///< the diagnosis's cause

  /// The expected cause is the first that is named.
  bool isNamedFirst() const;
  /// Named as one of several, or as a part, or not at all: nothing is claimed.
  bool isClaimed() const;
  /// Something else is claimed.
  bool isWrong() const { return isClaimed() && !isNamedFirst(); }
};

/// Each `every`-th of them, on the paper's helix and on the proving ground.
std::vector<InjectedCause> diagnoseInjectedCauses(int every = 1);

/// The table of docs/diagnosis.md, as Markdown.
std::string markdownTable(const std::vector<InjectedCause>& causes);

}  // namespace ursula
