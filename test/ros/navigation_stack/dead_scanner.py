#!/usr/bin/python3
"""A goal ends when the scanner is dead, with both plugins and the costmaps of this package, in the demo's building."""
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from move_base_robot import Robot  # noqa: E402

START = (1.5, 2.5, 1.5708)
GOAL = (1.6, 4.4)
REACH = 0.3  # m, position_tolerance of the controller and the error of the odometry


class DeadScanner(unittest.TestCase):
    robot = None

    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(START)

    def tearDown(self):
        self.robot.client.cancel_goal()
        self.robot.pause_scan(False)

    def test_a_goal_is_given_up_whether_the_scanner_dies_before_or_during_the_drive(self):
        robot = self.robot
        robot.pause_scan(True)
        robot.pass_time(1.0)
        robot.send(GOAL)
        self.assertEqual(robot.finish(), GoalStatus.ABORTED)
        robot.pause_scan(False)
        robot.send(GOAL)
        robot.wait("the robot to drive", lambda: robot.command.linear.x > 0.1)
        robot.pause_scan(True)
        self.assertEqual(robot.finish(), GoalStatus.ABORTED)
        self.assertTrue(robot.stands())
        robot.pause_scan(False)
        robot.send(GOAL)
        self.assertEqual(robot.finish(), GoalStatus.SUCCEEDED)
        self.assertLess(robot.distance(GOAL), REACH)
        self.assertEqual(robot.judge.contacts, 0)


if __name__ == "__main__":
    rospy.init_node("dead_scanner")
    rostest.rosrun("lstm_planner", "dead_scanner", DeadScanner)
