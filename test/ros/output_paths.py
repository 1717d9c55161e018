#!/usr/bin/python3
"""Nodes write their files where ~/ says."""
import os
import signal
import subprocess
import sys
import tempfile
import unittest

import roslib.packages
import rosgraph
import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from processes import end, eventually, package_file  # noqa: E402

MODEL = "_LstmGlobalPlanner/model:=package://lstm_planner/models/create2_lstm.onnx"
GOALS = [{"x": 2.0, "y": 8.25}]


class OutputPaths(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lstm_planner_")
        self.addCleanup(folder.cleanup)
        self.home = folder.name

    def start(self, node, *arguments, stderr=None):
        program = roslib.packages.find_node("lstm_planner", node)[0]
        process = subprocess.Popen([program, *arguments], env=dict(os.environ, HOME=self.home), stderr=stderr, text=True)
        self.addCleanup(end, process)
        return process

    def assert_written(self, name):
        self.assertTrue(os.path.exists(os.path.join(self.home, name)), os.listdir(self.home))

    def test_the_decisions_of_drive_advice(self):
        advice = self.start("drive_advice", "_decisions:=~/decisions.csv", MODEL)
        topics = rosgraph.Master("/output_paths").getSystemState
        self.assertTrue(eventually(lambda: any(name == "/move_base/result" for name, _ in topics()[1])))
        advice.send_signal(signal.SIGINT)
        self.assertEqual(advice.wait(30.0), 0)
        self.assert_written("decisions.csv")

    def test_decisions_that_cannot_be_written_are_refused_before_the_drive(self):
        advice = self.start("drive_advice", "_decisions:=~/missing/decisions.csv", MODEL, stderr=subprocess.PIPE)
        said = advice.communicate(timeout=30.0)[1]
        self.assertEqual(advice.returncode, 1)
        self.assertIn("cannot write '%s/missing/decisions.csv': " % self.home, said)

    def test_the_result_and_the_picture_of_demo_runner(self):
        rosgraph.Master("/output_paths").setParam("/demo_runner/scenario/goals", GOALS)
        self.start("demo_runner", "_map:=" + package_file("config", "demo_building.yaml"), "_patience:=0.1",
                   "_result:=~/result", "_picture:=~/picture.png").wait(30.0)
        self.assert_written("result")
        self.assert_written("picture.png")


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "output_paths", OutputPaths)
