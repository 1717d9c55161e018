#!/usr/bin/python3
"""The robot's computer and the desktop are two network namespaces on a bridge, where this test listens, too."""
import os
import subprocess
import sys
import tempfile
import time
import unittest

import rosgraph
import rospkg
import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from processes import end, eventually  # noqa: E402

ROBOT, DESKTOP, OBSERVER = "10.213.77.2", "10.213.77.3", "10.213.77.1"
STANDS_WITHIN = 0.5  # s
CUT = 5.0  # s
STILL = 0.01  # m/s


def run(*command):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


class Network:
    """A bridge with two namespaces on it. Raises where that is not allowed."""

    def __init__(self):
        tag = "%04x" % (os.getpid() & 0xFFFF)
        self.bridge = "lpb" + tag
        self.machines = {"robot": "lpr" + tag, "desktop": "lpd" + tag}
        try:
            run("ip", "link", "add", self.bridge, "type", "bridge")
            run("ip", "addr", "add", OBSERVER + "/24", "dev", self.bridge)
            run("ip", "link", "set", self.bridge, "up")
            for machine, address in (("robot", ROBOT), ("desktop", DESKTOP)):
                name = self.machines[machine]
                run("ip", "netns", "add", name)
                run("ip", "link", "add", name, "type", "veth", "peer", "name", "eth0", "netns", name)
                run("ip", "link", "set", name, "master", self.bridge, "up")
                run("ip", "-n", name, "addr", "add", address + "/24", "dev", "eth0")
                run("ip", "-n", name, "link", "set", "eth0", "up")
                run("ip", "-n", name, "link", "set", "lo", "up")
        except (OSError, subprocess.CalledProcessError):
            self.close()
            raise

    def set_link(self, machine, state):
        run("ip", "link", "set", self.machines[machine], state)

    def start(self, machine, address, log, *command):
        environment = dict(os.environ, ROS_MASTER_URI="http://%s:11311" % ROBOT, ROS_IP=address)
        environment.pop("ROS_HOSTNAME", None)
        return subprocess.Popen(["ip", "netns", "exec", self.machines[machine], *command], env=environment,
                                stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)

    def close(self):
        for name in self.machines.values():
            subprocess.run(["ip", "netns", "del", name], stderr=subprocess.DEVNULL)
        subprocess.run(["ip", "link", "del", self.bridge], stderr=subprocess.DEVNULL)


class TwoMachines(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.processes = []
        cls.log = tempfile.NamedTemporaryFile()
        try:
            cls.network = Network()
        except (OSError, subprocess.CalledProcessError):
            raise unittest.SkipTest("network namespaces are not allowed here")
        os.environ.update(ROS_MASTER_URI="http://%s:11311" % ROBOT, ROS_IP=OBSERVER)
        os.environ.pop("ROS_HOSTNAME", None)
        config = os.path.join(rospkg.RosPack().get_path("lstm_planner"), "config")
        cls.processes.append(cls.network.start("robot", ROBOT, None, "rosmaster", "--core"))
        if not eventually(rosgraph.is_master_online):
            raise AssertionError("the master does not answer")
        rosgraph.Master("/two_machines").setParam("/run_id", "two_machines")
        cls.launch("robot", ROBOT, "map:=" + os.path.join(config, "demo_building.yaml"))
        cls.launch("desktop", DESKTOP, "move_base:=standalone")
        rospy.init_node("two_machines", disable_signals=True)
        cls.twist = None
        rospy.Subscriber("/odom", Odometry, cls.on_odometry)
        cls.goals = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=1, latch=True)

    @classmethod
    def tearDownClass(cls):
        for process in reversed(cls.processes):
            end(process)
        if hasattr(cls, "network"):
            cls.network.close()

    @classmethod
    def launch(cls, machine, address, *arguments):
        log = cls.log if machine == "desktop" else None
        process = cls.network.start(machine, address, log, "roslaunch", "lstm_planner", "two_machines.launch",
                                    "on:=" + machine, *arguments)
        cls.processes.append(process)
        return process

    @classmethod
    def on_odometry(cls, message):
        cls.twist = message.twist.twist

    def drive(self):
        goal = PoseStamped()
        goal.header.frame_id = "odom"
        goal.pose.position.x, goal.pose.position.y, goal.pose.orientation.w = 4.0, -13.0, 1.0
        self.goals.publish(goal)

    def drives(self):
        return self.twist is not None and self.twist.linear.x > 0.1

    def stands(self):
        return self.twist is not None and abs(self.twist.linear.x) < STILL and abs(self.twist.angular.z) < STILL

    def said(self, *texts):
        """A line on the desktop has all of them."""
        with open(self.log.name, errors="replace") as file:
            return any(all(text in line for text in texts) for line in file)

    def test_1_a_cut_link(self):
        self.drive()
        self.assertTrue(eventually(self.drives), "it does not drive")
        self.network.set_link("desktop", "down")
        cut = time.monotonic()
        self.assertTrue(eventually(self.stands))
        stood = time.monotonic() - cut
        self.assertLess(stood, STANDS_WITHIN)
        time.sleep(CUT - stood)
        self.assertTrue(self.said("the newest message on /", "s old, allowed are"), "it does not say why")
        self.network.set_link("desktop", "up")
        up = time.monotonic()
        self.assertTrue(eventually(self.drives), "it does not go on")
        print("it stood after %.2f s, and went on %.1f s after the link was back" % (stood, time.monotonic() - up))

    def test_2_another_clock(self):
        """The scans' stamps are moved, as seen by a desktop whose clock goes wrong by as much."""
        for shift, words in ((-1.0, "although it has just come: the network is slow, or the clocks differ"),
                             (1.0, "s in the future, allowed are")):
            end(self.processes.pop())
            publisher = rospy.Publisher("/other_clock", LaserScan, queue_size=3)

            def relay(scan, shift=shift, publisher=publisher):
                scan.header.stamp += rospy.Duration(shift)
                publisher.publish(scan)
            subscriber = rospy.Subscriber("/scan", LaserScan, relay, queue_size=3)
            for plugin in ("LstmGlobalPlanner", "SteeringController"):
                rospy.set_param("/move_base/%s/scan_topic" % plugin, "/other_clock")
            process = self.network.start("desktop", DESKTOP, self.log, "rosrun", "lstm_planner",
                                         "standalone_move_base", "__name:=move_base")
            self.processes.append(process)
            self.drive()
            self.assertTrue(eventually(lambda: self.said("the newest message on /other_clock is", words, "NTP")), words)
            self.assertTrue(self.stands())
            subscriber.unregister()


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "two_machines", TwoMachines)
