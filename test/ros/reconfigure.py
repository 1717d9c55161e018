#!/usr/bin/python3
"""Parameters of both plugins are changed by dynamic_reconfigure's own client while the robot drives."""
import os
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped, Twist
from rosgraph_msgs.msg import Log

try:
    import dynamic_reconfigure.client
except ImportError:
    dynamic_reconfigure = None

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from processes import eventually  # noqa: E402

PATIENCE = 20.0  # s


@unittest.skipIf(dynamic_reconfigure is None, "dynamic_reconfigure is not installed")
class Reconfigure(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("reconfigure")
        cls.log, cls.speeds = [], []
        rospy.Subscriber("/rosout", Log, lambda line: cls.log.append(line.msg))
        rospy.Subscriber("/cmd_vel", Twist, lambda twist: cls.speeds.append(twist.linear.x))
        cls.controller = dynamic_reconfigure.client.Client("/move_base/SteeringController", timeout=PATIENCE)
        cls.planner = dynamic_reconfigure.client.Client("/move_base/LstmGlobalPlanner", timeout=PATIENCE)
        cls.goals = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=1, latch=True)
        goal = PoseStamped()
        goal.header.frame_id = "map"
        goal.pose.position.x, goal.pose.position.y, goal.pose.orientation.w = 15.2, 10.5, 1.0
        cls.goals.publish(goal)

    def description(self, client, name):
        return next(one for one in client.get_parameter_descriptions(PATIENCE) if one["name"] == name)

    def logged(self, text):
        return eventually(lambda: any(text in line for line in self.log))

    def test_a_parameter_is_described_once(self):
        speed = self.description(self.controller, "max_linear")
        self.assertEqual((speed["type"], speed["min"], speed["max"], speed["default"]), ("double", 0.01, 10.0, 0.3))
        self.assertTrue(speed["description"].startswith("m/s, largest forward speed"))
        self.assertNotIn("restart", speed["description"])
        self.assertIn("(needs a restart)", self.description(self.controller, "scan_topic")["description"])
        self.assertIn("'value': 'network'", str(self.description(self.planner, "leader")["edit_method"]))

    def test_the_speed_changes_while_it_drives(self):
        self.assertTrue(eventually(lambda: self.speeds and self.speeds[-1] > 0.2))
        self.controller.update_configuration({"max_linear": 0.1})
        before = len(self.speeds)  # commands that were given before the change may still be on their way: two at the most
        self.assertTrue(eventually(lambda: len(self.speeds) > before + 2 and self.speeds[-1] <= 0.1))
        del self.speeds[:]
        self.assertTrue(eventually(lambda: len(self.speeds) > 20 and max(self.speeds) > 0.05))
        self.assertLessEqual(max(self.speeds), 0.1)
        self.assertEqual(rospy.get_param("/move_base/SteeringController/max_linear"), 0.1)
        self.controller.update_configuration({"max_linear": 0.3})

    def test_who_leads_changes_while_it_drives(self):
        # The reason that is told is the newest one: the robot may have come nearer to the goal than ever meanwhile.
        for leader in ("route", "network"):
            del self.log[:]
            self.planner.update_configuration({"leader": leader})
            self.assertTrue(self.logged("the %s leads: " % leader), leader)

    def test_what_cannot_be_used_changes_nothing_and_is_said(self):
        for client, changes, reason in (
                (self.controller, {"max_linear": 100.0}, "parameter max_linear is 100, expected a number in [0.01, 10]"),
                (self.controller, {"scan_topic": "/other"}, "parameter scan_topic needs a restart"),
                (self.planner, {"leader": "none"}, "leader is 'none', expected network or route"),
                (self.planner, {"leader": "somebody"}, "somebody")):
            before = client.update_configuration({})  # what it holds now; get_configuration() may still be older
            after = client.update_configuration(changes)
            for name in changes:
                self.assertEqual(after[name], before[name])
            self.assertTrue(self.logged("no parameter is changed: "))
            self.assertTrue(self.logged(reason), reason)


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "reconfigure", Reconfigure)
