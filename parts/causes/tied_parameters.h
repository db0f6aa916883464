#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/subject/parameters.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Parameters with the same relative error: a single one, or the same one of several links or legs.
struct TiedParameters {
  std::string words;  ///< "mass centre of the distal links"
  std::vector<Parameter> members;
  bool together = false;  ///< whether all move by one amount, which is relative to the first

  /// Disturbs parameters of a right machine.
  void disturb(ManipulatorParameters& machine, double relative) const;
  /// "mass centre of the distal links 0.65 +- 1e-05 m instead of 0.7", or a factor if the members differ.
  std::string text(const ManipulatorParameters& machine, double relative, double deviation) const;
  /// Whether the members are one number, of one leg or several.
  bool isOneNumber() const;
  /// Whether masses, lengths and moments of inertia are positive.
  bool isPossible(const ManipulatorParameters& machine, double relative) const;
  /// The same as `text`, typed. Returns nullopt for an impossible body.
  std::optional<NamedCause> named(const ManipulatorParameters& machine, double relative, double deviation) const;
};

/// The number's body as NamedCause has it: "legs" for a leg's number that belongs to no link.
std::string bodyInCauses(const MachineNumber& number);

/// Those of all legs come first, then both links of all legs, both links of one leg, and each alone. Points of all legs
/// move together. Unequal lengths and mass centres do so too, in a second entry.
std::vector<TiedParameters> tiedParameters(const Manipulator& machine);

}  // namespace ursula
