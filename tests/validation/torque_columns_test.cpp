// Torque files of other programs: an unambiguous one is read and reported; another is refused with the option that
// would read it.

#include "validation/subject/torque_columns.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/model/refusals.h"
#include "tests/support/matchers.h"
#include "validation/subject/torque_file.h"

namespace ursula {
namespace {

/// t = 0, 0.5, 1.5; torques 1.25 to 6.25, and the same doubled and tripled.
struct Foreign {
  const char* name;
  std::string text, read_as;
};

const std::string plain_header = "t_s,tau_1_Nm,tau_2_Nm,tau_3_Nm,tau_4_Nm,tau_5_Nm,tau_6_Nm\n";
const std::string plain_rows =
    "0,1.25,2.25,3.25,4.25,5.25,6.25\n0.5,2.5,4.5,6.5,8.5,10.5,12.5\n1.5,3.75,6.75,9.75,12.75,15.75,18.75\n";

std::string with(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

std::string crlf(const std::string& text) {
  std::string out;
  for (char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

/// The text with semicolons and decimal commas: "0;1,25;…".
std::string german(const std::string& text) { return with(with(text, ',', ';'), '.', ','); }

class ForeignTorques : public testing::TestWithParam<Foreign> {};

TEST_P(ForeignTorques, areRead) {
  const TorqueFile file = parseTorqueFile(GetParam().text, "a.csv");
  ASSERT_THAT(file.t, ElementsAre(0, 0.5, 1.5));
  const Vector6d first = (Vector6d() << 1.25, 2.25, 3.25, 4.25, 5.25, 6.25).finished();
  for (int k = 0; k < 3; ++k) EXPECT_EQ(file.torques[static_cast<std::size_t>(k)], (k + 1) * first);
  EXPECT_EQ(file.read_as, GetParam().read_as);
  EXPECT_EQ(file.torque_precision[0](1), 0.005) << "as finely as printed";
}

const std::string tau_names =
    "tau_1_Nm = 'tau1', tau_2_Nm = 'tau2', tau_3_Nm = 'tau3', tau_4_Nm = 'tau4', tau_5_Nm = 'tau5', tau_6_Nm = 'tau6'";

INSTANTIATE_TEST_SUITE_P(
    All, ForeignTorques,
    testing::Values(
        Foreign{"own", plain_header + plain_rows, ""},
        Foreign{"own_crlf", crlf("\xEF\xBB\xBF" + plain_header + plain_rows), ""},
        Foreign{"quoted",
                "\"t_s\",\"tau_1_Nm\",\"tau_2_Nm\",\"tau_3_Nm\",\"tau_4_Nm\",\"tau_5_Nm\",\"tau_6_Nm\"\n" + plain_rows,
                ""},
        Foreign{"semicolons", with(plain_header + plain_rows, ',', ';'), "';' between"},
        Foreign{"decimal_commas", german(plain_header + plain_rows), "';' between, decimal commas"},
        Foreign{"tabs", with(plain_header + plain_rows, ',', '\t'), "tabs between"},
        Foreign{"blanks", with(plain_header + plain_rows, ',', ' '), "blanks between"},
        Foreign{"numpy", "# solver 3\n# " + with(plain_header + plain_rows, ',', ' '),
                "blanks between, lines after # passed over, the header in line 2"},
        Foreign{"matlab", "% solver 3\n% " + with(plain_header + plain_rows, ',', ' '),
                "blanks between, lines after % passed over, the header in line 2"},
        Foreign{"both_signs", "% solver 3\n# " + with(plain_header + plain_rows, ',', ' '),
                "blanks between, lines after # or % passed over, the header in line 2"},
        Foreign{"numpy_commas_in_the_header", "# " + plain_header + with(plain_rows, ',', ' '),
                "blanks between, lines after # passed over"},
        Foreign{"pandas_index",
                "," + plain_header +
                    "0,0,1.25,2.25,3.25,4.25,5.25,6.25\n1,0.5,2.5,4.5,6.5,8.5,10.5,12.5\n"
                    "2,1.5,3.75,6.75,9.75,12.75,15.75,18.75\n",
                ""},
        Foreign{"r_row_names",
                plain_header + "1,0,1.25,2.25,3.25,4.25,5.25,6.25\n2,0.5,2.5,4.5,6.5,8.5,10.5,12.5\n"
                               "3,1.5,3.75,6.75,9.75,12.75,15.75,18.75\n",
                ""},
        Foreign{"names", "time,tau1,tau2,tau3,tau4,tau5,tau6\n" + plain_rows, "t_s = 'time', " + tau_names},
        Foreign{"units", "Time [s],Tau 1 [Nm],Torque_2 (N m),tau[3],tau_4,TAU5,torque-6\n" + plain_rows,
                "t_s = 'Time [s]', tau_1_Nm = 'Tau 1 [Nm]', tau_2_Nm = 'Torque_2 (N m)', tau_3_Nm = 'tau[3]', tau_4_Nm "
                "= 'tau_4', tau_5_Nm = 'TAU5', tau_6_Nm = 'torque-6'"},
        Foreign{"from_zero", "t,tau_0,tau_1,tau_2,tau_3,tau_4,tau_5\n" + plain_rows,
                "t_s = 't', tau_1_Nm = 'tau_0', tau_2_Nm = 'tau_1', tau_3_Nm = 'tau_2', tau_4_Nm = 'tau_3', tau_5_Nm = "
                "'tau_4', tau_6_Nm = 'tau_5'"},
        Foreign{"own_names_from_zero", "t_s,tau_0_Nm,tau_1_Nm,tau_2_Nm,tau_3_Nm,tau_4_Nm,tau_5_Nm\n" + plain_rows,
                "tau_1_Nm = 'tau_0_Nm', tau_2_Nm = 'tau_1_Nm', tau_3_Nm = 'tau_2_Nm', tau_4_Nm = 'tau_3_Nm', tau_5_Nm "
                "= 'tau_4_Nm', tau_6_Nm = 'tau_5_Nm'"},
        Foreign{"milliseconds",
                "time_ms,tau1,tau2,tau3,tau4,tau5,tau6\n0,1.25,2.25,3.25,4.25,5.25,6.25\n"
                "500,2.5,4.5,6.5,8.5,10.5,12.5\n1500,3.75,6.75,9.75,12.75,15.75,18.75\n",
                "t_s = 'time_ms' times 1e-3, " + tau_names}),
    [](const auto& test) { return test.param.name; });

TEST(TorqueColumns, takesUnitsThatANameTells) {
  const TorqueFile file = parseTorqueFile(
      "t,tau1_kNm,tau2_kNm,tau3_kNm,tau4_kNm,tau5 [mNm],tau6 [N mm]\n0,1.25,2,3,4,5,6\n1,1,2,3,4,5,6.5\n", "a.csv");
  EXPECT_EQ(file.torques[0], (Vector6d() << 1250, 2000, 3000, 4000, 0.005, 0.006).finished());
  EXPECT_EQ(file.torque_precision[0](0), 5) << "half a unit of the last digit, in N m";
}

/// A header of "Motor 1 torque (kNm)" and the like; `{}` is the motor.
std::string headerOf(const std::string& form) {
  std::string out = "t_s";
  for (int k = 1; k <= 6; ++k) out += "," + std::string(form).replace(form.find("{}"), 2, std::to_string(k));
  return out + "\n";
}

TEST(TorqueColumns, takesTheMotorsNumberBeforeOrAfterTheWord) {
  const std::pair<const char*, double> forms[] = {{"Motor {} torque (kNm)", 1e3},   {"Motor {} torque", 1},
                                                  {"motor_{}_torque_Nm", 1},        {"Leg {} effort [N.m]", 1},
                                                  {"joint {} torque (N mm)", 1e-3}, {"Motor torque {} (kNm)", 1e3},
                                                  {"actuator_{}_tau (mNm)", 1e-3}};
  for (const auto& [form, unit] : forms)
    EXPECT_NEAR(parseTorqueFile(headerOf(form) + plain_rows, "a.csv").torques[0](1), 2.25 * unit, 1e-12) << form;
  EXPECT_THAT(refusal<CsvError>([&] { parseTorqueFile(headerOf("Motor {} force (kN)") + plain_rows, "a.csv"); }),
              HasSubstr("motor 1 turns and has a torque"));
  EXPECT_THROW(parseTorqueFile(headerOf("Motor {} speed") + plain_rows, "a.csv"), CsvError);
}

TEST(TorqueColumns, offersTheUnitOfTheColumn) {
  const auto said = [](const std::string& form) {
    return refusal<CsvError>([&] { parseTorqueFile(headerOf(form) + plain_rows, "a.csv"); });
  };
  EXPECT_THAT(said("A{} (kN m)"), HasSubstr("--map 'tau_1_kNm=A1 (kN m)'"));
  EXPECT_THAT(said("A{}_mNm"), HasSubstr("--map tau_1_mNm=A1_mNm"));
  EXPECT_THAT(said("A{}"), HasSubstr("--map tau_1_Nm=A1"));
  EXPECT_THAT(said("A{} (kN)"), HasSubstr("--map tau_1_Nm=COLUMN")) << "a force is none of a motor that turns";
  EXPECT_THAT(said("A{} (kg)"), HasSubstr("--map tau_1_Nm=COLUMN")) << "an unknown unit";
}

TEST(TorqueColumns, withoutAHeaderOnlyEqualStepsFromZeroAreTheTime) {
  const auto rows = [](const char* t2) {
    return std::string("0 1 2 3 4 5 6\n0.5 1 3 2 4 5 7\n") + t2 + " 1 2 3 4 5 6\n";
  };
  EXPECT_THAT(parseTorqueFile(rows("1"), "a.csv").read_as,
              StartsWith("blanks between, no header, t_s = '1', tau_1_Nm = '2'"));
  EXPECT_THAT(refusal<CsvError>([&] { parseTorqueFile(rows("1.3"), "a.csv"); }),
              AllOf(HasSubstr("the file has no header, and 7 columns (separated by blanks)"),
                    EndsWith("--map t_s=1 --map tau_1_Nm=2 --map tau_2_Nm=3 --map tau_3_Nm=4 --map tau_4_Nm=5 --map "
                             "tau_5_Nm=6 --map tau_6_Nm=7")));
  // Two columns may be the time.
  EXPECT_THROW(parseTorqueFile("0,0,2,3,4,5,6\n1,1,2,3,4,5,6\n2,2,2,3,4,5,6\n", "a.csv"), CsvError);
}

TEST(TorqueColumns, refusesANumberThatMayBeEither) {
  std::string text = with(plain_header, ',', ';') + "1;1,250;2;3;4;5;6\n";
  EXPECT_EQ(refusal<CsvError>([&] { parseTorqueFile(text, "a.csv"); }),
            "a.csv:2: error: '1,250' may be 1.250 or 1250, expected decimal points");
  EXPECT_EQ(parseTorqueFile(text + "2;0,250;2;3;4;5;6\n", "a.csv").torques[0](0), 1.25);
  text = with(plain_header, ',', ';') + "1;1,250.5;2;3;4;5;6\n";
  EXPECT_THAT(refusal<CsvError>([&] { parseTorqueFile(text, "a.csv"); }), HasSubstr("'1,250.5' in column 'tau_1_Nm'"));
}

TEST(TorqueColumns, refusesUtf16) {
  EXPECT_EQ(refusal<CsvError>([] { parseTorqueFile("\xFF\xFEt", "a.csv"); }),
            "a.csv:1: error: UTF-16, expected UTF-8 or plain text");
}

const std::string uncertain = "zeit;T1;T2;T3;T4;T5;T6\n0;1,25;2;3;4;5;6\n";

TEST(TorqueColumns, refusesWhatIsNotCertainWithTheOptionThatReadsIt) {
  const std::string said = refusal<CsvError>([] { parseTorqueFile(uncertain, "a.csv"); });
  EXPECT_THAT(said, AllOf(StartsWith("a.csv:1: error: missing column 't_s', expected it in the header"),
                          HasSubstr("its columns, separated by ';', are: zeit, T1, T2, T3, T4, T5, T6"),
                          EndsWith("add --map t_s=zeit --map tau_1_Nm=T1 --map tau_2_Nm=T2 --map tau_3_Nm=T3 --map "
                                   "tau_4_Nm=T4 --map tau_5_Nm=T5 --map tau_6_Nm=T6")));
  // The named option does read the file.
  const ColumnMap map = parseColumnMap(
      {"t_s=zeit", "tau_1_Nm=T1", "tau_2_Nm=T2", "tau_3_Nm=T3", "tau_4_Nm=T4", "tau_5_Nm=T5", "tau_6_Nm = T6"});
  EXPECT_EQ(parseTorqueFile(uncertain, "a.csv", map).torques[0], (Vector6d() << 1.25, 2, 3, 4, 5, 6).finished());
}

TEST(TorqueColumns, refusesTwoThatMayBeTheSame) {
  const std::string text = "t,time,tau1,tau2,tau3,tau4,tau5,tau6\n0,0,1,2,3,4,5,6\n";
  EXPECT_EQ(refusal<CsvError>([&] { parseTorqueFile(text, "a.csv"); }),
            "a.csv:1: error: 't' and 'time' may both be t_s, expected one; choose by --map t_s=time");
  EXPECT_EQ(parseTorqueFile(text, "a.csv", parseColumnMap({"t_s=time"})).ignored, std::vector<std::string>{"t"});
}

TEST(TorqueColumns, aMapWinsAndMayHaveAUnit) {
  const TorqueFile file =
      parseTorqueFile("raw," + plain_header + "7," + plain_rows.substr(0, plain_rows.find('\n') + 1), "a.csv",
                      parseColumnMap({"tau_2_kNm=raw"}));
  EXPECT_EQ(file.torques[0](1), 7000);
  EXPECT_EQ(file.torques[0](2), 3.25);
  EXPECT_THAT(file.ignored, ElementsAre("tau_2_Nm"));
}

TEST(TorqueColumns, aWrongMapIsRefused) {
  const auto said = [](const std::vector<std::string>& texts) {
    return refusal<CsvError>([&] { parseTorqueFile(plain_header + plain_rows, "a.csv", parseColumnMap(texts)); });
  };
  EXPECT_EQ(said({"tau_1_Nm"}), "--map tau_1_Nm: expected NAME=COLUMN, as in tau_1_Nm=tau1");
  EXPECT_EQ(said({"tau_7_Nm=x"}),
            "--map tau_7_Nm=x: 'tau_7_Nm' is not a column of a torque file, expected t_s or tau_1_Nm to tau_6_Nm, did "
            "you mean 'tau_1_Nm'?");
  EXPECT_EQ(said({"t_s=a", "t_ms=b"}), "--map t_ms=b: t_ms is mapped twice");
  EXPECT_EQ(said({"t_s=a", "tau_1_Nm=a"}), "--map tau_1_Nm=a: column 'a' is mapped to t_s already");
  EXPECT_THAT(said({"tau_1_Nm=tau_2_Nm"}),
              HasSubstr("--map gives column 'tau_2_Nm' to another name, so 'tau_2_Nm' has none"));
  EXPECT_THAT(said({"t_s=t_S"}), StartsWith("a.csv:1: error: no column 't_S' (--map t_s=t_S), the header has t_s, "));
}

TEST(TorqueColumns, instantsOutsideOfTheMotionSayWhatTheyLookLike) {
  const auto said = [](const std::string& a, const std::string& b, const std::string& c) {
    const std::string rest = ",1,1,1,1,1,1\n";
    return refusal<CsvError>(
        [&] { within(parseTorqueFile(plain_header + a + rest + b + rest + c + rest, "a.csv"), 3); });
  };
  EXPECT_THAT(said("0", "1500", "3000"),
              EndsWith("t_s = 1500 lies outside of the motion, expected 0 to 3 s; they look like milliseconds: the "
                       "last one is 1000 times the motion's duration. If they are, say so: --map t_ms=COLUMN"));
  EXPECT_THAT(said("10", "11", "13"), EndsWith("; they look shifted by 10 s: they last as long as the motion"));
  EXPECT_THAT(said("2", "3", "4"), EndsWith("expected 0 to 3 s"));
}

// --- motors that slide

/// Motors 1 and 2 rotate, the others slide.
Motors mixedMotors() {
  Motors motors;
  for (std::size_t k = 2; k < motors.size(); ++k) motors[k] = {static_cast<int>(k), 2, Coordinate::d};
  return motors;
}

const std::string mixed_header = "t_s,tau_1_Nm,tau_2_Nm,tau_3_N,tau_4_N,tau_5_N,tau_6_N\n";

TEST(SlidingMotors, areReadByTheirOwnUnit) {
  const Vector6d first = (Vector6d() << 1.25, 2.25, 3.25, 4.25, 5.25, 6.25).finished();
  const TorqueFile file = parseTorqueFile(mixed_header + plain_rows, "a.csv", {}, mixedMotors());
  EXPECT_EQ(file.read_as, "");
  EXPECT_EQ(file.torques[0], first);
  const TorqueFile foreign = parseTorqueFile("t,tau1,tau 2 [Nm],tau3,Force 4 [N],F5,tau6_kN\n" + plain_rows, "a.csv",
                                             parseColumnMap({"tau_5_kN=F5"}, mixedMotors()), mixedMotors());
  EXPECT_EQ(foreign.torques[0], (Vector6d() << 1.25, 2.25, 3.25, 4.25, 5250, 6250).finished());
  EXPECT_THAT(foreign.read_as, HasSubstr("tau_4_N = 'Force 4 [N]', tau_5_N = 'F5' times 1e3"));
  const TorqueFile from_zero = parseTorqueFile("t_s,tau_0_Nm,tau_1_Nm,tau_2_N,tau_3_N,tau_4_N,tau_5_N\n" + plain_rows,
                                               "a.csv", {}, mixedMotors());
  EXPECT_EQ(from_zero.torques[0], first);
}

TEST(SlidingMotors, anotherUnitIsRefusedByTheColumnThatIsWanted) {
  const auto refused = [](const std::string& header, const Motors& motors) {
    return refusal<CsvError>([&] { parseTorqueFile(header + plain_rows, "a.csv", {}, motors); });
  };
  EXPECT_EQ(refused(plain_header, mixedMotors()),
            "a.csv:1: error: column 'tau_3_Nm': motor 3 slides and has a force, expected 'tau_3_N' in N");
  EXPECT_EQ(refused(mixed_header, {}),
            "a.csv:1: error: column 'tau_3_N': motor 3 turns and has a torque, expected 'tau_3_Nm' in N·m");
  EXPECT_EQ(refusal<CsvError>([] { parseColumnMap({"tau_3_Nm=x"}, mixedMotors()); }),
            "--map tau_3_Nm=x: motor 3 slides and has a force, expected 'tau_3_N' in N");
  // The unit of an unneeded column does not matter.
  const TorqueFile both = parseTorqueFile(
      "tau_3_Nm," + mixed_header + "9," + plain_rows.substr(0, plain_rows.find('\n')), "a.csv", {}, mixedMotors());
  EXPECT_THAT(both.ignored, ElementsAre("tau_3_Nm"));
}

/// Factors from NIST SP 811, appendix B.8.
TEST(TorqueColumns, takesUnitsOfServosAndPounds) {
  const TorqueFile file = parseTorqueFile(
      "t_s,tau_1_kgfcm,tau_2_ozfin,tau 3 "
      "[lbf·ft],tau_4_lbf_in,tau_5_kgf·m,tau_6_Ncm\n0,1.25,2,3,4,5,6\n1,1,2,3,4,5,6.5\n",
      "a.csv");
  const Vector6d expected =
      (Vector6d() << 1.25 * 9.80665e-2, 2 * 7.061552e-3, 3 * 1.355818, 4 * 0.1129848, 5 * 9.80665, 0.06).finished();
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(file.torques[0](k), expected(k), 1e-6 * expected(k)) << k;
  EXPECT_NEAR(file.torque_precision[0](0), 0.005 * 9.80665e-2, 1e-15) << "half a unit of the last digit, in N m";
  EXPECT_THAT(file.read_as, HasSubstr("tau_1_Nm = 'tau_1_kgfcm' times 0.0980665"));
  const TorqueFile pounds = parseTorqueFile("t,tau_1_Nm,tau_2_Nm,tau_3_lbf,tau_4_kgf,tau_5_ozf,tau_6_mN\n" + plain_rows,
                                            "a.csv", {}, mixedMotors());
  EXPECT_NEAR(pounds.torques[0](2) / pounds.torques[0](3) * 9.80665 / 4.448222, 3.25 / 4.25, 1e-6);
  EXPECT_THAT(
      refusal<CsvError>([] { parseTorqueFile("t_s,tau_1_lbf,tau2,tau3,tau4,tau5,tau6\n" + plain_rows, "a.csv"); }),
      HasSubstr("motor 1 turns and has a torque, expected 'tau_1_Nm' in N·m"));
}

}  // namespace
}  // namespace ursula
