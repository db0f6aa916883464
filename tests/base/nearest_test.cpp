#include "base/text.h"

#include <gmock/gmock.h>

namespace ursula {
namespace {

TEST(Nearest, findsOneFormulaErrorAndSwappedLetters) {
  const std::vector<std::string> keys = {"mass", "length", "center_of_mass", "inertia"};
  EXPECT_EQ(nearest("mas", keys), "mass");
  EXPECT_EQ(nearest("amss", keys), "mass");
  EXPECT_EQ(nearest("lenght", keys), "length");
  EXPECT_EQ(nearest("centre_of_mass", keys), "center_of_mass");
  EXPECT_EQ(nearest("inertia", keys), "inertia");
}

TEST(Nearest, findsNothingFarAway) {
  EXPECT_EQ(nearest("colour", {"mass", "length"}), "");
  EXPECT_EQ(nearest("mass", {}), "");
  EXPECT_EQ(nearest("", {"mass"}), "");
}

TEST(Nearest, addsTheUnitThatIsMissing) {
  EXPECT_EQ(nearest("rpy", {"position", "rpy_deg"}), "rpy_deg");
  EXPECT_EQ(nearest("rpy", {"position", "rpydeg"}), "");
}

TEST(Nearest, prefersTheNearestAndOfEqualsTheFirst) {
  EXPECT_EQ(nearest("end_rat", {"end_gate", "end_rate"}), "end_rate");
  EXPECT_EQ(nearest("phas", {"phase", "phass"}), "phase");
}

TEST(DidYouMean, asksOnlyWhereThereIsAnAnswer) {
  EXPECT_EQ(didYouMean("mas", {"mass"}), ", did you mean 'mass'?");
  EXPECT_EQ(didYouMean("colour", {"mass"}), "");
}

}  // namespace
}  // namespace ursula
