// Input that is endless, too deep, too long or no text is refused before it is read or parsed, with its place and its
// bound.

#include <sys/stat.h>

#include <fstream>
#include <string>
#include <thread>

#include "base/csv.h"
#include "base/text.h"
#include "base/text_source.h"
#include "base/toml_bounds.h"
#include "base/utf8.h"
#include "model/scenario.h"
#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

std::string repeated(const std::string& piece, std::size_t count) {
  std::string out;
  out.reserve(piece.size() * count);
  for (std::size_t k = 0; k < count; ++k) out += piece;
  return out;
}

std::string said(const std::string& toml) {
  return refusal<ScenarioError>([&] { parseScenario(toml, "a.toml"); });
}

std::string saidOfCsv(const std::string& text) {
  return refusal<CsvError>([&] { parseCsv(text, "a.csv"); });
}

TEST(TomlBounds, refuseWhatIsTooDeep) {
  const std::string bound = ", expected at most 64";
  EXPECT_THAT(said("x = 1\n" + repeated("a.", 100'000) + "b = 1\n"),
              AllOf(StartsWith("a.toml:2:130: error: more than 64 dots in a key"), EndsWith(bound)));
  EXPECT_THAT(said("[" + repeated("a . ", 100'000) + "b]\n"), HasSubstr("dots in a key"));
  EXPECT_THAT(said("a = " + repeated("[", 100'000)), AllOf(HasSubstr("brackets in each other"), EndsWith(bound)));
  EXPECT_THAT(said("a = " + repeated("{a=", 100'000)), HasSubstr("brackets in each other"));
}

TEST(TomlBounds, countLevelsAloneAndNotSigns) {
  const std::string deep = repeated(".", 500) + repeated("[", 500);
  for (const std::string& quiet : {"# " + deep + "\n", "a = \"" + deep + "\\\"" + deep + "\"\n", "a = '" + deep + "'\n",
                                   "a = \"\"\"\n" + deep + "\n\\\"\"\"\"\n", "a = '''\n" + deep + "'\n'''\n"})
    EXPECT_NO_THROW(requireBounded(quiet)) << quiet.substr(0, 20);
  EXPECT_NO_THROW(requireBounded(repeated("[a.b]\nc = [1.5, 2.5, { d.e = 3.5 }]\n", 100)));
  EXPECT_THROW(requireBounded("a = ''\n" + deep), TextRefusal) << "after a string";
  EXPECT_THROW(requireBounded("a = \"\"\"\"\"\"\n" + deep), TextRefusal) << "after a long one";
}

TEST(TomlBounds, refuseWhatIsTooLong) {
  EXPECT_THAT(said(repeated("a=1\n", 200'001)), AllOf(StartsWith("a.toml:200001:2: error: more than 200000 keys")));
  EXPECT_NO_THROW(requireBounded(repeated("a=1\n", 200'000)));
  EXPECT_THAT(said("a = [" + repeated("1,", 2'000'001) + "]"), HasSubstr("more than 2000000 values"));
  EXPECT_THAT(said(std::string(most_toml_bytes + 1, '#')), HasSubstr("bytes, expected at most 33554432"));
}

TEST(TomlBounds, refuseNumbersThatNoDoubleHolds) {
  for (const char* number : {"1e-400", "-1_0e-4_00", "+1.5e400", "1E400"})
    EXPECT_THAT(said("x = 0\na = [0, " + std::string(number) + "]\n"),
                AllOf(StartsWith("a.toml:2:9: error: "), HasSubstr("expected a number that a double can hold")))
        << number;
  EXPECT_THAT(said("a = [ # c\n  1e-400, # 2\n]"), StartsWith("a.toml:2:3: error: ")) << "behind a comment";
  for (const char* fine : {"1e-300", "0e-400", "5e-324", "0xe400", "1979-05-27", "inf", "true"})
    EXPECT_NO_THROW(requireBounded("a = " + std::string(fine))) << fine;
  EXPECT_NO_THROW(requireBounded("1e400 = 1 # =\n1e401 = \"\" # [\n1e402 = [] # ,\na.1e400 = 2\n")) << "keys";
}

TEST(TextSource, endsWhereItsBoundIs) {
  const TemporaryFolder folder;
  const auto reads = [](const std::filesystem::path& file, std::size_t most) {
    return refusal<TextRefusal>([&] { readText(file, {most, "a list"}); });
  };
  const std::filesystem::path file = folder.write("a.txt", "12345\n");
  EXPECT_EQ(readText(file, {6, "a list"}), "12345\n");
  EXPECT_EQ(reads(file, 5), "more than 5 bytes, expected at most 5 of a list");
  EXPECT_EQ(reads("/dev/zero", 1 << 30), "a zero byte, expected text");
  EXPECT_EQ(reads("/dev/urandom", 1 << 30).substr(0, 11), "a zero byte");
  EXPECT_EQ(reads(folder.path(), 5), "a folder, expected a list");
  EXPECT_EQ(reads(std::string("a\0b", 3), 5), "a path with a zero byte, expected one without");
}

TEST(TextSource, isAPipeWithAWriter) {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder.path() / "a.pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal<TextRefusal>([&] {
              readText(pipe, {9, "a list"});
            }),
            "a pipe that nobody writes to, expected a list");
  std::thread writer([&] { std::ofstream(pipe) << "12345\n"; });
  EXPECT_EQ(readText(pipe, {9, "a list"}), "12345\n");
  writer.join();
}

TEST(TextSource, isReadNoFurtherByWhoeverReads) {
  EXPECT_THAT(refusal<ScenarioError>([] { readScenario("/dev/zero"); }),
              "/dev/zero:1:1: error: a zero byte, expected text");
  EXPECT_THAT(refusal<CsvError>([] { readCsv("/dev/zero"); }), "/dev/zero:1: error: a zero byte, expected text");
}

TEST(CsvBounds, areSaid) {
  const std::string many = "x" + repeated(",x", most_csv_columns);
  EXPECT_THAT(saidOfCsv(many + "\n"), "a.csv:1: error: more than 20000 columns, expected at most 20000");
  EXPECT_THAT(saidOfCsv("x,y\n1," + std::string(2000, '1') + "\n"),
              AllOf(StartsWith("a.csv:2: error: a cell of 2000 bytes, '111"), EndsWith("', expected at most 1024"),
                    testing::SizeIs(testing::Lt(200))));
  EXPECT_THAT(saidOfCsv(std::string(2000, 'x') + "\n1\n"), HasSubstr("a cell of 2000 bytes"));
}

TEST(CsvBounds, namesLineColumnAndNoMoreThanTheCell) {
  EXPECT_EQ(saidOfCsv("x,y\n1,2\n3, \x1b[31mred\n"),
            "a.csv:3: error: '\\x1b[31mred' in column 'y', expected a finite number");
  EXPECT_THAT(saidOfCsv("x\n" + std::string(500, 'a') + "\n"),
              AllOf(HasSubstr("aaa …' in column"), Not(HasSubstr(std::string(90, 'a')))));
  EXPECT_THAT(saidOfCsv("x\n1e-400\n"), HasSubstr("'1e-400' in column 'x', expected a number that a double can hold"));
}

TEST(Utf8, takesOtherBytesForLatin1) {
  EXPECT_EQ(utf8("plain ψ 字 😀"), "plain ψ 字 😀");
  EXPECT_EQ(utf8("\xb5m, 20 \xb0"), "µm, 20 °");
  EXPECT_EQ(utf8("ψ\xe4"), "ψä");
  EXPECT_EQ(utf8("\xe2\x82"), "\xc3\xa2\xc2\x82") << "half a character";
  EXPECT_EQ(utf8(""), "");
}

TEST(ShownText, holdsNothingThatATerminalObeys) {
  EXPECT_EQ(shown("plain ψ 字 😀"), "plain ψ 字 😀");
  EXPECT_EQ(shown("\x1b]0;x\x07\r\n\x7f"), "\\x1b]0;x\\x07\\x0d\\x0a\\x7f");
  EXPECT_EQ(shown("a\u202e\u2028\u2066\u200f\u2027"),
            "a\\xe2\\x80\\xae\\xe2\\x80\\xa8\\xe2\\x81\\xa6\\xe2\\x80\\x8f\u2027");
  EXPECT_EQ(shown("\xc2\x9b"), "\\xc2\\x9b") << "a control of ISO 6429";
  EXPECT_EQ(shown("\xed\xa0\x80|\xff|\xc0\xaf|\xe2\x82"), "\\xed\\xa0\\x80|\\xff|\\xc0\\xaf|\\xe2\\x82");
  EXPECT_EQ(shown("ψψψ", 3), "ψ …") << "no half of a character";
  EXPECT_EQ(withoutControls("a\n\tb\r"), "a\n\tb\\x0d");
}

TEST(Nearest, passesOverWhatIsLong) {
  const std::string of_most(100, 'x');
  EXPECT_EQ(nearest(of_most.substr(1), {of_most}), of_most);
  EXPECT_EQ(nearest(of_most, {of_most + "x"}), "") << "one sign off, but long";
  EXPECT_EQ(nearest("mas", {std::string(5000, 'x'), "mass"}), "mass");
}

}  // namespace
}  // namespace ursula
