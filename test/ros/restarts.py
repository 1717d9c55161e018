#!/usr/bin/python3
"""The planner's host is killed, or the ROS master, while the robot drives. Both run under a master of their own."""
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xmlrpc.client

import actionlib
import rosgraph
import roslib.packages
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import Twist
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import Odometry
from std_msgs.msg import UInt32

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from processes import end, eventually, free_port, package_file  # noqa: E402

FAR_GOALS = ((6.5, 1.25), (2.0, 8.25))  # m, map frame; the robot starts at (1.5, 2.5)
GOALS_FILE = "frame: map\nstart: [1.5, 2.5, 1.57]\ntime_limit: 60.0\ngoals:\n  - {name: near, x: 1.5, y: 3.5, yaw: 0.0}\n"
LATCH = 0.3  # s without a command after which the base stops by itself, at most (latch_cmd_duration and a loop)
STANDS_WITHIN = 0.5  # s
WATCHED = 1.0  # s after which it must still stand
STILL = 0.01  # m/s
LONGEST_DRIVE = 180.0  # s of the robot's clock, from one goal to the other; it takes less than a minute as a rule
PATIENCE = 600.0  # s of the computer's clock; only ends what would last for ever


def launch(path, *arguments):
    return subprocess.Popen(["roslaunch", package_file("launch", path), *arguments],
                            stdin=subprocess.DEVNULL)


def start_master(port):
    """Returns when it answers, as a roscore would."""
    master = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], stdin=subprocess.DEVNULL)
    if not eventually(rosgraph.is_master_online):
        raise AssertionError("the master does not answer")
    rosgraph.Master("/restarts").setParam("/run_id", "restarts")
    return master


class Restarts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.port = free_port()
        os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % cls.port
        cls.master = start_master(cls.port)
        rosgraph.Master("/restarts").setParam("/use_sim_time", True)
        cls.robot = launch("includes/create2_stub.launch", "map:=" + package_file("config", "demo_building.yaml"),
                           "scenario:=" + package_file("config", "demo_goals.yaml"), "publish_clock:=true",
                           "real_time_factor:=2.0", "command_period:=0.06")
        cls.planner = launch("includes/move_base.launch")
        cls.time = cls.speed = cls.last_motion = 0.0
        cls.place = (0.0, 0.0)
        cls.contacts = 0
        rospy.init_node("restarts", disable_signals=True)
        cls.subscribers = [rospy.Subscriber("create2_stub/ground_truth", Odometry, cls.on_truth, tcp_nodelay=True),
                           rospy.Subscriber("create2_stub/contacts", UInt32, cls.on_contacts)]

    @classmethod
    def tearDownClass(cls):
        try:
            rospy.signal_shutdown("the test is over")
        except AttributeError:
            pass  # in Debian 11, whose rospy asks threads for isAlive(), which its Python no longer has
        for process in (cls.planner, cls.robot, cls.master):
            end(process)

    @classmethod
    def on_truth(cls, truth):
        cls.time = truth.header.stamp.to_sec()
        cls.place = (truth.pose.pose.position.x, truth.pose.pose.position.y)
        cls.speed = abs(truth.twist.twist.linear.x) + 0.1 * abs(truth.twist.twist.angular.z)
        if cls.speed >= STILL:
            cls.last_motion = cls.time

    @classmethod
    def on_contacts(cls, contacts):
        cls.contacts = contacts.data

    def drive(self):
        """Gives the goal that is farther away, and returns its client when the robot is on its way."""
        self.assertTrue(eventually(lambda: self.time > 0.0), "the clock stands")
        client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        self.assertTrue(eventually(lambda: client.wait_for_server(rospy.Duration(0.1))), "move_base is not there")
        goal = MoveBaseGoal()
        goal.target_pose.header.frame_id = "map"
        place = max(FAR_GOALS, key=lambda goal: abs(goal[0] - self.place[0]) + abs(goal[1] - self.place[1]))
        goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = place
        goal.target_pose.pose.orientation.w = 1.0
        client.send_goal(goal)
        self.assertTrue(eventually(lambda: self.speed > 0.15), "it does not start")
        return client

    def assert_reached(self, client):
        begin = self.time

        def reached():
            return client.get_state() == GoalStatus.SUCCEEDED

        eventually(lambda: reached() or self.time > begin + LONGEST_DRIVE, PATIENCE)
        self.assertTrue(reached(), "%s; %.0f s of the robot's clock" % (client.get_goal_status_text(), self.time - begin))
        self.assertEqual(self.contacts, 0)

    def test_a_planner_that_is_killed_leaves_a_robot_that_stands_and_a_new_one_goes_on(self):
        self.drive()
        host = xmlrpc.client.ServerProxy(rosgraph.Master("/restarts").lookupNode("/move_base"))
        begin = self.time
        os.kill(host.getPid("/restarts")[2], signal.SIGKILL)
        self.assertTrue(eventually(lambda: self.time > begin + LATCH + STANDS_WITHIN + WATCHED))
        self.assertLessEqual(self.last_motion - begin, LATCH + STANDS_WITHIN, "s until it stood")
        self.assertEqual(self.contacts, 0)

        self.planner.wait(PATIENCE)
        type(self).planner = launch("includes/move_base.launch")
        self.assert_reached(self.drive())

    def test_a_planner_that_is_ended_stops_the_robot_and_tells_the_client(self):
        if not roslib.packages.find_node("lstm_planner", "standalone_move_base"):
            self.skipTest("the navigation stack's move_base does neither")
        speeds = []
        subscriber = rospy.Subscriber("cmd_vel", Twist, lambda command: speeds.append(command.linear.x))
        self.addCleanup(subscriber.unregister)
        ways = {"rosnode kill": lambda host: host.shutdown("/restarts", "the test ends it"),
                "a signal": lambda host: os.kill(host.getPid("/restarts")[2], signal.SIGTERM)}
        for way, kill in ways.items():
            client = self.drive()
            kill(xmlrpc.client.ServerProxy(rosgraph.Master("/restarts").lookupNode("/move_base")))
            self.planner.wait(PATIENCE)
            self.assertTrue(eventually(lambda: speeds and speeds[-1] == 0.0), way)
            self.assertTrue(eventually(lambda: client.get_state() == GoalStatus.ABORTED), way)
            type(self).planner = launch("includes/move_base.launch")

    def test_without_the_master_it_drives_on_and_restarted_nodes_find_a_new_one(self):
        client = self.drive()
        self.master.send_signal(signal.SIGKILL)
        self.master.wait(PATIENCE)
        begin = self.time
        self.assertTrue(eventually(lambda: self.time > begin + 1.0), "the clock stands")
        type(self).master = start_master(self.port)
        self.assert_reached(client)
        publishers = dict(rosgraph.Master("/restarts").getSystemState()[0])
        self.assertNotIn("/scan", publishers, "a new master knows none of the nodes")

        for process in (self.planner, self.robot):
            end(process)
        with tempfile.TemporaryDirectory(prefix="lstm_planner_") as folder:
            goals, result = (os.path.join(folder, name) for name in ("goals.yaml", "result"))
            with open(goals, "w", encoding="utf-8") as file:
                file.write(GOALS_FILE)
            demo = launch("demo.launch", "goals:=" + goals, "result:=" + result, "picture:=none", "rviz:=false")
            self.addCleanup(end, demo)
            demo.wait(PATIENCE)
            with open(result, encoding="utf-8") as file:
                self.assertEqual(file.readline().strip(), "0", "a goal was missed, or something touched")


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "restarts", Restarts)
