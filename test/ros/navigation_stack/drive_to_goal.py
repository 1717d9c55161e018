#!/usr/bin/python3
"""Sends one goal to move_base and judges from the simulation's ground truth what the robot made of it."""
import argparse
import json
import math
import sys
import threading
import time

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import Odometry
from std_msgs.msg import Float64MultiArray, UInt32

ENDED = (GoalStatus.SUCCEEDED, GoalStatus.ABORTED, GoalStatus.REJECTED, GoalStatus.PREEMPTED)
PATIENCE = 60.0  # s of the computer's clock without ground truth or an action server


class Judge:
    """Where the robot truly is, how far it has come, what it has touched, and what planning has cost."""

    def __init__(self):
        self.lock = threading.Lock()
        self.position = None
        self.time = 0.0
        self.path = 0.0
        self.contacts = 0
        self.calls = (0.0, 0.0, 0.0)  # number, of them without a plan, CPU s
        self.heard = time.monotonic()
        rospy.Subscriber("create2_stub/ground_truth", Odometry, self.on_truth, queue_size=100)
        rospy.Subscriber("create2_stub/contacts", UInt32, self.on_contacts, queue_size=10)
        rospy.Subscriber("move_base/TimedGlobalPlanner/calls", Float64MultiArray, self.on_calls, queue_size=10)

    def on_truth(self, message):
        position = (message.pose.pose.position.x, message.pose.pose.position.y)
        with self.lock:
            if self.position is not None:
                self.path += math.dist(self.position, position)
            self.position = position
            self.time = message.header.stamp.to_sec()
            self.heard = time.monotonic()

    def on_contacts(self, message):
        with self.lock:
            self.contacts = message.data

    def on_calls(self, message):
        with self.lock:
            self.calls = tuple(message.data)

    def check_alive(self):
        if time.monotonic() - self.heard > PATIENCE:
            raise RuntimeError("nothing on the topic create2_stub/ground_truth any more")


def in_odometry_frame(start, point):
    """A point of the map in the frame that starts at the start pose (x, y, yaw)."""
    x, y = point[0] - start[0], point[1] - start[1]
    cosine, sine = math.cos(start[2]), math.sin(start[2])
    return cosine * x + sine * y, cosine * y - sine * x


def goal_message(start, goal):
    x, y = in_odometry_frame(start, goal)
    message = MoveBaseGoal()
    message.target_pose.header.frame_id = "odom"
    message.target_pose.header.stamp = rospy.Time.now()
    message.target_pose.pose.position.x = x
    message.target_pose.pose.position.y = y
    message.target_pose.pose.orientation.w = 1.0
    return message


def drive(start, goal, radius, time_limit, pass_by):
    """Drives from the start pose to the goal (both in the map frame). With pass_by coming within the radius is arriving,
    else move_base has to say so, too."""
    judge = Judge()
    client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
    deadline = time.monotonic() + PATIENCE
    while judge.position is None or not client.wait_for_server(rospy.Duration(0.1)):
        if time.monotonic() > deadline:
            raise RuntimeError("no ground truth or no server of the action move_base")
        time.sleep(0.05)
    time.sleep(0.5)  # of the computer's: for the costmaps to see something

    begin, path_before = judge.time, judge.path
    client.send_goal(goal_message(start, goal))
    arrived = False
    while not arrived and judge.time - begin < time_limit:
        time.sleep(0.02)
        judge.check_alive()
        if client.get_state() in ENDED:
            break
        arrived = pass_by and math.dist(judge.position, goal) <= radius
    state = client.get_state()
    remaining = math.dist(judge.position, goal)
    result = {
        "arrived": arrived or (state == GoalStatus.SUCCEEDED and remaining <= radius),
        "early": state == GoalStatus.SUCCEEDED and remaining > radius,
        "text": client.get_goal_status_text() if state in ENDED else "" if arrived else "time limit",
        "time": judge.time - begin,
        "path": judge.path - path_before,
        "remaining": remaining,
        "contacts": judge.contacts,
        "calls": judge.calls[0],
        "failures": judge.calls[1],
        "cpu": judge.calls[2],
    }
    client.cancel_goal()
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--start", type=float, nargs=3, required=True, metavar=("X", "Y", "YAW"))
    parser.add_argument("--goal", type=float, nargs=2, required=True, metavar=("X", "Y"))
    parser.add_argument("--radius", type=float, required=True, help="m from the goal that count as arrived")
    parser.add_argument("--time-limit", type=float, required=True, help="s, simulated")
    parser.add_argument("--pass-by", action="store_true", help="coming within the radius is enough")
    arguments = parser.parse_args(rospy.myargv(sys.argv)[1:])
    rospy.init_node("drive_to_goal", disable_signals=True)
    print(json.dumps(drive(arguments.start, arguments.goal, arguments.radius, arguments.time_limit, arguments.pass_by)))


if __name__ == "__main__":
    main()
