#!/usr/bin/python3
"""launch/demo.sh as a user runs it, without what takes minutes: nothing is installed and nothing is compiled.

Shell functions stand in for dpkg-query, which says that everything is installed, and for catkin_make; the workspace is
a new one whose devel folder is the one that this test was built in.
"""
import os
import subprocess
import sys
import tempfile
import unittest

import rospkg
import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from png_picture import coloured_pixels  # noqa: E402

NEAR = "frame: map\nstart: [1.5, 2.5, 1.57]\ntime_limit: 60.0\ngoals:\n  - {name: near, x: 1.5, y: 3.5, yaw: 0.0}\n"
IN_THE_BOX = NEAR.replace("x: 1.5, y: 3.5", "x: 2.85, y: 3.43").replace("time_limit: 60.0", "time_limit: 5.0")

ALL_INSTALLED = "() { local name; for name; do case $name in -*) ;; *) echo \"installed $name\" ;; esac; done; }"
BUILDS = "() { echo \"$*\" >\"$LSTM_PLANNER_WS/catkin_make_arguments\"; }"
FAILS = "() { echo 'main.cpp:1:1: error: something is wrong'; return 1; }"


class DemoScript(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lstm_planner_")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.workspace = os.path.join(self.folder, "workspace")
        os.makedirs(self.workspace)
        os.symlink(os.environ["CMAKE_PREFIX_PATH"].split(":")[0], os.path.join(self.workspace, "devel"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def demo(self, *arguments, catkin_make=BUILDS):
        """Exit status of the script, and what it prints."""
        script = os.path.join(os.path.realpath(rospkg.RosPack().get_path("lstm_planner")), "launch", "demo.sh")
        environment = dict(os.environ, LSTM_PLANNER_WS=self.workspace, HOME=self.folder)
        environment.pop("DISPLAY", None)
        environment["BASH_FUNC_dpkg-query%%"] = ALL_INSTALLED
        environment["BASH_FUNC_catkin_make%%"] = catkin_make
        done = subprocess.run(["bash", script, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False, env=environment, cwd=self.folder)
        print(done.stdout, flush=True)
        return done.returncode, done.stdout

    def write_goals(self, text):
        with open(self.path("goals.yaml"), "w", encoding="utf-8") as goals:
            goals.write(text)

    def test_it_builds_drives_draws_and_says_that_all_went_well(self):
        self.write_goals(NEAR)
        status, output = self.demo("goals:=goals.yaml", "picture:=drive.png")
        self.assertEqual(status, 0)
        self.assertIn("every goal was reached and nothing was touched", output)
        with open(os.path.join(self.workspace, "catkin_make_arguments"), encoding="utf-8") as arguments:
            self.assertIn("-DCMAKE_BUILD_TYPE=Release", arguments.read())
        coloured, width = coloured_pixels(self.path("drive.png"))
        self.assertGreater(coloured, width // 2, "less than a line across half of the picture")

    def test_a_goal_that_is_missed_is_a_failure(self):
        self.write_goals(IN_THE_BOX)
        status, output = self.demo("goals:=goals.yaml", "picture:=none")
        self.assertEqual(status, 1)
        self.assertIn("the demo did not succeed", output)
        self.assertNotIn("every goal was reached", output)
        self.assertEqual([name for name in os.listdir(self.folder) if name.endswith(".png")], [], "the folder is HOME, too")

    def test_build_only_does_not_drive(self):
        status, output = self.demo("--build-only")
        self.assertEqual(status, 0)
        self.assertNotIn("demo:", output)
        self.assertTrue(os.path.islink(os.path.join(self.workspace, "src", "lstm_planner")))

    def test_an_optional_package_that_was_installed_since_is_looked_for(self):
        self.demo("--build-only")
        with open(os.path.join(self.workspace, "catkin_make_arguments"), encoding="utf-8") as arguments:
            self.assertIn("--force-cmake", arguments.read().split())

    def test_a_failed_build_ends_it_with_its_errors(self):
        status, output = self.demo(catkin_make=FAILS)
        self.assertEqual(status, 1)
        self.assertIn("main.cpp:1:1: error: something is wrong", output)
        self.assertIn("the build failed", output)
        self.assertNotIn("demo:", output)

    def test_arguments_that_mean_nothing_are_refused_before_anything_is_done(self):
        for argument, complaint in (("gaols:=x", "demo.launch has no argument 'gaols'"),
                                    ("picture:=", "the argument picture:= has no value"),
                                    ("--fast", "unknown argument '--fast'")):
            status, output = self.demo(argument, catkin_make=FAILS)
            self.assertEqual(status, 1)
            self.assertIn(complaint, output)
            self.assertNotIn("something is wrong", output)

    def test_help_does_nothing_else(self):
        status, output = self.demo("--help", catkin_make=FAILS)
        self.assertEqual(status, 0)
        self.assertIn("Usage: bash launch/demo.sh", output)
        self.assertFalse(os.path.exists(os.path.join(self.workspace, "src")))


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "demo_script", DemoScript)
