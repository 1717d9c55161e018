#!/usr/bin/python3
"""The whole road: somebody drives, that is recorded, a network learns from it, and the planner drives with it elsewhere.

As much data as in the thesis (Table 4.1): 3,000 steps to learn from and 1,000 to be judged by. The driver is scripted.
Most of the steps come from `lstm_planner dataset simulate`, which needs no ROS and a fraction of the time; the node
records the others. The building in which he drives is not the one in which the planner drives afterwards.
"""
import json
import os
import re
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from processes import end, package_file  # noqa: E402

TRAINING_STEPS = 3000
VALIDATION_STEPS = 1000
RECORDED_STEPS = 200  # of all these, by the node
LEAST_ACCURACY = 88.0  # %, on the validation set
LEAST_BALANCED_ACCURACY = 50.0  # %, the mean over the five labels; a network that looks at nothing has 20
GOALS = 3
LEAST_REACHED = 3
# % of the drives that the network ends alone, without boundary following. What the node records differs a little from run to run.
# With 14 other seeds of the driver (dataset simulate --seed) it was 68 % on average, with a standard deviation of 5 %;
# this is almost 5 of them below. One run of this test had 49 %.
LEAST_ALONE = 44.0
MOST_UNTAUGHT = 35.0  # % of the same with a network that only learned which label is the most frequent
RECORDING_PATIENCE = 600.0  # s of the computer's clock; only ends what would last for ever
DRIVING_PATIENCE = 900.0  # s likewise
GOALS_FILE = package_file("test", "ros", "learning_from_people_goals.yaml")
WAYPOINTS = package_file("test", "ros", "learning_from_people_waypoints.yaml")


def tool(*arguments):
    """What the tool prints; it fails the test when it fails."""
    print("lstm_planner", *arguments, flush=True)
    done = subprocess.run(["lstm_planner", *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    print(done.stdout, flush=True)
    if done.returncode != 0:
        raise AssertionError("lstm_planner %s: exit status %d" % (arguments[0], done.returncode))
    return done.stdout


def launch(path, *arguments):
    return subprocess.Popen(["roslaunch", "--wait", path, *arguments], stdin=subprocess.DEVNULL)


def recorded_steps(path):
    if not os.path.exists(path):
        return 0
    try:
        with sqlite3.connect("file:%s?mode=ro" % path, uri=True, timeout=5.0) as dataset:
            return dataset.execute("SELECT count(*) FROM steps").fetchone()[0]
    except sqlite3.OperationalError:  # it is just being made
        return 0


class LearningFromPeople(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lstm_planner_")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def make_building(self):
        tool("maps", "--output", self.path("building"), "--width", "16", "--height", "12", "--seed", "1000011")

    def record(self, steps):
        """recorded.sqlite: at least that many steps, readable while it grows, finished by the service."""
        recording = launch(package_file("test", "ros", "learning_from_people.launch"),
                           "map:=" + self.path("building.yaml"), "output:=" + self.path("recorded.sqlite"),
                           "waypoints:=" + WAYPOINTS)
        try:
            deadline = time.monotonic() + RECORDING_PATIENCE
            while recorded_steps(self.path("recorded.sqlite")) < steps:
                self.assertIsNone(recording.poll(), "the recording ended by itself")
                self.assertLess(time.monotonic(), deadline, "the recording does not get on")
                time.sleep(0.5)
            subprocess.run(["rosservice", "call", "/dataset_recorder/finish"], check=True)
            recording.wait(60.0)
        finally:
            end(recording)
        # The next robot stands elsewhere.
        subprocess.run(["rosparam", "delete", "/create2_stub"], check=True)

    def simulate(self, steps):
        """simulated.sqlite: the same building, driver and recorder, without ROS."""
        tool("dataset", "simulate", "--map", self.path("building.yaml"), "--waypoints", WAYPOINTS, "--steps",
             str(steps), "--arcs", "--wander", "0.03", "--no-scans", "--output", self.path("simulated.sqlite"))

    def merge(self):
        tool("dataset", "merge", "--files", self.path("recorded.sqlite"), self.path("simulated.sqlite"), "--output",
             self.path("drives.sqlite"))
        tool("dataset", "info", self.path("drives.sqlite"))
        tool("dataset", "check", self.path("drives.sqlite"))

    def train(self):
        """The network's accuracy on the validation set, and the mean over the labels, %."""
        share = VALIDATION_STEPS / (TRAINING_STEPS + VALIDATION_STEPS)
        tool("dataset", "split", self.path("drives.sqlite"), "--share", str(share), "--training",
             self.path("training.sqlite"), "--validation", self.path("validation.sqlite"))
        self.assertGreaterEqual(recorded_steps(self.path("training.sqlite")), TRAINING_STEPS)
        self.assertGreaterEqual(recorded_steps(self.path("validation.sqlite")), VALIDATION_STEPS)
        printed = tool("train", "--dataset", self.path("training.sqlite"), "--validation-dataset",
                       self.path("validation.sqlite"), "--inputs", "events", "trace", "motion", "--output",
                       self.path("model.onnx"))
        return map(float, re.search(r"wrote .*: accuracy ([0-9.]+) %, balanced ([0-9.]+) %", printed).groups())

    def share_alone(self, model):
        """How many drives end without boundary following, %, in offices and rooms that nobody drove in."""
        tool("judge", "--model", self.path(model), "--kinds", "offices", "rooms", "--worlds", "40", "--json",
             self.path("judged.json"))
        with open(self.path("judged.json"), encoding="utf-8") as judged:
            drives = json.load(judged)["worlds"]["all"]
        return 100.0 * drives["arrived"] / drives["drives"]

    def train_for_one_epoch(self):
        tool("train", "--dataset", self.path("training.sqlite"), "--inputs", "events", "trace", "motion", "--epochs",
             "1", "--output", self.path("untaught.onnx"))

    def drive(self):
        """What the demo says of its goals, in its own building."""
        driving = launch(package_file("launch", "demo.launch"), "model:=" + self.path("model.onnx"), "leader:=network",
                         "rviz:=false", "real_time_factor:=4", "goals:=" + GOALS_FILE,
                         "picture:=" + self.path("drive.png"), "result:=" + self.path("result"))
        try:
            driving.wait(DRIVING_PATIENCE)
        finally:
            end(driving)
        with open(self.path("result"), encoding="utf-8") as result:
            result.readline()
            return json.load(result)

    def test_a_network_that_learned_from_a_driver_drives_in_another_building(self):
        self.make_building()
        self.record(RECORDED_STEPS)
        self.simulate(int(1.05 * (TRAINING_STEPS + VALIDATION_STEPS)) - RECORDED_STEPS)
        self.merge()
        accuracy, balanced_accuracy = self.train()
        self.assertGreaterEqual(self.share_alone("model.onnx"), LEAST_ALONE)
        self.train_for_one_epoch()
        self.assertLessEqual(self.share_alone("untaught.onnx"), MOST_UNTAUGHT)
        result = self.drive()
        print(json.dumps(result, indent=2))
        print("accuracy %.1f %%, balanced %.1f %%" % (accuracy, balanced_accuracy))
        self.assertGreaterEqual(accuracy, LEAST_ACCURACY)
        self.assertGreaterEqual(balanced_accuracy, LEAST_BALANCED_ACCURACY)
        legs = result["legs"]
        self.assertEqual(len(legs), GOALS)
        self.assertGreaterEqual(sum(leg["reached"] for leg in legs), LEAST_REACHED)
        self.assertEqual(sum(leg["contacts"] for leg in legs), 0)


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "learning_from_people", LearningFromPeople)
