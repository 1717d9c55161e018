#!/usr/bin/python3
"""What bites global planners in move_base, with the navigation stack's own local planner, in the demo's building."""
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from move_base_robot import NAVFN, OURS, Robot  # noqa: E402

START = (1.5, 2.5, 1.5708)
FAR = (1.6, 4.4)  # outside the global costmap, seen from the start
NEAR = (1.55, 3.9)  # inside
TOLERANCE = 0.2  # m, of the local planner
ODOMETRY_ERROR = 0.1  # m between where the robot is and where it thinks it is, on these paths


class Pitfalls(unittest.TestCase):
    robot = None

    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(START)

    def setUp(self):
        self.robot.send(START[:2])
        self.assertEqual(self.robot.finish(), GoalStatus.SUCCEEDED)
        self.robot.recoveries.clear()

    def tearDown(self):
        self.robot.client.cancel_goal()
        self.robot.wait("the robot to stand", self.robot.stands)

    def test_1_success_is_reported_at_the_goal_only_also_when_it_lies_outside_the_costmap(self):
        robot = self.robot
        width = rospy.get_param("/move_base/global_costmap/width")
        self.assertGreater(robot.distance(FAR), width / 2.0)
        robot.send(FAR)
        self.assertEqual(robot.finish(), GoalStatus.SUCCEEDED)
        self.assertLess(robot.distance(FAR), TOLERANCE + ODOMETRY_ERROR)
        # The local planner takes the last pose for the goal, wherever the network steers for. The goal moves in the
        # odometry's frame as the odometry drifts.
        self.assertGreater(len(robot.plans), 5)
        for plan in robot.plans:
            self.assertLess(robot.plan_end(plan.poses, FAR), ODOMETRY_ERROR)
        self.assertEqual(robot.judge.contacts, 0)

    def test_2_questions_of_others_change_nothing(self):
        robot = self.robot
        robot.send(FAR)
        robot.wait("a plan", lambda: robot.plans)
        steps = []
        for _ in range(10):
            # This move_base refuses while it drives; another one may not.
            robot.make_plan(START, tolerance=0.5)
            robot.pass_time(0.2)
            steps.append(self.step())
        self.assertEqual(steps, sorted(steps), "the steps were counted anew")
        self.assertEqual(robot.state(), GoalStatus.ACTIVE)
        robot.client.cancel_goal()
        robot.wait("the robot to stand", robot.stands)
        robot.pass_time(1.0)
        decisions, step = len(robot.decisions), self.step()
        for _ in range(5):
            plan = robot.make_plan(START, tolerance=0.5)
            self.assertLess(robot.plan_end(plan, START), 1e-3)
        robot.pass_time(1.0)
        self.assertEqual(len(robot.decisions), decisions, "a question was taken for a goal")
        self.assertEqual(self.step(), step)

    def step(self):
        values = {entry.key: entry.value for entry in self.robot.decisions[-1].status[0].values}
        return int(values["step"])

    def test_3_a_new_goal_takes_the_place_of_the_old_one_and_a_cancel_stops_the_robot(self):
        robot = self.robot
        robot.send(FAR)
        robot.wait("the robot to drive", lambda: robot.distance(START[:2]) > 0.5)
        robot.send(START[:2])
        self.assertEqual(robot.finish(), GoalStatus.SUCCEEDED)
        self.assertLess(robot.distance(START[:2]), TOLERANCE + ODOMETRY_ERROR)
        robot.send(FAR)
        robot.wait("the robot to drive", lambda: robot.command.linear.x > 0.1)
        robot.client.cancel_goal()
        self.assertEqual(robot.finish(), GoalStatus.PREEMPTED)
        robot.pass_time(0.5)
        self.assertTrue(robot.stands())

    def test_4_the_planner_can_be_exchanged_while_the_robot_drives(self):
        robot = self.robot
        robot.send(NEAR)
        robot.wait("a plan", lambda: robot.plans)
        robot.choose_planner(NAVFN)
        robot.plans.clear()
        path = robot.judge.path
        robot.wait("the robot to drive by the other planner's plans", lambda: robot.judge.path > path + 0.2)
        self.assertEqual(robot.plans, [])
        robot.choose_planner(OURS)
        robot.wait("a plan of the planner that came back", lambda: robot.plans)
        self.assertEqual(robot.finish(), GoalStatus.SUCCEEDED)
        self.assertLess(robot.distance(NEAR), TOLERANCE + ODOMETRY_ERROR)

    def test_5_the_planner_outlives_recovery_behaviours(self):
        robot = self.robot
        robot.pause_scan(True)
        robot.pass_time(1.0)
        robot.send(NEAR)
        self.assertEqual(robot.finish(), GoalStatus.ABORTED)
        self.assertGreaterEqual(len(robot.recoveries), 3)
        robot.pause_scan(False)
        robot.pass_time(1.0)
        robot.send(NEAR)
        self.assertEqual(robot.finish(), GoalStatus.SUCCEEDED)
        self.assertLess(robot.distance(NEAR), TOLERANCE + ODOMETRY_ERROR)
        self.assertEqual(robot.judge.contacts, 0)


if __name__ == "__main__":
    rospy.init_node("pitfalls")
    rostest.rosrun("lstm_planner", "pitfalls", Pitfalls)
