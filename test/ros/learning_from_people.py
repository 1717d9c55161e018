#!/usr/bin/python3
"""The whole road: somebody drives, that is recorded, a network learns from it, and the planner drives with it elsewhere.

As much data as in the thesis (Table 4.1): 3,000 steps to learn from and 1,000 to be judged by. The driver is scripted;
the building in which he drives is not the one in which the planner drives afterwards.
"""
import json
import os
import re
import signal
import sqlite3
import subprocess
import tempfile
import time
import unittest

import rospkg
import rostest

TRAINING_STEPS = 3000
VALIDATION_STEPS = 1000
LEAST_ACCURACY = 88.0  # %, on the validation set
GOALS = 5
LEAST_REACHED = 4
LONGEST_PATH = 2.5  # times the shortest; the rescue alone, with a network that only drives straight on, needs 3
LEAST_ALONE = 50.0  # % of the drives that the network ends alone, without the rescue
MOST_UNTAUGHT = 35.0  # % of the same with a network that only learned which label is the most frequent
RECORDING_PATIENCE = 600.0  # s of the computer's clock; only ends what would last for ever
DRIVING_PATIENCE = 900.0  # s likewise


def package_file(*path):
    return os.path.join(rospkg.RosPack().get_path("lstm_planner"), *path)


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


def end(process):
    """Ctrl-C, and whatever it takes if that is not heard."""
    for number, patience in ((signal.SIGINT, 30.0), (signal.SIGKILL, 30.0)):
        if process.poll() is None:
            process.send_signal(number)
            try:
                process.wait(patience)
            except subprocess.TimeoutExpired:
                pass


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

    def record(self, steps):
        """A dataset of at least that many steps, readable while it grows, finished by the service."""
        tool("maps", "--output", self.path("building"), "--width", "16", "--height", "12", "--seed", "1000011")
        recording = launch(package_file("test", "ros", "learning_from_people.launch"),
                           "map:=" + self.path("building.yaml"), "output:=" + self.path("drives.sqlite"),
                           "way_points:=" + package_file("test", "ros", "learning_from_people_way_points.yaml"))
        try:
            deadline = time.monotonic() + RECORDING_PATIENCE
            while recorded_steps(self.path("drives.sqlite")) < steps:
                self.assertIsNone(recording.poll(), "the recording ended by itself")
                self.assertLess(time.monotonic(), deadline, "the recording does not get on")
                time.sleep(0.5)
            subprocess.run(["rosservice", "call", "/dataset_recorder/finish"], check=True)
            recording.wait(60.0)
        finally:
            end(recording)
        # The next robot stands elsewhere.
        subprocess.run(["rosparam", "delete", "/create2_stub"], check=True)
        tool("dataset", "info", self.path("drives.sqlite"))
        tool("dataset", "check", self.path("drives.sqlite"))

    def train(self):
        """Accuracies on the validation set, %: the network's, and that of always giving the most frequent answer."""
        share = VALIDATION_STEPS / (TRAINING_STEPS + VALIDATION_STEPS)
        tool("dataset", "split", self.path("drives.sqlite"), "--share", str(share), "--training",
             self.path("training.sqlite"), "--validation", self.path("validation.sqlite"))
        self.assertGreaterEqual(recorded_steps(self.path("training.sqlite")), TRAINING_STEPS)
        self.assertGreaterEqual(recorded_steps(self.path("validation.sqlite")), VALIDATION_STEPS)
        printed = tool("train", "--dataset", self.path("training.sqlite"), "--validation-dataset",
                       self.path("validation.sqlite"), "--inputs", "events", "trace", "motion", "--output",
                       self.path("model.onnx"))
        return [float(re.search(pattern + r" accuracy ([0-9.]+) %", printed).group(1))
                for pattern in (r"wrote .*:", r"always the most frequent label:")]

    def share_alone(self, model):
        """How many drives end without the rescue, %, in offices and rooms that nobody drove in."""
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
                         "rviz:=false", "goals:=" + package_file("test", "ros", "learning_from_people_goals.yaml"),
                         "picture:=" + self.path("drive.png"), "result:=" + self.path("result"))
        try:
            driving.wait(DRIVING_PATIENCE)
        finally:
            end(driving)
        with open(self.path("result"), encoding="utf-8") as result:
            result.readline()
            return json.load(result)

    def test_a_network_that_learned_from_a_driver_drives_in_another_building(self):
        self.record(int(1.05 * (TRAINING_STEPS + VALIDATION_STEPS)))
        accuracy, constant_accuracy = self.train()
        self.assertGreaterEqual(self.share_alone("model.onnx"), LEAST_ALONE)
        self.train_for_one_epoch()
        self.assertLessEqual(self.share_alone("untaught.onnx"), MOST_UNTAUGHT)
        result = self.drive()
        print(json.dumps(result, indent=2))
        print("accuracy %.1f %%, of always the same answer %.1f %%" % (accuracy, constant_accuracy))
        self.assertGreaterEqual(accuracy, LEAST_ACCURACY)
        self.assertGreater(accuracy, constant_accuracy)
        legs = result["legs"]
        self.assertEqual(len(legs), GOALS)
        self.assertGreaterEqual(sum(leg["reached"] for leg in legs), LEAST_REACHED)
        self.assertEqual(sum(leg["contacts"] for leg in legs), 0)
        self.assertLess(sum(leg["path_m"] for leg in legs), LONGEST_PATH * sum(leg["shortest_m"] for leg in legs))


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "learning_from_people", LearningFromPeople)
