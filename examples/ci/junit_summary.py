"""The verdicts of a suite as a table in Markdown: junit_summary.py verdicts/junit.xml"""

import sys
import xml.etree.ElementTree as ElementTree


def applies(case):
    skipped = case.find("skipped")
    return skipped is None or not skipped.get("message", "").startswith("not applicable")


def main(path):
    print("| scenario | verdict | checks | not passed | the first of them |")
    print("| --- | --- | --- | --- | --- |")
    for suite in ElementTree.parse(path).getroot().iter("testsuite"):
        cases = [case for case in suite.findall("testcase") if applies(case)]
        failed = [case.get("name") for case in cases if case.find("failure") is not None or case.find("error") is not None]
        verdict = next((each.get("value") for each in suite.iter("property") if each.get("name") == "verdict"), "error")
        print(f"| {suite.get('name')} | {verdict} | {len(cases)} | {len(failed)} | {(failed + ['–'])[0]} |")


if __name__ == "__main__":
    main(sys.argv[1])
