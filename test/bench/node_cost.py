#!/usr/bin/python3
"""What the planner costs while it drives: processor time and memory of the node move_base with this package's plugins,
beside a node that merely receives the same topics. Prints both and the difference.

Needs the environment of a workspace in which the tests have been built (`bash test/run.sh --build-only`)."""
import argparse
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time

FOLDER = os.path.dirname(os.path.realpath(__file__))
STARTUP = 30.0  # s until the node runs, at the most
SETTLE = 5.0  # s between that and the measurement
GOALS = [(15.2, 10.5), (2.0, 8.25), (16.5, 1.25)]  # m in the frame map: those of the demo that are far apart


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def processor_time(pid):
    """s that all threads of the process have run, by the scheduler's own clock."""
    folder = "/proc/%d/task" % pid
    total = 0
    for thread in os.listdir(folder):
        with open("%s/%s/schedstat" % (folder, thread)) as file:
            total += int(file.read().split()[0])
    return 1e-9 * total


def memory(pid):
    """MB: all that is in memory, and of it what belongs to this process alone and was written to (its own data)."""
    values = {}
    with open("/proc/%d/smaps_rollup" % pid) as file:
        for line in file.readlines()[1:]:
            key, value = line.split(":")
            values[key] = int(value.split()[0]) / 1000.0
    return values["Rss"], values["Private_Dirty"]


class Run:
    """The robot and the subject under a ROS master of their own."""

    def __init__(self, subject, decisions):
        self.port = free_port()
        self.home = tempfile.TemporaryDirectory()
        self.environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % self.port, ROS_HOSTNAME="localhost",
                                ROS_HOME=self.home.name)
        self.launch = subprocess.Popen(
            ["roslaunch", "-p", str(self.port), os.path.join(FOLDER, "node_cost.launch"), "subject:=" + subject,
             "decisions:=%s" % decisions], env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.launch.send_signal(signal.SIGINT)
        self.launch.wait()
        self.home.cleanup()

    def pid(self):
        """Of the node move_base, once it runs."""
        import rosgraph
        import xmlrpc.client
        end = time.monotonic() + STARTUP
        while time.monotonic() < end:
            try:
                node = rosgraph.Master("/node_cost", self.environment["ROS_MASTER_URI"]).lookupNode("/move_base")
                return xmlrpc.client.ServerProxy(node).getPid("/node_cost")[2]
            except (OSError, rosgraph.MasterException):
                time.sleep(0.5)
        sys.exit("node_cost.py: the node move_base does not run; is the workspace's environment set?")

    def drive_to(self, goal):
        """Sends a goal as rviz would."""
        message = "{header: {frame_id: map}, pose: {position: {x: %f, y: %f}, orientation: {w: 1.0}}}" % goal
        subprocess.run(["rostopic", "pub", "-1", "/move_base_simple/goal", "geometry_msgs/PoseStamped", message],
                       env=self.environment, stdout=subprocess.DEVNULL, check=True)


def measure(pid, seconds):
    """Processor time by share of one core, % and the memory at the end, MB."""
    begin, before = time.monotonic(), processor_time(pid)
    time.sleep(seconds)
    share = 100.0 * (processor_time(pid) - before) / (time.monotonic() - begin)
    resident, own = memory(pid)
    return {"core_percent": share, "resident_mb": resident, "own_data_mb": own}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0, help="of each measurement (60)")
    parser.add_argument("--decisions", type=float, default=2.0, help="plans a second (2)")
    parser.add_argument("--json", help="write the result to this file, too")
    arguments = parser.parse_args()

    results = {}
    with Run("receiver", arguments.decisions) as run:
        pid = run.pid()
        time.sleep(SETTLE)
        results["receiving"] = measure(pid, arguments.seconds)
    with Run("move_base", arguments.decisions) as run:
        pid = run.pid()
        time.sleep(SETTLE)
        results["waiting for a goal"] = measure(pid, 0.5 * arguments.seconds)
        driving = []
        for goal in GOALS:
            run.drive_to(goal)
            time.sleep(1.0)
            driving.append(measure(pid, arguments.seconds / len(GOALS)))
        results["driving"] = dict(driving[-1], core_percent=sum(d["core_percent"] for d in driving) / len(driving))
    more = {key: results["driving"][key] - results["receiving"][key] for key in results["receiving"]}
    results["driving less receiving"] = more

    print("| | %s |" % " | ".join(more))
    print("|---|" + "---|" * len(more))
    for name, values in results.items():
        print("| %s | %s |" % (name, " | ".join("%.2f" % values[key] for key in more)))
    if arguments.json:
        with open(arguments.json, "w") as file:
            json.dump(results, file, indent=2)


if __name__ == "__main__":
    main()
