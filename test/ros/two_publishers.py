#!/usr/bin/python3
"""Two nodes publish what one alone must: move_base names both."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from processes import end, eventually  # noqa: E402

BOTH = "(/create2_stub and /other/create2_stub|/other/create2_stub and /create2_stub)"


class TwoPublishers(unittest.TestCase):
    def setUp(self):
        self.log = tempfile.NamedTemporaryFile()
        self.move_base = subprocess.Popen(["rosrun", "lstm_planner", "standalone_move_base", "__name:=move_base"],
                                          stdin=subprocess.DEVNULL, stdout=self.log, stderr=subprocess.STDOUT)

    def tearDown(self):
        end(self.move_base)

    def said(self, sentence):
        with open(self.log.name, errors="replace") as file:
            return re.search(sentence, file.read()) is not None

    def test_both_are_named(self):
        self.assertTrue(eventually(lambda: self.said("two nodes publish on /odom, %s: " % BOTH)))
        transform = "two nodes publish the transform from base_footprint to odom, %s: " % BOTH
        self.assertTrue(eventually(lambda: self.said(transform)))
        self.assertFalse(self.said("two nodes publish on /scan"))


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "two_publishers", TwoPublishers)
