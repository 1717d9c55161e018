#!/usr/bin/python3
"""Nodes that finish something when they are told to stop can be stopped without a master, too."""
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
from processes import end, eventually, free_port  # noqa: E402

LOST = "Failed to contact master"


class WithoutMaster(unittest.TestCase):
    def setUp(self):
        self.port = free_port()
        self.environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % self.port)
        self.log = tempfile.TemporaryFile(mode="w+")
        self.addCleanup(self.log.close)

    def start(self, *command):
        process = subprocess.Popen(command, stdout=self.log, stderr=self.log, env=self.environment)
        self.addCleanup(end, process, 1.0)
        return process

    def start_recorder(self):
        return self.start(roslib.packages.find_node("lstm_planner", "dataset_recorder")[0])

    def assert_says(self, sentence):
        def said():
            self.log.seek(0)
            return self.log.read()

        self.assertTrue(eventually(lambda: sentence in said()), said())

    def test_one_that_waits_for_a_master_ends_at_a_signal(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.log.seek(0)
            self.log.truncate()
            recorder = self.start_recorder()
            self.assert_says(LOST)
            recorder.send_signal(number)
            self.assertEqual(recorder.wait(10.0), -number)

    def test_one_that_waits_for_a_clock_ends_when_the_master_has_gone(self):
        master_process = self.start("rosmaster", "--core", "-p", str(self.port))
        master = rosgraph.Master("/without_master", self.environment["ROS_MASTER_URI"])
        self.assertTrue(eventually(master.is_online))
        master.setParam("/run_id", "without_master")
        master.setParam("/use_sim_time", True)
        recorder = self.start_recorder()
        self.assert_says("there is no time")
        end(master_process)
        self.assertFalse(eventually(lambda: recorder.poll() is not None, 6.0), "it looks for the clock every 5 s")
        recorder.send_signal(signal.SIGINT)
        self.assertEqual(recorder.wait(10.0), 0)


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "without_master", WithoutMaster)
