"""The verdicts of a suite as a table in Markdown: junit_summary.py verdicts/junit.xml"""

import sys
import xml.etree.ElementTree as ElementTree


def main(path):
    print("| scenario | checks | failed | in error | first that failed |")
    print("| --- | --- | --- | --- | --- |")
    for suite in ElementTree.parse(path).getroot().iter("testsuite"):
        cases = suite.findall("testcase")
        failed = [case.get("name") for case in cases if case.find("failure") is not None]
        errors = [case.get("name") for case in cases if case.find("error") is not None]
        print(f"| {suite.get('name')} | {len(cases)} | {len(failed)} | {len(errors)} | {(failed + errors + ['–'])[0]} |")


if __name__ == "__main__":
    main(sys.argv[1])
