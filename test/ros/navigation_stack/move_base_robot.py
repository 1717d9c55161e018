"""The simulated robot and its move_base, as the tests beside this file see and command them."""
import math
import time

import actionlib
import dynamic_reconfigure.client
import rospy
from actionlib_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, Twist
from move_base_msgs.msg import MoveBaseAction, RecoveryStatus
from nav_msgs.msg import Path
from nav_msgs.srv import GetPlan
from rosgraph_msgs.msg import Log
from std_srvs.srv import SetBool

import drive_to_goal

PATIENCE = 120.0  # s of the computer's clock, only ends what would wait for ever
OURS = "lstm_planner/LstmGlobalPlanner"
NAVFN = "navfn/NavfnROS"


class Robot:
    """Goals and positions in the map frame, times simulated unless said otherwise."""

    def __init__(self, start):
        self.start = start
        self.judge = drive_to_goal.Judge()
        self.plans, self.decisions, self.recoveries, self.log, self.command = [], [], [], [], Twist()
        rospy.Subscriber("move_base/LstmGlobalPlanner/plan", Path, self.plans.append, queue_size=100)
        rospy.Subscriber("move_base/LstmGlobalPlanner/decision", DiagnosticArray, self.decisions.append, queue_size=100)
        rospy.Subscriber("move_base/recovery_status", RecoveryStatus, self.recoveries.append, queue_size=10)
        rospy.Subscriber("rosout", Log, self.on_log, queue_size=1000)
        rospy.Subscriber("cmd_vel", Twist, self.on_command, queue_size=1)
        self.client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        self.wait("the action server", lambda: self.client.wait_for_server(rospy.Duration(0.1)))
        self.wait("ground truth", lambda: self.judge.position is not None)
        self.settings = dynamic_reconfigure.client.Client("move_base", timeout=PATIENCE)

    def on_log(self, message):
        self.log.append(message.msg)

    def on_command(self, message):
        self.command = message

    @staticmethod
    def wait(what, condition):
        deadline = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > deadline:
                raise AssertionError("waited in vain for " + what)
            time.sleep(0.01)

    def pass_time(self, seconds):
        end = self.judge.time + seconds
        self.wait("the simulation's clock", lambda: self.judge.time >= end)

    def send(self, goal):
        self.plans.clear()
        self.client.send_goal(drive_to_goal.goal_message(self.start, goal))
        self.wait("the goal to be accepted", lambda: self.client.get_state() != GoalStatus.PENDING)

    def state(self):
        return self.client.get_state()

    def finish(self):
        """The state that the action ends in."""
        self.wait("the end of the action", lambda: self.state() not in (GoalStatus.PENDING, GoalStatus.ACTIVE))
        return self.state()

    def distance(self, goal):
        return math.dist(self.judge.position, goal)

    def stands(self):
        return self.command.linear.x == 0.0 and self.command.angular.z == 0.0

    def make_plan(self, goal, tolerance=0.0):
        """The plan that move_base's service gives; None where it refuses."""
        pose = drive_to_goal.goal_message(self.start, goal).target_pose
        try:
            return rospy.ServiceProxy("move_base/make_plan", GetPlan)(PoseStamped(), pose, tolerance).plan.poses
        except rospy.ServiceException:
            return None

    def choose_planner(self, planner):
        self.settings.update_configuration({"base_global_planner": planner})

    def pause_scan(self, paused):
        rospy.ServiceProxy("create2_stub/pause_scan", SetBool)(paused)

    def plan_end(self, plan, goal):
        """m between the last pose of a plan and a goal."""
        end = plan[-1].pose.position
        return math.dist((end.x, end.y), drive_to_goal.in_odometry_frame(self.start, goal))
