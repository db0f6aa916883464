// Parts of an error's words: the line with a caret, and the nearest name.

#include <gmock/gmock.h>

#include "base/text.h"
#include "base/text_source.h"

namespace ursula {
namespace {

TEST(Excerpt, putsACaretBelowTheColumn) {
  EXPECT_EQ(excerptOf("a = 1\nmass = -350.0\n", 2, 8), "   2 | mass = -350.0\n     |        ^");
  EXPECT_EQ(excerptOf("a = 1\nmass = -350.0", 1, 1), "   1 | a = 1\n     | ^");
}

TEST(Excerpt, countsCharactersAndShowsNoControls) {
  EXPECT_EQ(excerptOf("ä = 1\r\n", 1, 5), "   1 | ä = 1 \n     |     ^");
  EXPECT_EQ(excerptOf("\tb\x1b[2J = 1\n", 1, 2), "   1 |  b [2J = 1\n     |  ^");
}

TEST(Excerpt, ofALongLineShowsWhatIsAroundTheColumn) {
  const std::string text = std::string(500, 'x') + "HERE" + std::string(500, 'y');
  const std::string found = excerptOf(text, 1, 501);
  EXPECT_LT(found.size(), 200u);
  const std::size_t caret = found.rfind('^') - found.find('\n') - 1;
  EXPECT_EQ(found.substr(caret, 4), "HERE");
}

TEST(Excerpt, isEmptyWithoutSuchALineAndEndsWithTheLine) {
  EXPECT_EQ(excerptOf("a = 1\n", 9, 1), "");
  EXPECT_EQ(excerptOf("ab", 1, 99), "   1 | ab\n     |   ^");
}

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
