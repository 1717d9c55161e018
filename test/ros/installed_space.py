#!/usr/bin/python3
"""The package as `make install` leaves it, moved to another folder and run without the workspace that it was built in."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from processes import free_port  # noqa: E402

SOURCES = os.path.realpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", ".."))
LIMIT = 400  # s for the demo; it takes half a minute on an idle computer


def build_folder():
    """As catkin_make has it, beside the devel space."""
    return os.path.join(os.path.dirname(os.path.realpath(os.environ["CMAKE_PREFIX_PATH"].split(":")[0])), "build")


class InstalledSpace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not os.path.exists(os.path.join(build_folder(), "cmake_install.cmake")):
            raise unittest.SkipTest("there is no build folder of catkin_make")
        cls.folder = tempfile.TemporaryDirectory(prefix="lstm_planner_")
        # Catkin's setup files go to the prefix of the configuration, whatever prefix is given here.
        staged = os.path.join(cls.folder.name, "staged")
        subprocess.run(["cmake", "-P", "cmake_install.cmake"], cwd=build_folder(), check=True,
                       env=dict(os.environ, DESTDIR=staged), stdout=subprocess.DEVNULL)
        installed = next(folder for folder, _, files in os.walk(staged) if "setup.bash" in files)
        cls.moved = os.path.join(cls.folder.name, "moved")
        shutil.move(installed, cls.moved)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_there(self, command):
        """What a shell prints that knows nothing but the moved folder and the distribution's ROS."""
        environment = {name: os.environ[name] for name in ("PATH", "LANG", "ROS_HOSTNAME") if name in os.environ}
        environment.update(HOME=self.folder.name, ROS_HOME=os.path.join(self.folder.name, "ros"),
                           ROS_MASTER_URI="http://localhost:%d" % free_port())
        distribution = "/opt/ros/%s/setup.bash" % os.environ.get("ROS_DISTRO", "")
        underlay = "source %s; " % distribution if os.path.exists(distribution) else ""
        done = subprocess.run(["bash", "-c", underlay + "source '%s/setup.bash'; %s" % (self.moved, command)],
                              env=environment, cwd=self.folder.name, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=LIMIT, check=False)
        print(done.stdout, flush=True)
        return done.stdout

    def test_the_package_is_found_where_it_was_moved_to(self):
        self.assertIn(os.path.join(self.moved, "share", "lstm_planner"), self.run_there("rospack find lstm_planner"))

    def test_the_tool_finds_the_shipped_models(self):
        self.assertIn("a model for the robot that can be used",
                      self.run_there("lstm_planner model check models/create2_lstm.onnx"))

    def run_without_ros(self, command):
        """What a command prints that does not know that there is ROS; it must succeed."""
        done = subprocess.run(["bash", "-ec", command], env={"PATH": os.environ["PATH"]}, cwd=self.folder.name,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=LIMIT, check=False)
        print(done.stdout, flush=True)
        self.assertEqual(done.returncode, 0)
        return done.stdout

    def test_a_program_without_ros_is_built_with_it_and_drives(self):
        printed = self.run_without_ros(
            "cmake -S '%s/test/consumer' -B consumer -Dlstm_planner_DIR='%s/share/lstm_planner/cmake/without_catkin'; "
            "cmake --build consumer; consumer/consumer '%s/share/lstm_planner/models/create2_lstm.onnx'"
            % (SOURCES, self.moved, self.moved))
        self.assertIn("degrees (network), a plan of", printed)

    def test_the_package_is_configured_without_ros(self):
        self.run_without_ros("cmake -S '%s' -B without_ros -DLSTM_PLANNER_WITH_ROS=OFF" % SOURCES)
        with open(os.path.join(self.folder.name, "without_ros", "CMakeCache.txt"), encoding="utf-8") as cache:
            self.assertNotIn("catkin_DIR", cache.read())

    def test_the_demo_reaches_every_goal(self):
        result = os.path.join(self.folder.name, "result")
        self.run_there("roslaunch lstm_planner demo.launch rviz:=false picture:=none real_time_factor:=6 result:=%s" % result)
        with open(result, encoding="utf-8") as file:
            self.assertEqual(file.readline().strip(), "0")


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "installed_space", InstalledSpace)
