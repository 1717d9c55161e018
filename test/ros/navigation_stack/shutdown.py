#!/usr/bin/python3
"""A move_base with our planner ends by itself, and well, when it is told to: idle, and while it drives."""
import os
import signal
import subprocess
import sys
import time
import unittest

import actionlib
import roslib.packages
import rospy
import rostest
from geometry_msgs.msg import Twist
from move_base_msgs.msg import MoveBaseAction

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from drive_to_goal import goal_message  # noqa: E402
from move_base_robot import Robot  # noqa: E402

START = (1.5, 2.5, 1.5708)
FAR = (2.0, 8.25)
PATIENCE = 60.0  # s of the computer's clock
LOCAL_PLANNERS = ("lstm_planner/SteeringController", "dwa_local_planner/DWAPlannerROS")


class Shutdown(unittest.TestCase):
    """Of a second move_base, in the namespace /second; the first one's parameters are its own, too."""

    def start(self, local_planner):
        rospy.set_param("/second/move_base", rospy.get_param("/move_base"))
        rospy.set_param("/second/move_base/base_local_planner", local_planner)
        program = roslib.packages.find_node("move_base", "move_base")[0]
        process = subprocess.Popen([program, "__ns:=second", "__name:=move_base", "scan:=/scan", "odom:=/odom"], stdin=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        self.client = actionlib.SimpleActionClient("/second/move_base", MoveBaseAction)
        Robot.wait("the second move_base", lambda: self.client.wait_for_server(rospy.Duration(0.1)))
        return process

    def end(self, process):
        process.send_signal(signal.SIGINT)
        return process.wait(PATIENCE)

    def test_idle(self):
        for local_planner in LOCAL_PLANNERS:
            self.assertEqual(self.end(self.start(local_planner)), 0, local_planner)

    def test_while_it_drives(self):
        for local_planner in LOCAL_PLANNERS:
            commands = []
            process = self.start(local_planner)
            subscriber = rospy.Subscriber("/second/cmd_vel", Twist, commands.append)
            self.client.send_goal(goal_message(START, FAR))
            Robot.wait("commands", lambda: [command for command in commands if command.linear.x > 0.0])
            time.sleep(0.5)
            self.assertEqual(self.end(process), 0, local_planner)
            subscriber.unregister()


if __name__ == "__main__":
    rospy.init_node("shutdown")
    rostest.rosrun("lstm_planner", "shutdown", Shutdown)
