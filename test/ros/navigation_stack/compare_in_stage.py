#!/usr/bin/python3
"""What compare.py does, in a simulator that is not this package's: Stage's robot "erratic" in Stage's world "willow", driven by
the navigation stack's move_base with several planners. Prints a table (markdown), in which a contact is a stall of Stage.

Needs the environment of a workspace that was built against the navigation stack, stage_ros and Stage (github.com/rtv/Stage,
github.com/ros-simulation/stage_ros; in packages.ros.org ros-noetic-stage-ros), with Stage in PKG_CONFIG_PATH. No screen is needed."""
import math
import os
import re
import subprocess
import sys
import tempfile

import rospkg

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import compare  # noqa: E402

FOLDER = os.path.join(compare.FOLDER, "stage")
COMBINATIONS = ["route+steering", "network+steering", "navfn+steering", "navfn+dwa"]


def build_watch(folder):
    """Stage loads it: see stage_watch.cpp."""
    flags = subprocess.check_output(["pkg-config", "--cflags", "stage"], text=True).split()
    library = os.path.join(folder, "libstage_watch.so")
    subprocess.check_call(["g++", "-O1", "-w", "-shared", "-fPIC", os.path.join(FOLDER, "stage_watch.cpp"), "-o", library] + flags)
    return library


def write_world(path, start, library, factor, truth):
    """Stage's own world file with another start pose (x, y, yaw) and the watch."""
    source = os.path.join(rospkg.RosPack().get_path("stage_ros"), "world", "willow-erratic.world")
    with open(source) as file:
        text = file.read()
    text = text.replace('"willow-full.pgm"', '"%s"' % os.path.join(os.path.dirname(source), "willow-full.pgm"))
    robot = 'erratic( pose [ %g %g 0 %g ] ctrl "%s %g %s"' % (start[0], start[1], math.degrees(start[2]),
                                                             os.path.splitext(library)[0], factor, truth)
    text, count = re.subn(r"erratic\( pose \[[^\]]*\]", robot, text)
    if count != 1:
        raise RuntimeError("%s is not the world that this script knows" % source)
    with open(path, "w") as file:
        file.write(text)


def stalls(path):
    """How often the robot began to touch something."""
    with open(path) as file:
        stalled = [line.split()[4] == "1" for line in file if line.endswith("\n")]
    return sum(now and not before for before, now in zip([False] + stalled, stalled))


def main():
    arguments = compare.parse(doc=__doc__, combinations=COMBINATIONS, runs=os.path.join(FOLDER, "runs.yaml"), robot="erratic")
    with tempfile.TemporaryDirectory(prefix="lstm_planner_stage_") as folder:
        library = None if arguments.print_only else build_watch(folder)

        def run_in_stage(run, combination, factor, log_folder, extra):
            name = "%s_%s_%s" % (combination, run["group"].replace(" ", "_").replace(",", ""), run["name"])
            world, truth = os.path.join(folder, name + ".world"), os.path.join(log_folder, name + ".truth")
            write_world(world, run["start"], library, factor, truth)
            run = dict(run, world=["world:=" + world], origin=[0, 0, 0])  # Stage's odometry is in the frame of the world
            result = compare.run_once(run, combination, factor, log_folder, extra)
            return result if "error" in result else dict(result, contacts=stalls(truth))

        return compare.compare(arguments, run_in_stage)


if __name__ == "__main__":
    sys.exit(main())
