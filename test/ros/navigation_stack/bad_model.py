#!/usr/bin/python3
"""move_base with a planner whose model cannot be read: it lives on, says what is wrong and works with another planner."""
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from move_base_robot import NAVFN, Robot  # noqa: E402

START = (1.5, 2.5, 1.5708)
NEAR = (1.6, 4.0)


class BadModel(unittest.TestCase):
    def test_move_base_lives_on_reports_and_works_with_another_planner(self):
        robot = Robot(START)
        robot.send(NEAR)
        self.assertEqual(robot.finish(), GoalStatus.ABORTED)
        self.assertEqual(robot.judge.path, 0.0)
        self.assertTrue([line for line in robot.log if "no plan: the planner cannot be used: " in line])
        robot.choose_planner(NAVFN)
        robot.send(NEAR)
        self.assertEqual(robot.finish(), GoalStatus.SUCCEEDED)


if __name__ == "__main__":
    rospy.init_node("bad_model")
    rostest.rosrun("lstm_planner", "bad_model", BadModel)
