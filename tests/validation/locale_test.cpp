// A program that calls the library may have set a locale with decimal commas, for C or for C++.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <locale>

#include "base/text.h"
#include "model/scenario.h"
#include "nocsolver/errors.h"
#include "report/files/report.h"
#include "tests/base/temporary_folder.h"
#include "tests/model/quick_scenario.h"
#include "validation/validate.h"

namespace ursula {
namespace {

class DecimalComma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Changes the process's locales while it exists.
class Commas {
 public:
  Commas() : before_(std::locale::global(std::locale(std::locale::classic(), new DecimalComma))) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"})
      in_c_ = in_c_ || std::setlocale(LC_NUMERIC, name) != nullptr;
  }
  ~Commas() {
    std::setlocale(LC_NUMERIC, "C");
    std::locale::global(before_);
  }
  bool inC() const { return in_c_; }

 private:
  std::locale before_;
  bool in_c_ = false;
};

std::string everythingWritten(const std::filesystem::path& folder) {
  const ValidationResult result = validate(parseScenario(quickScenario(), "a.toml"));
  writeResults(result, folder);
  std::string all;
  for (const char* file : {"summary.json", "timeseries.csv", "report.html"})
    all += TemporaryFolder::read(folder / file);
  return all;
}

TEST(Locale, ofTheCallerChangesNoByte) {
  const TemporaryFolder folder;
  const std::string plain = everythingWritten(folder.path() / "plain");
  ASSERT_GT(plain.size(), 1e5);
  const Commas commas;
  std::ostringstream seen;
  seen << 1234.5;
  ASSERT_EQ(seen.str(), "1.234,5") << "or nothing would be seen";
  if (!commas.inC()) std::cout << "no locale of C with decimal commas is installed: those of C++ alone are tried\n";
  EXPECT_TRUE(everythingWritten(folder.path() / "commas") == plain);
}

TEST(Locale, changesNoMessage) {
  const std::string plain = PoseError("cannot reach", 0, 1.5, 1234.5, 0.25, " m").what();
  EXPECT_THAT(plain, testing::HasSubstr("1234.5 m, bound 0.25 m"));
  const Commas commas;
  EXPECT_EQ(plain, PoseError("cannot reach", 0, 1.5, 1234.5, 0.25, " m").what());
}

TEST(LeadingNumber, isReadAsFarAsItGoes) {
  const Commas commas;
  for (const auto& [text, value, length] : {std::tuple{"1.5,2", 1.5, 3}, {"+2e3x", 2000.0, 4}, {"-.5", -0.5, 3}}) {
    EXPECT_EQ(leadingNumber(text).value, value) << text;
    EXPECT_EQ(leadingNumber(text).length, length) << text;
  }
  for (const char* none : {"", "+", "+-1", " 1", "x", "1e999", "1e-400"})
    EXPECT_EQ(leadingNumber(none).length, 0U) << none;
}

}  // namespace
}  // namespace ursula
