#!/usr/bin/python3
"""Two simulated robots, each in a namespace of its own, drive in one building and see each other."""
import math
import threading
import unittest

import actionlib
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import Odometry
from std_msgs.msg import UInt32

GOALS = {"robot1": (6.5, 8.25), "robot2": (1.5, 3.5)}  # m, map frame: each goes where the other one comes from
DIAMETER = 0.3485  # m
PATIENCE = 180.0  # s


class TwoRobots(unittest.TestCase):
    def setUp(self):
        rospy.init_node("two_robots")
        self.lock = threading.Lock()
        self.positions, self.contacts, self.nearest = {}, {}, math.inf
        for robot in GOALS:
            rospy.Subscriber("/%s/create2_stub/ground_truth" % robot, Odometry, self.on_truth, robot)
            rospy.Subscriber("/%s/create2_stub/contacts" % robot, UInt32, self.on_contacts, robot)

    def on_truth(self, message, robot):
        with self.lock:
            position = message.pose.pose.position
            self.positions[robot] = (position.x, position.y)
            if len(self.positions) == 2:
                self.nearest = min(self.nearest, math.dist(*self.positions.values()))

    def on_contacts(self, message, robot):
        with self.lock:
            self.contacts[robot] = message.data

    def test_they_arrive_and_do_not_touch(self):
        clients = {robot: actionlib.SimpleActionClient("/%s/move_base" % robot, MoveBaseAction) for robot in GOALS}
        for robot, client in clients.items():
            self.assertTrue(client.wait_for_server(rospy.Duration(30.0)), robot)
            goal = MoveBaseGoal()
            goal.target_pose.header.frame_id = "map"
            goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = GOALS[robot]
            goal.target_pose.pose.orientation.w = 1.0
            client.send_goal(goal)
        for robot, client in clients.items():
            self.assertTrue(client.wait_for_result(rospy.Duration(PATIENCE)), robot + " has not arrived")
            self.assertEqual(client.get_state(), GoalStatus.SUCCEEDED, robot)
        with self.lock:
            self.assertEqual(self.contacts, {"robot1": 0, "robot2": 0})
            self.assertGreater(self.nearest, DIAMETER)
            self.assertLess(self.nearest, 2.0, "they have not met")
            print("the robots came as near as %.2f m" % self.nearest)


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "two_robots", TwoRobots)
