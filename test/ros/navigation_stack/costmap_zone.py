#!/usr/bin/python3
"""A zone that a layer of the costmap marks and no laser sees, in the demo's building, with both plugins."""
import math
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import Point32
from nav_msgs.msg import Odometry
from sensor_msgs.msg import PointCloud
from std_srvs.srv import Empty

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import drive_to_goal  # noqa: E402
from move_base_robot import Robot  # noqa: E402

START = (1.5, 2.5, 1.5708)
BEHIND = (1.6, 4.4)  # from the start seen right across the zones
RADIUS = 0.174  # m, of the robot
GRID_ERROR = 0.05  # m: a zone is known to a cell, odometry to a centimetre or two
SPACING = 0.04  # m between the points of a zone, less than a cell


def zone(left, right, bottom=3.3, top=3.5):
    """Points of a rectangle, map frame."""
    columns, rows = int((right - left) / SPACING) + 1, int((top - bottom) / SPACING) + 1
    return [(left + SPACING * column, bottom + SPACING * row) for column in range(columns) for row in range(rows)]


class CostmapZone(unittest.TestCase):
    robot = None
    points = []
    nearest = math.inf

    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(START)
        cls.publisher = rospy.Publisher("zone", PointCloud, queue_size=1)
        rospy.Timer(rospy.Duration(0.1), cls.publish)
        rospy.Subscriber("create2_stub/ground_truth", Odometry, cls.measure, queue_size=100)

    @classmethod
    def publish(cls, _):
        cloud = PointCloud()
        cloud.header.frame_id = "odom"
        cloud.header.stamp = rospy.Time.now()
        for point in cls.points:
            x, y = drive_to_goal.in_odometry_frame(START, point)
            cloud.points.append(Point32(x, y, 0.1))
        cls.publisher.publish(cloud)

    @classmethod
    def measure(cls, message):
        here = message.pose.pose.position
        for point in cls.points:
            cls.nearest = min(cls.nearest, math.dist((here.x, here.y), point))

    def mark(self, points):
        type(self).points = points
        type(self).nearest = math.inf
        self.robot.pass_time(1.0)

    def clear(self):
        self.mark([])
        rospy.ServiceProxy("move_base/clear_costmaps", Empty)()
        self.robot.pass_time(0.5)

    def setUp(self):
        self.clear()
        self.robot.send(START[:2])
        self.assertEqual(self.robot.finish(), GoalStatus.SUCCEEDED)

    def test_1_the_robot_drives_around_it(self):
        self.mark(zone(1.0, 1.9))
        self.robot.send(BEHIND)
        self.assertEqual(self.robot.finish(), GoalStatus.SUCCEEDED)
        self.assertGreater(self.nearest, RADIUS - GRID_ERROR)
        self.assertEqual(self.robot.judge.contacts, 0)

    def test_2_the_robot_stays_in_front_of_one_that_closes_the_room_until_it_is_cleared(self):
        self.mark(zone(0.2, 5.4))
        self.robot.send(BEHIND)
        self.robot.pass_time(15.0)
        self.assertGreater(self.nearest, RADIUS - GRID_ERROR)
        self.assertLess(self.robot.judge.position[1], 3.3)
        self.assertNotEqual(self.robot.state(), GoalStatus.SUCCEEDED)
        self.clear()
        self.robot.send(BEHIND)
        self.assertEqual(self.robot.finish(), GoalStatus.SUCCEEDED)


if __name__ == "__main__":
    rospy.init_node("costmap_zone")
    rostest.rosrun("lstm_planner", "costmap_zone", CostmapZone)
