#!/usr/bin/python3
"""standalone_move_base refuses numbers out of their range, and warns of parameters that do not exist and of a missing clock."""
import os
import subprocess
import sys
import tempfile
import unittest

import roslaunch.config
import roslib.packages
import rosgraph
import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from processes import end, eventually, free_port, package_file  # noqa: E402

UNKNOWN = "is set, but there is none of that name"


def shipped(robot):
    """What move_base.launch sets, by the name within the node."""
    config = roslaunch.config.load_config_default(
        [(package_file("launch", "includes", "move_base.launch"),
          ["move_base:=standalone", "robot_file:=" + package_file("config", "robots", robot + ".yaml")])],
        None, verbose=False, assign_machines=False)
    return {name[len("/move_base/"):]: parameter.value for name, parameter in config.params.items()}


class StandaloneParameters(unittest.TestCase):
    def setUp(self):
        found = roslib.packages.find_node("lstm_planner", "standalone_move_base")
        if not found:
            self.skipTest("standalone_move_base is not built where there is a navigation stack")
        self.program = found[0]
        self.log = tempfile.TemporaryFile(mode="w+")
        self.addCleanup(self.log.close)

    def start(self, name, parameters):
        master = rosgraph.Master("/standalone_parameters")
        for parameter, value in parameters.items():
            master.setParam("/%s/%s" % (name, parameter), value)
        process = subprocess.Popen([self.program, "__name:=" + name], stdout=self.log, stderr=self.log)
        self.addCleanup(end, process)
        return process

    def said(self):
        self.log.seek(0)
        return self.log.read()

    def test_a_number_out_of_its_range_ends_it_by_name(self):
        process = self.start("wrong", {"planner_frequency": -1.0})
        self.assertEqual(process.wait(30), 1)
        self.assertIn("planner_frequency is -1, expected", self.said())

    def test_a_misspelt_one_is_warned_of_with_the_nearest_name(self):
        self.start("misspelt", {"planer_patience": 8.0})
        sentence = "planer_patience %s; the nearest is planner_patience" % UNKNOWN
        self.assertTrue(eventually(lambda: sentence in self.said(), 30.0), self.said())

    def test_without_a_clock_it_says_why_nothing_happens(self):
        master = rosgraph.Master("/standalone_parameters")
        master.setParam("/use_sim_time", True)
        self.addCleanup(master.deleteParam, "/use_sim_time")
        self.start("timeless", {})
        sentence = "there is no time: /use_sim_time is true, but nobody publishes /clock"
        self.assertTrue(eventually(lambda: sentence in self.said(), 30.0), self.said())

    def test_without_the_time_of_a_simulator_that_is_paused_it_says_so(self):
        master = rosgraph.Master("/paused_simulator")
        master.setParam("/use_sim_time", True)
        self.addCleanup(master.deleteParam, "/use_sim_time")
        nowhere = "http://localhost:%d/" % free_port()
        master.registerPublisher("/clock", "rosgraph_msgs/Clock", nowhere)
        self.addCleanup(master.unregisterPublisher, "/clock", nowhere)
        self.start("paused", {})
        sentence = "there is no time: /use_sim_time is true, but nothing comes on /clock"
        self.assertTrue(eventually(lambda: sentence in self.said(), 30.0), self.said())

    def test_nobody_is_warned_of_what_the_launch_file_sets(self):
        self.start("shipped", shipped("jackal"))
        master = rosgraph.Master("/standalone_parameters")
        serves = lambda: any(name == "/shipped/make_plan" for name, _ in master.getSystemState()[2])
        self.assertTrue(eventually(serves, 30.0), self.said())
        self.assertNotIn(UNKNOWN, self.said())


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "standalone_parameters", StandaloneParameters)
