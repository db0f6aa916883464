// The audit of the paper's example as a whole, and docs/audit.md against it. One program, one audit.

#include "parts/audit/audit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "report/page/page.h"

namespace ursula {
namespace {

Scenario paperHelix() { return readScenario(URSULA_SCENARIOS "/paper-helix.toml"); }

const Audit& theAudit() {
  static const Audit audit = runAudit(paperHelix());
  return audit;
}

const AuditRow* find(const std::string& equation) {
  for (const AuditRow& row : theAudit().rows)
    if (row.equation == equation) return &row;
  return nullptr;
}

/// Second differences in 50 digits over steps of 3e-5 s have errors of 1e-48/h² = 1e-39 of a unit. The limit is a
/// million times that, for the conditioning of legs and B.
double roundingLimit(const AuditRow& row) { return 1e-33 * std::max(1.0, row.size); }

TEST(Audit, whatHoldsLeavesRoundingOnly) {
  int measured = 0;
  for (const AuditRow& row : theAudit().rows) {
    if (row.kind == AuditRow::Kind::misprint && std::isnan(row.residual_holds)) continue;
    EXPECT_LE(row.residual_holds, roundingLimit(row)) << row.equation;
    ++measured;
  }
  EXPECT_GE(measured, 60);
}

TEST(Audit, whatFailsFailsByFar) {
  int failing = 0;
  for (const AuditRow& row : theAudit().rows) {
    if (row.kind != AuditRow::Kind::fails) continue;
    EXPECT_GT(row.residual_printed, 1e-3 * row.size) << row.equation;
    ++failing;
  }
  EXPECT_GE(failing, 20);
}

TEST(Audit, namesEveryFormulaOnRecord) {
  for (const char* equation :
       {"(2a,b)", "(4c)", "(5)", "(27)", "(14a)", "(14b)", "(15a)", "(15b)", "(16)", "(17a)", "(17b)", "(19a)", "(19b)",
        "(21)", "(23) a", "(26) ȧ", "(26) Ḃ", "(43b)", "text by (47)"}) {
    const AuditRow* row = find(equation);
    ASSERT_NE(row, nullptr) << equation;
    EXPECT_EQ(row->kind, AuditRow::Kind::fails) << equation;
  }
  for (const char* equation : {"(28)", "(34)", "(35)"}) {
    const AuditRow* row = find(equation);
    ASSERT_NE(row, nullptr) << equation;
    EXPECT_EQ(row->kind, AuditRow::Kind::misprint) << equation;
  }
  for (const char* equation :
       {"(1)",  "(3)",   "(4a)", "(4b)", "(6)",    "(7)",  "(8)",  "(9)",   "(11a)", "(12)", "(13)",
        "(18)", "(20a)", "(22)", "(24)", "(26) ẋ", "(37)", "(40)", "(41a)", "(42a)", "(53)"}) {
    const AuditRow* row = find(equation);
    ASSERT_NE(row, nullptr) << equation;
    EXPECT_EQ(row->kind, AuditRow::Kind::holds) << equation;
  }
}

TEST(Audit, saysWhatEachFormulaErrorDoes) {
  const AuditRow* five = find("(5)");
  ASSERT_TRUE(five != nullptr && five->effect);
  EXPECT_NE(five->effect->refused.find("out of reach"), std::string::npos) << five->effect->refused;
  for (const AuditRow& row : theAudit().rows) {
    if (!row.effect || !row.effect->refused.empty()) continue;
    EXPECT_GT(row.effect->torque_error, 1.0) << row.equation;  // N·m, of 25,000
    EXPECT_GT(row.effect->to_1_mm, 0) << row.equation;
    EXPECT_LE(row.effect->to_1_mm, row.effect->to_10_mm) << row.equation;
  }
}

TEST(Audit, theControlStaysOnTheHelix) {
  const AuditRow& none = theAudit().together.back();
  ASSERT_TRUE(none.equation == "none" && none.effect);
  EXPECT_LE(none.effect->torque_error, 1e-6);  // N·m; doubles with 25,000 N·m and κ(B) of some 100
  EXPECT_LT(none.effect->to_1_mm, 0);
  EXPECT_EQ(none.effect->replay_end, theAudit().duration);
}

TEST(Audit, jsonHoldsEveryRow) {
  const nlohmann::json json = nlohmann::json::parse(auditJson(theAudit()));
  EXPECT_EQ(json["formulas"].size(), theAudit().rows.size());
  EXPECT_EQ(json["formulas"][0]["equation"], theAudit().rows.front().equation);
}

TEST(Audit, textFitsTheTerminal) {
  std::istringstream lines(auditText(theAudit()));
  for (std::string line; std::getline(lines, line);) {
    std::size_t columns = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
      const auto byte = static_cast<unsigned char>(line[k]);
      const bool combining = byte == 0xCC || (byte == 0xCD && static_cast<unsigned char>(line[k + 1]) < 0xB0);
      if ((byte & 0xC0) != 0x80 && !combining) ++columns;
    }
    EXPECT_LE(columns, 120U) << line;
  }
}

// --- the page --------------------------------------------------------------------------------------------------------

const std::regex& numeral() {
  static const std::regex pattern(R"([0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?)");
  return pattern;
}

/// One unit of the last printed digit.
double lastDigit(const std::string& number) {
  const std::size_t e = number.find('e'), point = number.find('.');
  const std::string mantissa = number.substr(0, e);
  const int exponent = e == std::string::npos ? 0 : std::stoi(number.substr(e + 1));
  if (point != std::string::npos) return std::pow(10.0, exponent - static_cast<int>(mantissa.size() - point - 1));
  std::size_t zeros = 0;  // written out to three digits
  if (e == std::string::npos && mantissa.size() > 3) zeros = mantissa.size() - 3;
  return std::pow(10.0, exponent + static_cast<int>(zeros));
}

/// The first place where two pages differ by more than one unit of the last printed digit; numbers below 1e-30 are
/// rounding.
std::string firstDifference(const std::string& a, const std::string& b) {
  std::sregex_token_iterator words_a(a.begin(), a.end(), numeral(), -1), words_b(b.begin(), b.end(), numeral(), -1),
      end;
  for (; words_a != end && words_b != end; ++words_a, ++words_b)
    if (*words_a != *words_b) return "'" + words_a->str() + "' against '" + words_b->str() + "'";
  if (words_a != end || words_b != end) return "one is longer";
  std::sregex_iterator numbers_a(a.begin(), a.end(), numeral()), numbers_b(b.begin(), b.end(), numeral()), none;
  for (; numbers_a != none && numbers_b != none; ++numbers_a, ++numbers_b) {
    const std::string text_a = numbers_a->str(), text_b = numbers_b->str();
    const double x = std::stod(text_a), y = std::stod(text_b);
    const bool rounding = x < 1e-30 && y < 1e-30;
    if (!rounding && !(std::abs(x - y) <= 1.001 * lastDigit(text_a)))
      return text_a + " against " + text_b + " after '" + numbers_a->prefix().str().substr(0, 80) + "'";
  }
  return "";
}

TEST(AuditPage, agreesWithAFreshRun) {
  std::ifstream file(URSULA_DOCS "/audit.md");
  std::ostringstream committed;
  committed << file.rdbuf();
  ASSERT_FALSE(committed.str().empty()) << "no docs/audit.md: ./dev docs writes it";
  EXPECT_EQ(firstDifference(committed.str(), auditMarkdown(theAudit())), "") << "./dev docs refreshes the page";
}

TEST(AuditPage, comparisonSeesADigit) {
  EXPECT_EQ(firstDifference("x 1.23 y 4e-40", "x 1.23 y 7e-41"), "");
  EXPECT_EQ(firstDifference("x 1.23", "x 1.24"), "");
  EXPECT_NE(firstDifference("x 1.23", "x 1.25"), "");
  EXPECT_NE(firstDifference("x 12300", "x 12600"), "");
  EXPECT_NE(firstDifference("x 4e-40", "x 4e-20"), "");
  EXPECT_NE(firstDifference("x 1", "z 1"), "");
  EXPECT_NE(firstDifference("x 1", "x 1 and 2"), "");
}

/// The table of LaTeX is written by hand. It must have each formula of the audit, and no other.
TEST(Audit, pageHasMathmlForEachFormulaAndForNoOther) {
  const auto table = nlohmann::json::parse(report::formulas_mathml);
  std::set<std::string> texts;
  for (const AuditRow& row : theAudit().rows)
    for (const std::string& text : {row.printed, row.holds})
      if (!text.empty()) texts.insert(text);
  EXPECT_GE(texts.size(), 100u);
  for (const std::string& text : texts) EXPECT_TRUE(table.contains(text)) << text;
  for (const auto& [text, mathml] : table.items()) {
    EXPECT_EQ(texts.count(text), 1u) << "of no row: " << text;
    EXPECT_EQ(mathml.get<std::string>().rfind("<math ", 0), 0u) << text;
  }
}

TEST(Audit, pageIsSmall) {
  const std::string html = auditHtml(theAudit());
  EXPECT_LT(html.size(), 1'000'000u);
  for (const AuditRow& row : theAudit().rows)
    EXPECT_NE(html.find(">" + row.equation + "<"), std::string::npos) << row.equation;
}

}  // namespace
}  // namespace ursula
