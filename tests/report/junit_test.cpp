// JUnit files must satisfy the rules of Jenkins' junit-10.xsd, written as assertions.

#include "report/files/written_files.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "report/text/text.h"
#include "tests/report/report_samples.h"
#include "tests/report/text_parts.h"

namespace ursula {
namespace {

using boost::property_tree::ptree;

/// The allowed content of an element; required attributes begin with "!".
struct Rule {
  std::set<std::string> attributes, children;
};

const std::map<std::string, Rule>& rules() {
  static const std::map<std::string, Rule> out = {
      {"testsuites", {{"name", "time", "tests", "failures", "errors"}, {"testsuite"}}},
      {"testsuite",
       {{"!name", "!tests", "!failures", "!errors", "group", "time", "skipped", "timestamp", "hostname", "id",
         "package", "file", "log", "url"},
        {"testsuite", "properties", "testcase", "system-out", "system-err"}}},
      {"properties", {{}, {"property"}}},
      {"property", {{"!name", "!value"}, {}}},
      {"testcase",
       {{"!name", "time", "classname", "group"}, {"skipped", "error", "failure", "system-out", "system-err"}}},
      {"skipped", {{"type", "message"}, {}}},
      {"error", {{"type", "message"}, {}}},
      {"failure", {{"type", "message"}, {}}},
      {"system-out", {{}, {}}},
      {"system-err", {{}, {}}},
  };
  return out;
}

/// Returns the number of checked elements.
std::size_t expectValid(const std::string& name, const ptree& element) {
  const auto rule = rules().find(name);
  if (rule == rules().end()) {
    ADD_FAILURE() << "no element is called " << name;
    return 0;
  }
  static const std::regex stamp("\\d{4}-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\d");
  std::set<std::string> attributes;
  std::size_t count = 1;
  for (const auto& [tag, child] : element) {
    if (tag == "<xmltext>") continue;
    if (tag != "<xmlattr>") {
      EXPECT_EQ(rule->second.children.count(tag), 1u) << tag << " in " << name;
      count += expectValid(tag, child);
      continue;
    }
    for (const auto& [key, value] : child) {
      attributes.insert(key);
      const bool known = rule->second.attributes.count(key) + rule->second.attributes.count("!" + key) == 1;
      EXPECT_TRUE(known) << key << " of " << name;
      const bool is_time = key == "time", is_stamp = key == "timestamp";
      EXPECT_TRUE(!is_time || std::regex_match(value.data(), std::regex("[0-9]+\\.[0-9]{3}"))) << value.data();
      EXPECT_TRUE(!is_stamp || std::regex_match(value.data(), stamp)) << value.data();
    }
  }
  for (const std::string& each : rule->second.attributes)
    EXPECT_TRUE(each[0] != '!' || attributes.count(each.substr(1)) == 1) << name << " without " << each.substr(1);
  return count;
}

/// Expects only characters of XML 1.0: valid UTF-8 without most control characters, U+FFFE and U+FFFF.
void expectCharacters(const std::string& xml) {
  for (const unsigned char c : xml) EXPECT_TRUE(c >= 0x20 || c == '\n' || c == '\t') << int{c};
  for (const char* forbidden : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) EXPECT_EQ(xml.find(forbidden), std::string::npos);
}

TEST(Junit, keepsToTheSchemaWhateverTheVerdictAndTheTexts) {
  const RunTime time = Stopwatch().time();
  const std::string xml = report::junitXml({suiteEntry(test::passedSample(), "a", time),
                                            suiteEntry(test::failedSample(), "b", time),
                                            suiteEntry(test::inconclusiveSample(), "c"),
                                            suiteEntry(test::externalSample(), "d", time),
                                            suiteEntry(test::hostileSample(), "e", time),
                                            {"f", Verdict::fail, "", {}, "\xEF\xBF\xBE\x01 & <", time, "", {}, {}}});
  EXPECT_GT(expectValid("testsuites", parsedXml(xml).get_child("testsuites")), 100u);
  expectCharacters(xml);
}

TEST(Junit, hasTimeTimestampAndProperties) {
  const ptree tree = parsedXml(report::junitXml({suiteEntry(test::passedSample(), "", {1.25, "2026-11-22T05:13:18"})}));
  const ptree& suite = tree.get_child("testsuites.testsuite");
  EXPECT_EQ(suite.get<std::string>("<xmlattr>.time"), "1.250");
  EXPECT_EQ(suite.get<std::string>("<xmlattr>.timestamp"), "2026-11-22T05:13:18");
  std::map<std::string, std::string> properties;
  for (const auto& [tag, property] : suite.get_child("properties"))
    properties[property.get<std::string>("<xmlattr>.name")] = property.get<std::string>("<xmlattr>.value");
  EXPECT_EQ(properties["verdict"], "pass");
  EXPECT_EQ(properties["commit"], "478470f");
}

TEST(Junit, escapesWhatNoXmlMayHold) {
  EXPECT_EQ(report::escaped("a\xEF\xBF\xBE\xEF\xBF\xBF\x0C"
                            "b\xFF"),
            "a\uFFFD\uFFFD\uFFFDbÿ")
      << "a byte that is not UTF-8 is Latin-1";
  EXPECT_EQ(report::escaped("ä\n\t\"'&"), "ä\n\t&quot;&#39;&amp;");
}

TEST(Junit, countsAndShowsEveryKindOfCase) {
  const ptree tree = parsedXml(report::junitXml({suiteEntry(test::passedSample(), "a"),
                                                 suiteEntry(test::failedSample(), "b"),
                                                 suiteEntry(test::inconclusiveSample(), "c"),
                                                 {"d", Verdict::fail, "", {}, "unreadable", {}, "", {}, {}}}));
  const ptree& counts = tree.get_child("testsuites.<xmlattr>");
  EXPECT_EQ(counts.get<int>("tests"), 8 + 9 + 8 + 1);
  EXPECT_EQ(counts.get<int>("failures"), 3);
  EXPECT_EQ(tree.get_child("testsuites").rbegin()->second.get<int>("<xmlattr>.skipped"), 0);
  EXPECT_EQ(counts.get<int>("errors"), 1);
}

TEST(Junit, marksInconclusiveAsSkippedWithItsReason) {
  const ptree tree = parsedXml(report::junitXml({suiteEntry(test::inconclusiveSample(), "")}));
  std::string message;
  for (const auto& [tag, item] : tree.get_child("testsuites.testsuite")) {
    if (tag == "testcase" && item.count("skipped") > 0) message = item.get<std::string>("skipped.<xmlattr>.message");
  }
  EXPECT_EQ(message, "inconclusive: amplification 3.1e14 leaves no digit of a double to judge by");
}

TEST(Junit, neverLooksBetterThanTheVerdict) {
  const ptree none = parsedXml(report::junitXml({{"empty", Verdict::fail, "", {}, "", {}, "", {}, {}}}));
  EXPECT_EQ(none.get<int>("testsuites.<xmlattr>.failures"), 1);
  ValidationResult harder = test::passedSample();
  harder.verdict = Verdict::inconclusive;
  EXPECT_EQ(parsedXml(report::junitXml({suiteEntry(harder, "")})).get<int>("testsuites.testsuite.<xmlattr>.skipped"),
            1);
}

TEST(Junit, isWellFormedWhateverTheTexts) {
  const ptree tree = parsedXml(report::junitXml({suiteEntry(test::hostileSample(), "")}));
  const auto suite = tree.get<std::string>("testsuites.testsuite.<xmlattr>.name");
  EXPECT_EQ(suite, "</script><script>alert('x')</script><!-- & \"quoted\" \xEF\xBF\xBDÿ {{data}} ]]>");
}

}  // namespace
}  // namespace ursula
