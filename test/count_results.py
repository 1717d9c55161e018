#!/usr/bin/env python3
"""Sums up the result files of gtest, rosunit and rostest, and the exit statuses of test programs, in a folder.

count_results.py FOLDER SKIPS: prints a line for every case that failed or was skipped, and at the end, alone on its
line, `N passed, N failed, N skipped`. A case that is skipped for a reason that no line of the file SKIPS allows has
failed, and so has a program (NAME.status) that crashed. Exit status 1 when a case failed, 2 when there are no results.
"""
import pathlib
import re
import sys
import xml.etree.ElementTree

LONGEST_TEXT = 300  # characters of a failure's text; ctest has printed all of it


class Results:
    def __init__(self):
        self.passed = 0
        self.failed = []
        self.skipped = []

    def add_file(self, path):
        """Counts a file's cases; returns how many of them failed."""
        failed_before = len(self.failed)
        try:
            root = xml.etree.ElementTree.parse(path).getroot()
        except xml.etree.ElementTree.ParseError as error:
            self.failed.append((path.name, f"unreadable result file: {error}"))
            return 1
        for case in root.iter("testcase"):
            self.add_case(case)
        return len(self.failed) - failed_before

    def add_case(self, case):
        if case.get("status") == "notrun":
            return
        name = f"{case.get('classname')}.{case.get('name')}"
        problem = case.find("failure")
        if problem is None:
            problem = case.find("error")
        if problem is not None:
            self.failed.append((name, text_of(problem)))
        elif case.find("skipped") is not None or case.get("result") == "skipped":
            self.skipped.append((name, text_of(case.find("skipped"))))
        else:
            self.passed += 1


def text_of(element):
    """The message of a result, without the line of source that gtest puts before it."""
    if element is None:
        return ""
    text = element.get("message") or element.text or ""
    lines = [line.strip() for line in text.strip().splitlines() if line.strip()]
    if len(lines) > 1 and lines[0].rpartition(":")[2].isdigit():
        lines = lines[1:]
    return " ".join(lines)[:LONGEST_TEXT]


def add_folder(results, folder):
    # A rostest's cases are in rosunit-NAME.xml, one file a test node; rostest-*.xml has one case "testNAME" a test
    # node, which tells more only when the node left no failure of its own (it crashed after its last case, say).
    told = set()
    for path in sorted(folder.glob("rosunit-*.xml")):
        if results.add_file(path):
            told.add("test" + path.stem[len("rosunit-"):])
    for path in sorted(folder.glob("rostest-*.xml")):
        launches = Results()
        launches.add_file(path)
        results.failed.extend(
            (f"{path.stem}: {name}", text) for name, text in launches.failed if name.rpartition(".")[2] not in told)
    failing = {path.stem[len("gtest-"):] for path in sorted(folder.glob("gtest-*.xml")) if results.add_file(path)}
    for path in sorted(folder.glob("*.status")):
        status = int(path.read_text(encoding="utf-8"))
        if status != 0 and path.stem not in failing:
            results.failed.append((path.stem, f"ended with exit status {status} and no failed case"))


def read_allowed_skips(path):
    """Regular expressions, one a line; lines that begin with # are comments."""
    lines = [line.strip() for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines()]
    return [re.compile(line) for line in lines if line and not line.startswith("#")]


def main(folder, skips):
    results = Results()
    add_folder(results, pathlib.Path(folder))
    allowed = read_allowed_skips(skips)
    for name, text in list(results.skipped):
        if not any(reason.search(text) for reason in allowed):
            results.skipped.remove((name, text))
            results.failed.append((name, f"skipped, and test/skips.txt does not allow it: {text}"))
    for name, text in results.skipped:
        print(f"SKIPPED {name}: {text}")
    for name, text in results.failed:
        print(f"FAILED {name}: {text}")
    print(f"{results.passed} passed, {len(results.failed)} failed, {len(results.skipped)} skipped")
    if results.failed:
        return 1
    return 0 if results.passed or results.skipped else 2


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
