#include "base/text_source.h"

#include <gmock/gmock.h>

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

}  // namespace
}  // namespace ursula
