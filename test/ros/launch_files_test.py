#!/usr/bin/python3
"""Every launch file loads, and starts only what exists, as far as its packages are installed here."""
import glob
import os
import unittest
import unittest.mock

import roslaunch.arg_dump
import roslaunch.config
import roslaunch.core
import roslib.packages
import rospkg
import rostest
import yaml

# Drivers and viewers; their absence says nothing about the launch file.
OPTIONAL_PACKAGES = {"create_driver", "hls_lfcd_lds_driver", "rplidar_ros", "urg_node", "rviz", "move_base"}

# Debian's tf2_ros comes without its programs.
OPTIONAL_NODES = {"tf2_ros/static_transform_publisher"}


def load(name, *arguments):
    path = os.path.join(rospkg.RosPack().get_path("lstm_planner"), "launch", name)
    return roslaunch.config.load_config_default([(path, list(arguments))], None, verbose=False, assign_machines=False)


def missing_nodes(config):
    """Of the nodes whose packages are installed, those that do not exist; and the packages that are not installed."""
    missing, absent = set(), set()
    for node in config.nodes:
        try:
            if not roslib.packages.find_node(node.package, node.type):
                missing.add(node.package + "/" + node.type)
        except rospkg.ResourceNotFound:
            absent.add(node.package)
    return missing, absent


