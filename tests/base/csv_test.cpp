#include "base/csv.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

TEST(Csv, readsNamesColumnsAndLines) {
  const CsvTable table = parseCsv("t_s,tau_1_Nm\n0,1.5\n0.5,-2e3\n", "torques.csv");
  EXPECT_THAT(table.names, ElementsAre("t_s", "tau_1_Nm"));
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(0, 0.5), ElementsAre(1.5, -2000)));
  EXPECT_THAT(table.lines, ElementsAre(2, 3));
  EXPECT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.place(1), "torques.csv:3");
  ASSERT_NE(table.find("tau_1_Nm"), nullptr);
  EXPECT_THAT(*table.find("tau_1_Nm"), ElementsAre(1.5, -2000));
  EXPECT_EQ(table.find("tau_2_Nm"), nullptr);
  EXPECT_THAT(table.at("t_s"), ElementsAre(0, 0.5));
}

TEST(Csv, toleratesByteOrderMarkCarriageReturnsBlanksAndAMissingLastLineEnd) {
  const CsvTable table = parseCsv("\xEF\xBB\xBFt_s , x\r\n 0 ,\t+1\r\n1,2", "a.csv");
  EXPECT_THAT(table.names, ElementsAre("t_s", "x"));
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(0, 1), ElementsAre(1, 2)));
  EXPECT_THAT(parseCsv("x\n1\n\n \r\n", "a.csv").columns, ElementsAre(ElementsAre(1)));
}

struct CsvRefusal {
  const char* name;
  const char* text;
  const char* message;
};

class RefusedCsv : public testing::TestWithParam<CsvRefusal> {};

TEST_P(RefusedCsv, namesLineAndExpectation) {
  EXPECT_EQ(refusal<CsvError>([] { parseCsv(GetParam().text, "a.csv"); }), std::string("a.csv:") + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, RefusedCsv,
    testing::Values(
        CsvRefusal{"empty", "", "1: error: an empty file, expected a header line and rows of numbers"},
        CsvRefusal{"blank", "\xEF\xBB\xBF \r\n\n",
                   "1: error: an empty file, expected a header line and rows of numbers"},
        CsvRefusal{"header_only", "x,y\n", "1: error: no rows, expected at least one below the header"},
        CsvRefusal{"unnamed", "x,,y\n", "1: error: a column without a name, expected quantity_index_unit in each"},
        CsvRefusal{"duplicate", "x,y,x\n1,2,3\n", "1: error: duplicate column 'x', expected each name once"},
        CsvRefusal{"missing", "x,y\n1,2\n3\n", "3: error: 1 cell, expected 2, one for each column of the header"},
        CsvRefusal{"surplus", "x,y\n1,2,3\n", "2: error: 3 cells, expected 2, one for each column of the header"},
        CsvRefusal{"decimal_commas", "x,y,z\n0,1,2,5,3,5\n",
                   "2: error: 6 cells, expected 3, one for each column of the header; with decimal commas, separate "
                   "the values by ';'"},
        CsvRefusal{"comma_at_end", "x,y\n1,2,\n", "2: error: 3 cells, expected 2, one for each column of the header"},
        CsvRefusal{"gap", "x,y\n1,2\n\n3,4\n", "3: error: 1 cell, expected 2, one for each column of the header"},
        CsvRefusal{"cell", "x,y\n1,\n", "2: error: an empty cell in column 'y', expected a finite number"},
        CsvRefusal{"word", "x,y\n1,2\n3,abc\n", "3: error: 'abc' in column 'y', expected a finite number"},
        CsvRefusal{"tail", "x\n1.5m\n", "2: error: '1.5m' in column 'x', expected a finite number"},
        CsvRefusal{"nan", "x\nnan\n", "2: error: 'nan' in column 'x', expected a finite number"},
        CsvRefusal{"inf", "x\n-inf\n", "2: error: '-inf' in column 'x', expected a finite number"},
        CsvRefusal{"huge", "x\n1e999\n",
                   "2: error: '1e999' in column 'x', expected a number that a double can hold, from 5e-324 to 1.8e308 "
                   "in size"},
        CsvRefusal{"signs", "x\n+-1\n", "2: error: '+-1' in column 'x', expected a finite number"}),
    [](const auto& row) { return row.param.name; });

TEST(Csv, namesAMissingColumnAndTheNearest) {
  const CsvTable table = parseCsv("t_s,tau_1_Nm\n0,1\n", "a.csv");
  EXPECT_EQ(refusal<CsvError>([&] { table.at("tau_1_nm"); }),
            "a.csv:1: error: missing column 'tau_1_nm', expected it in the header, did you mean 'tau_1_Nm'?");
}

TEST(Csv, suggestsNoColumnThatHasAnotherIndex) {
  const CsvTable table = parseCsv("t_s,p_x_m,q_w\n0,1,1\n", "a.csv");
  EXPECT_EQ(refusal<CsvError>([&] { table.at("p_y_m"); }),
            "a.csv:1: error: missing column 'p_y_m', expected it in the header");
  EXPECT_EQ(refusal<CsvError>([&] { table.at("q_x"); }),
            "a.csv:1: error: missing column 'q_x', expected it in the header");
}

TEST(Csv, readsOnlyWhatIsWanted) {
  const auto wanted = [](const std::string& name) { return name != "note"; };
  const CsvTable table = parseCsv("note,t_s,x\nfirst,0,1\n,1,2\n", "a.csv", {wanted, true});
  EXPECT_THAT(table.names, ElementsAre("t_s", "x"));
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(0, 1), ElementsAre(1, 2)));
  EXPECT_THAT(table.ignored, ElementsAre("note"));
  EXPECT_EQ(refusal<CsvError>([&] {
              parseCsv("note,t_s\n1,2,3\n", "a.csv", {wanted, true});
            }),
            "a.csv:2: error: 3 cells, expected 2, one for each column of the header");
  EXPECT_EQ(refusal<CsvError>([&] {
              parseCsv("note,note\n1,2\n", "a.csv", {wanted, true});
            }),
            "a.csv:1: error: duplicate column 'note', expected each name once");
  // Control: without the option the note is refused.
  EXPECT_THAT(refusal<CsvError>([&] { parseCsv("note,t_s\nfirst,0\n", "a.csv"); }),
              StartsWith("a.csv:2: error: 'first'"));
}