class LaunchFiles(unittest.TestCase):
    def check(self, config):
        self.assertEqual(config.config_errors, [])
        missing, absent = missing_nodes(config)
        self.assertLessEqual(missing, OPTIONAL_NODES)
        self.assertLessEqual(absent, OPTIONAL_PACKAGES)
        for name in sorted(absent | missing):
            print("SKIPPED: %s, which is not installed here" % name)

    def parameter(self, config, name):
        self.assertIn(name, config.params)
        return config.params[name].value

    def test_explains_each_argument_and_requires_only_what_has_no_default(self):
        folder = os.path.join(rospkg.RosPack().get_path("lstm_planner"), "launch")
        required = {}
        for path in glob.glob(os.path.join(folder, "*.launch")):
            with open(path, encoding="utf-8") as file:
                self.assertNotIn('default=""', file.read(), path)
            try:
                arguments = roslaunch.arg_dump.get_args([path])
            except rospkg.ResourceNotFound:  # a package for teleoperation; the file says how to get it
                continue
            for name, (doc, default) in arguments.items():
                self.assertTrue(doc, "%s, %s" % (path, name))
                if not default:  # roslaunch --ros-args lists it as required
                    required.setdefault(os.path.basename(path), set()).add(name)
        self.assertEqual(required, {"replay.launch": {"bag"}, "two_machines.launch": {"on"}})

    def test_demo_starts_only_what_exists(self):
        self.check(load("demo.launch", "rviz:=false"))
        self.check(load("demo.launch", "rviz:=true"))

    def test_demo_hands_its_arguments_on(self):
        config = load("demo.launch", "rviz:=false", "start:=[2.0, 1.0, 0.5]", "model:=/m.onnx", "result:=/r",
                      "real_time_factor:=3", "slip:=0.1")
        self.assertEqual(self.parameter(config, "/create2_stub/start"), [2.0, 1.0, 0.5])
        self.assertEqual(self.parameter(config, "/demo_runner/start"), [2.0, 1.0, 0.5])
        self.assertEqual(self.parameter(config, "/move_base/LstmGlobalPlanner/model"), "/m.onnx")
        self.assertEqual(self.parameter(config, "/demo_runner/result"), "/r")
        self.assertEqual(self.parameter(config, "/create2_stub/real_time_factor"), 3)
        self.assertGreater(self.parameter(config, "/create2_stub/command_period"), 0)
        self.assertEqual(self.parameter(config, "/create2_stub/robot/slip"), 0.1)
        self.assertTrue(self.parameter(config, "/use_sim_time"))

    def test_the_demo_draws_no_picture_if_none_is_wanted(self):
        drawn = load("demo.launch", "rviz:=false")
        self.assertEqual(self.parameter(drawn, "/demo_runner/picture"), os.environ["HOME"] + "/lstm_planner_demo.png")
        self.assertNotIn("/demo_runner/picture", load("demo.launch", "rviz:=false", "picture:=none").params)

    def test_the_real_robot_gets_our_plugins_and_plans_while_it_drives(self):
        for move_base in ("real", "standalone"):
            config = load("navigation.launch", "move_base:=" + move_base)
            self.assertEqual(self.parameter(config, "/move_base/base_global_planner"), "lstm_planner/LstmGlobalPlanner")
            self.assertEqual(self.parameter(config, "/move_base/base_local_planner"), "lstm_planner/SteeringController")
            self.assertGreater(self.parameter(config, "/move_base/planner_frequency"), 0)
            for costmap in ("global_costmap", "local_costmap"):
                self.assertTrue(self.parameter(config, "/move_base/%s/rolling_window" % costmap))
            self.assertNotIn("/use_sim_time", config.params)
        self.check(load("navigation.launch"))

    def test_starts_the_move_base_that_the_package_was_built_with(self):
        has_stack = "nav_core" in rospkg.RosPack().list()
        built = ("move_base", "move_base") if has_stack else ("lstm_planner", "standalone_move_base")
        for distribution in ("noetic", "one", "debian"):
            with unittest.mock.patch.dict(os.environ, ROS_DISTRO=distribution):
                for name in ("demo.launch", "navigation.launch", "two_machines.launch", "two_robots.launch"):
                    config = load(name, "rviz:=false", *(["on:=desktop"] if name == "two_machines.launch" else []))
                    started = {(node.package, node.type) for node in config.nodes if node.name == "move_base"}
                    self.assertEqual(started, {built}, name)

    def test_a_robot_that_already_runs_gets_nothing_but_move_base(self):
        config = load("navigation.launch", "base:=false", "laser:=false", "tf:=false", "robot:=turtlebot3_burger",
                      "scan_topic:=front", "second_scan_topic:=rear", "odom_topic:=wheels", "cmd_vel_topic:=drive", "odom_frame:=o", "base_frame:=b")
        self.assertEqual([node.name for node in config.nodes], ["move_base"])
        self.assertEqual([list(pair) for pair in config.nodes[0].remap_args], [["cmd_vel", "drive"]])
        for plugin in ("LstmGlobalPlanner", "SteeringController"):
            self.assertEqual(self.parameter(config, "/move_base/%s/scan_topic" % plugin), "front")
            self.assertEqual(self.parameter(config, "/move_base/%s/second_scan_topic" % plugin), "rear")
            self.assertEqual(self.parameter(config, "/move_base/%s/odom_topic" % plugin), "wheels")
        for costmap in ("global_costmap", "local_costmap"):
            self.assertEqual(self.parameter(config, "/move_base/%s/obstacle_layer/scan/topic" % costmap), "front")
            self.assertEqual(self.parameter(config, "/move_base/%s/global_frame" % costmap), "o")
            self.assertEqual(self.parameter(config, "/move_base/%s/robot_base_frame" % costmap), "b")

    def test_every_robot_has_one_footprint_in_all_places(self):
        folder = os.path.join(rospkg.RosPack().get_path("lstm_planner"), "config", "robots")
        names = sorted(os.path.splitext(name)[0] for name in os.listdir(folder))
        self.assertGreaterEqual(len(names), 5)
        for name in names:
            config = load("navigation.launch", "robot:=" + name)
            self.check(config)
            has_corners = self.parameter(config, "/move_base/SteeringController/footprint") != ""
            shape = "footprint" if has_corners else "footprint_radius"
            own = self.parameter(config, "/move_base/SteeringController/" + shape)
            self.assertEqual(self.parameter(config, "/move_base/LstmGlobalPlanner/shield/" + shape), own, name)
            for costmap in ("global_costmap", "local_costmap"):
                other = self.parameter(config, "/move_base/%s/%s" % (costmap, shape.replace("footprint_", "robot_")))
                self.assertEqual(other, own, name)
            if has_corners:
                self.assertEqual(self.parameter(config, "/move_base/create2_stub/robot/footprint"), own, name)
            else:
                diameter = self.parameter(config, "/move_base/create2_stub/robot/base_diameter")
                self.assertAlmostEqual(diameter, 2.0 * own, msg=name)
            margin = self.parameter(config, "/move_base/SteeringController/safety_margin")
            self.assertGreaterEqual(self.parameter(config, "/move_base/LstmGlobalPlanner/shield/tight_clearance"), margin)

    def test_no_costmap_has_an_obstacle_where_the_scanner_sees_none(self):
        # costmap_2d takes +inf for a return just before range_max (inf_is_valid), and marks those before obstacle_range.
        folder = os.path.join(rospkg.RosPack().get_path("lstm_planner"), "config", "robots")
        for name in sorted(os.path.splitext(name)[0] for name in os.listdir(folder)):
            config = load("navigation.launch", "robot:=" + name)
            sight = self.parameter(config, "/move_base/create2_stub/laser/range_max")
            for costmap in ("global_costmap", "local_costmap"):
                marked = self.parameter(config, "/move_base/%s/obstacle_layer/scan/obstacle_range" % costmap)
                self.assertLess(marked, sight, name)

    def test_move_base_goes_on_asking_when_the_scanner_is_dead(self):
        # Else it never gives the goal up.
        config = load("navigation.launch")
        for costmap in ("global_costmap", "local_costmap"):
            self.assertEqual(
                self.parameter(config, "/move_base/%s/obstacle_layer/scan/expected_update_rate" % costmap), 0.0)

    def test_move_base_stops_a_stock_local_planner_when_the_scanner_is_dead(self):
        folder = os.path.join(rospkg.RosPack().get_path("lstm_planner"), "config")
        for name in ("dwa_local_planner.yaml", "trajectory_planner.yaml"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                layer = yaml.safe_load(file)["local_costmap"]["obstacle_layer"]
            self.assertEqual(layer["scan"]["expected_update_rate"], 0.5)

    def test_rviz_draws_in_the_frame_of_the_plans(self):
        def arguments_of_rviz(*arguments):
            return [node.args for node in load("navigation.launch", "rviz:=true", *arguments).nodes
                    if node.type == "rviz"][0]
        self.assertRegex(arguments_of_rviz("odom_frame:=robot1/odom"), r"lstm_planner\.rviz -f robot1/odom$")
        self.assertRegex(arguments_of_rviz(), r"lstm_planner\.rviz *$")

    def test_several_robots_have_namespaces_and_frames_of_their_own(self):
        config = load("two_robots.launch", "rviz:=true", "start2:=[3.0, 3.0, 0.0]")
        self.check(config)
        for robot, other in (("robot1", "robot2"), ("robot2", "robot1")):
            self.assertEqual(self.parameter(config, "/%s/create2_stub/odom_frame" % robot), robot + "/odom")
            self.assertEqual(self.parameter(config, "/%s/create2_stub/laser/frame" % robot), robot + "/laser")
            self.assertEqual(self.parameter(config, "/%s/create2_stub/others" % robot),
                             "/%s/create2_stub/ground_truth" % other)
            self.assertEqual(self.parameter(config, "/%s/move_base/global_costmap/global_frame" % robot),
                             robot + "/odom")
        self.assertEqual(self.parameter(config, "/robot2/create2_stub/start"), [3.0, 3.0, 0.0])

    def test_two_machines_share_what_navigation_starts(self):
        whole = {node.name for node in load("navigation.launch").nodes}
        robot, desktop = (load("two_machines.launch", "on:=" + machine) for machine in ("robot", "desktop"))
        self.check(robot)
        self.check(desktop)
        self.assertEqual({node.name for node in desktop.nodes}, {"move_base"})
        self.assertEqual({node.name for node in robot.nodes}, whole - {"move_base"})
        with self.assertRaisesRegex(Exception, "on is laptop, expected robot or desktop"):
            load("two_machines.launch", "on:=laptop")

    def test_two_machines_take_another_scanner_in_another_place(self):
        robot = load("two_machines.launch", "on:=robot", "laser:=rplidar_ros", "laser_x:=0.1", "laser_yaw:=3.14")
        desktop = load("two_machines.launch", "on:=desktop", "robot:=create2_rplidar")
        self.assertIn("0.1 0.0 0.125 3.14 0 0.0 base_link laser", {node.args for node in robot.nodes})
        self.assertEqual(self.parameter(desktop, "/move_base/SteeringController/safety_margin"), 0.05)

    def test_a_serial_scanner_takes_the_place_of_the_one_with_an_address(self):
        config = load("navigation.launch", "laser_port:=/dev/ttyACM0")
        self.assertEqual(self.parameter(config, "/urg_node/serial_port"), "/dev/ttyACM0")
        self.assertNotIn("/urg_node/ip_address", config.params)

    def test_another_scanner_is_started_by_its_drivers_name(self):
        for driver, name, port in (("rplidar_ros", "rplidar_node", "serial_port"),
                                   ("hls_lfcd_lds_driver", "hlds_laser_publisher", "port")):
            config = load("navigation.launch", "laser:=" + driver, "laser_port:=/dev/ttyUSB3")
            self.check(config)
            self.assertIn(driver, {node.package for node in config.nodes})
            self.assertNotIn("urg_node", {node.package for node in config.nodes})
            self.assertEqual(self.parameter(config, "/%s/%s" % (name, port)), "/dev/ttyUSB3")
            self.assertEqual(self.parameter(config, "/%s/frame_id" % name), "laser")
        with self.assertRaisesRegex(Exception, "laser is velodyne, expected true, false, urg_node"):
            load("navigation.launch", "laser:=velodyne")

    def test_a_scanner_without_a_given_port_gets_the_default_of_its_driver(self):
        for driver, parameter in (("rplidar_ros", "/rplidar_node/serial_port"),
                                  ("hls_lfcd_lds_driver", "/hlds_laser_publisher/port")):
            config = load("navigation.launch", "laser:=" + driver)
            self.assertEqual(self.parameter(config, parameter), "/dev/ttyUSB1")
        config = load("navigation.launch")
        self.assertEqual(self.parameter(config, "/urg_node/ip_address"), "192.168.0.10")
        self.assertNotIn("/urg_node/serial_port", config.params)

    def test_no_node_gets_the_text_that_means_not_given(self):
        # A driver would take "default" for a port, a topic or a file.
        for name, *arguments in (["demo.launch"], ["two_robots.launch"], ["replay.launch", "bag:=/drive.bag"],
                                 ["two_machines.launch", "on:=desktop"], ["two_machines.launch", "on:=robot"],
                                 ["navigation.launch"], ["navigation.launch", "laser:=rplidar_ros"],
                                 ["navigation.launch", "laser:=hls_lfcd_lds_driver"], ["advice.launch", "teleop:=none"],
                                 ["advice.launch", "teleop:=scripted", "map:=/m.yaml"],
                                 ["record_dataset.launch", "teleop:=none"],
                                 ["record_dataset.launch", "teleop:=scripted", "map:=/m.yaml"]):
            config = load(name, *arguments)
            for parameter in config.params.values():
                self.assertNotIn(parameter.value, ("default", "none"), "%s: %s" % (name, parameter.key))
            for node in config.nodes:
                self.assertNotRegex(node.args or "", r"\b(default|none)\b", "%s: %s" % (name, node.name))

    def test_recording_hands_its_arguments_on(self):
        config = load("record_dataset.launch", "teleop:=none", "rviz:=false", "output:=/o.sqlite", "scan:=base_scan",
                      "odom:=odometry/filtered", "seed:=7")
        self.assertEqual(self.parameter(config, "/dataset_recorder/output"), "/o.sqlite")
        self.assertEqual(self.parameter(config, "/dataset_recorder/LstmGlobalPlanner/scan_topic"), "base_scan")
        self.assertEqual(self.parameter(config, "/dataset_recorder/LstmGlobalPlanner/odom_topic"),
                         "odometry/filtered")
        self.assertEqual(self.parameter(config, "/dataset_recorder/seed"), 7)
        self.assertEqual(self.parameter(config, "/dataset_recorder/waypoints"), [])
        self.check(config)

    def test_recording_drives_the_simulated_robot_where_there_is_a_map(self):
        config = load("record_dataset.launch", "teleop:=scripted", "rviz:=false", "map:=/m.yaml")
        self.assertEqual({node.type for node in config.nodes},
                         {"create2_stub", "dataset_recorder", "scripted_teleoperator"})
        self.assertEqual(self.parameter(config, "/scripted_teleoperator/map"), "/m.yaml")
        self.assertTrue(self.parameter(config, "/use_sim_time"))
        self.check(config)

    def test_a_driver_that_nobody_knows_is_refused(self):
        for name in ("record_dataset.launch", "advice.launch"):
            with self.assertRaisesRegex(Exception, "teleop is keybord, expected keyboard, joystick, scripted or none"):
                load(name, "teleop:=keybord", "rviz:=false")
            with self.assertRaisesRegex(Exception, "teleop is scripted and there is no map, expected map:=FILE"):
                load(name, "teleop:=scripted", "rviz:=false")

    def test_recording_takes_its_waypoints_from_a_file(self):
        waypoints = os.path.join(rospkg.RosPack().get_path("lstm_planner"), "config", "demo_waypoints.yaml")
        config = load("record_dataset.launch", "teleop:=none", "rviz:=false", "waypoints:=" + waypoints)
        self.assertGreaterEqual(len(self.parameter(config, "/dataset_recorder/waypoints")), 2)
        self.assertEqual(self.parameter(config, "/dataset_recorder/waypoint_frame"), "map")
        self.assertNotIn("/use_sim_time", config.params)

    def test_recording_leaves_a_robot_alone_that_runs_already(self):
        config = load("record_dataset.launch", "teleop:=none", "rviz:=false", "base:=false", "laser:=false",
                      "tf:=false", "robot:=jackal")
        self.assertEqual({node.type for node in config.nodes}, {"dataset_recorder"})
        self.assertEqual(self.parameter(config, "/dataset_recorder/LstmGlobalPlanner/scan_topic"), "front/scan")
        self.check(config)

    def test_advice_takes_the_place_of_the_recorder_beside_the_same_robot_and_driver(self):
        config = load("advice.launch", "teleop:=scripted", "rviz:=true", "map:=/m.yaml", "model:=/m.onnx",
                      "waypoints:=[[6.5, 1.25]]", "decisions:=/d.csv", "start:=[2.0, 1.0, 0.5]")
        self.check(config)
        self.assertEqual({node.type for node in config.nodes},
                         {"create2_stub", "drive_advice", "scripted_teleoperator", "rviz"})
        self.assertEqual(self.parameter(config, "/drive_advice/LstmGlobalPlanner/model"), "/m.onnx")
        self.assertEqual(self.parameter(config, "/drive_advice/LstmGlobalPlanner/leader"), "network")
        self.assertEqual(self.parameter(config, "/drive_advice/decisions"), "/d.csv")
        self.assertEqual(self.parameter(config, "/scripted_teleoperator/waypoints"), [[6.5, 1.25]])
        self.assertEqual(self.parameter(config, "/create2_stub/start"), [2.0, 1.0, 0.5])
        self.assertTrue(self.parameter(config, "/use_sim_time"))

    def test_advice_for_another_robot_that_runs_already(self):
        config = load("advice.launch", "teleop:=none", "rviz:=false", "base:=false", "laser:=false", "tf:=false",
                      "robot:=turtlebot3_burger", "scan:=front", "odom:=wheels")
        self.assertEqual([node.type for node in config.nodes], ["drive_advice"])
        self.assertEqual(self.parameter(config, "/drive_advice/LstmGlobalPlanner/shield/footprint_radius"), 0.149)
        self.assertEqual(self.parameter(config, "/drive_advice/LstmGlobalPlanner/scan_topic"), "front")
        self.assertEqual(self.parameter(config, "/drive_advice/LstmGlobalPlanner/odom_topic"), "wheels")
        self.assertNotIn("/use_sim_time", config.params)

    def test_advice_listens_to_the_topics_of_the_robots_file_unless_others_are_given(self):
        config = load("advice.launch", "teleop:=none", "rviz:=false", "robot:=jackal")
        self.assertEqual(self.parameter(config, "/drive_advice/LstmGlobalPlanner/scan_topic"), "front/scan")
        self.assertEqual(self.parameter(config, "/drive_advice/LstmGlobalPlanner/odom_topic"), "odometry/filtered")

    def test_advice_beside_the_real_robot_starts_its_drivers(self):
        real = {node.type for node in load("advice.launch", "teleop:=none", "rviz:=false").nodes}
        self.assertEqual(real, {"drive_advice", "create_driver", "urg_node", "static_transform_publisher"})

    def test_a_replay_hands_its_arguments_on_and_decides_as_the_planner(self):
        config = load("replay.launch", "bag:=/drive.bag", "rviz:=true", "rate:=0", "model:=/m.onnx",
                      "mount:=[0.1, 0.0, 0.5]", "hindsight:=true", "goal_topic:=/goal", "robot:=turtlebot3_burger")
        self.check(config)
        self.assertEqual(self.parameter(config, "/bag_replay/bag"), "/drive.bag")
        self.assertEqual(self.parameter(config, "/bag_replay/rate"), 0)
        self.assertEqual(self.parameter(config, "/bag_replay/LstmGlobalPlanner/model"), "/m.onnx")
        self.assertEqual(self.parameter(config, "/bag_replay/mount"), [0.1, 0.0, 0.5])
        self.assertEqual(self.parameter(config, "/bag_replay/goal_topic"), "/goal")
        self.assertTrue(self.parameter(config, "/bag_replay/hindsight"))
        self.assertTrue(self.parameter(config, "/bag_replay/stay"))
        self.assertEqual(self.parameter(config, "/bag_replay/LstmGlobalPlanner/step/length"), 0.4)
        self.assertEqual(self.parameter(config, "/bag_replay/LstmGlobalPlanner/shield/footprint_radius"), 0.149)
        self.assertTrue(self.parameter(config, "/use_sim_time"))


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "launch_files", LaunchFiles)