TEST(Csv, takesNumbersThatAreNotFiniteOnlyWhereTold) {
  const CsvTable table = parseCsv("x\nnan\n-inf\n", "a.csv", {{}, false});
  EXPECT_TRUE(std::isnan(table.columns[0][0]));
  EXPECT_EQ(table.columns[0][1], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(refusal<CsvError>([] {
              parseCsv("x\none\n", "a.csv", {{}, false});
            }),
            "a.csv:2: error: 'one' in column 'x', expected a number");
}

TEST(Csv, knowsTheLastDigitPrinted) {
  const CsvTable table = parseCsv("x\n1.50\n15e2\n-0.015E-3\n100\n+2.\n1e+06\n", "a.csv");
  EXPECT_THAT(table.last_places, ElementsAre(ElementsAre(-2, 2, -6, 0, 0, 6)));
}

TEST(Csv, refusesAFileThatIsNotThereAndAFolder) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal<CsvError>([&] { readCsv(folder.path() / "none.csv"); }),
              EndsWith("none.csv: error: no such file, expected a CSV file"));
  folder.write("mine.csv", "x\n1\n");
  EXPECT_THAT(refusal<CsvError>([&] { readCsv(folder.path() / "mine.cvs"); }),
              EndsWith("no such file, expected a CSV file, did you mean 'mine.csv'?"));
  EXPECT_THAT(refusal<CsvError>([&] { readCsv(folder.path()); }), EndsWith(": error: a folder, expected a CSV file"));
}

TEST(Csv, writtenAndReadAgainGivesTheSameDoubles) {
  const TemporaryFolder folder;
  using Limits = std::numeric_limits<double>;
  const std::vector<double> hard = {0.1, 1.0 / 3, -0.0, Limits::max(), Limits::min(), -1e-5, 123456789012345678.0};
  const std::string text = csvText({"t_s", "x"}, {{0, 1, 2, 3, 4, 5, 6}, hard});
  EXPECT_THAT(text, StartsWith("t_s,x\n0,0.1\n1,0.3333333333333333\n2,-0\n"));
  const CsvTable table = readCsv(folder.write("a.csv", text));
  EXPECT_THAT(table.at("x"), testing::ElementsAreArray(hard));
}

/// Each piece of a long table is a small part of it, and every row appears once.
TEST(Csv, isWrittenInPieces) {
  constexpr std::size_t rows = 200'000;
  std::vector<double> column(rows);
  for (std::size_t k = 0; k < rows; ++k) column[k] = static_cast<double>(k);
  std::string whole;
  std::size_t longest = 0;
  csvPieces({"x", "y"}, {column, column}, NanAs::word, [&](const std::string& piece) {
    whole += piece;
    longest = std::max(longest, piece.size());
  });
  EXPECT_LT(longest, whole.size() / 4);
  const CsvTable table = parseCsv(whole, "pieces");
  EXPECT_EQ(table.at("x"), column);
  EXPECT_EQ(table.at("y"), column);
}

TEST(Csv, writerRefusesUnevenColumns) {
  EXPECT_THROW(csvText({"x", "y"}, {{1, 2}, {3}}), std::invalid_argument);
  EXPECT_THROW(csvText({"x", "y"}, {{1, 2}}), std::invalid_argument);
  EXPECT_THROW(csvText({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace ursula
