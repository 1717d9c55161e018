#!/usr/bin/python3
"""The tables of topics, services, actions and frames in launch/README.md say what the running nodes have, and
config/diagnostics.yaml sorts what they publish on /diagnostics."""
import collections
import os
import re
import time
import unittest

import rosgraph
import rospkg
import rospy
import rosservice
import rostest
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from tf2_msgs.msg import TFMessage

PATIENCE = 30.0  # s
NAMESPACES = {"bag_replay": "/replay"}  # of the nodes; what is global for them is remapped into it
NODES = ("bag_replay", "create2_stub", "dataset_recorder", "demo_runner", "drive_advice", "move_base", "scripted_teleoperator")
ALL_NODES_HAVE = re.compile(r"/rosout|/(get_loggers|set_logger_level)$")
BY_CLIENT = {"goal": "publishes", "cancel": "publishes", "status": "subscribes", "feedback": "subscribes",
             "result": "subscribes"}

Entry = collections.namedtuple("Entry", "verb name type")


def open_in_package(*names):
    return open(os.path.join(rospkg.RosPack().get_path("lstm_planner"), *names), encoding="utf-8")


def tables_of_the_page():
    """(cells of the head, rows of cells) of each table."""
    tables, rows = [], []
    with open_in_package("launch", "README.md") as page:
        for line in [*page, ""]:
            if line.startswith("|"):
                rows.append([cell.strip() for cell in line.strip().strip("|").split("|")])
            elif rows:
                tables.append((rows[0], rows[2:]))
                rows = []
    return tables


def is_installed(message_type):
    try:
        rospkg.RosPack().get_path(message_type.split("/")[0])
        return True
    except rospkg.ResourceNotFound:
        return False


def topics_of_an_action(verb, name, action):
    """An action has five topics; the client publishes what the server subscribes."""
    for topic, of_client in BY_CLIENT.items():
        of_server = {"publishes": "subscribes", "subscribes": "publishes"}[of_client]
        message = {"cancel": "actionlib_msgs/GoalID", "status": "actionlib_msgs/GoalStatusArray"}.get(
            topic, action + topic.capitalize())
        yield Entry(of_server if verb == "action" else of_client, name + "/" + topic, message)


def told(node):
    """What the page says of a node. Types of packages that are not installed here are left out; * is any type."""
    namespace = NAMESPACES.get(node, "")
    for head, rows in tables_of_the_page():
        if head[1:3] != ["name", "type"] or head[0].split(",")[0] != node:
            continue
        for verb, names, message_type, *_ in rows:
            if message_type != "*" and not is_installed(message_type):
                continue
            for name in re.findall(r"`([^`]+)`", names):
                name = name.replace("~", "/%s/" % node) if name.startswith("~") else name
                full = namespace + "/" + name.lstrip("/")
                if verb in ("action", "calls"):
                    yield from topics_of_an_action(verb, full, message_type)
                else:
                    yield Entry(verb, full, message_type)


def running(node):
    """What the node has."""
    full = NAMESPACES.get(node, "") + "/" + node
    master = rosgraph.Master("/interfaces")
    types = dict(master.getTopicTypes())  # of a topic that is announced only now none is known yet
    for verb, group in zip(("publishes", "subscribes", "serves"), master.getSystemState()):
        for name, owners in group:
            if full not in owners or ALL_NODES_HAVE.search(name) or (verb == "subscribes" and name.endswith("/clock")):
                continue
            yield Entry(verb, name, rosservice.get_service_type(name) if verb == "serves" else types.get(name, "*"))


def parts_of_names(analyzers):
    """For each group of diagnostics: the parts, one of which the name of each of its statuses contains."""
    for analyzer in analyzers.values():
        if "analyzers" in analyzer:
            yield from parts_of_names(analyzer["analyzers"])
        else:
            parts = analyzer["contains"]
            yield [parts] if isinstance(parts, str) else parts


class Interfaces(unittest.TestCase):
    def check(self, node):
        expected = set(told(node))
        self.assertTrue(expected)
        deadline = time.monotonic() + PATIENCE
        while not expected <= set(running(node)) and time.monotonic() < deadline:
            time.sleep(0.1)
        self.maxDiff = None
        self.assertEqual(sorted(running(node)), sorted(expected))

    def test_frames(self):
        published = set()

        def hear(message):
            if message._connection_header["callerid"] == "/create2_stub":
                published.update((one.header.frame_id, one.child_frame_id) for one in message.transforms)

        rospy.init_node("interfaces")
        expected = {tuple(re.findall(r"`([^`]+)`", transform)) for head, rows in tables_of_the_page()
                    if head[0] == "transform" for transform, publishers, *_ in rows if "create2_stub" in publishers}
        subscribers = [rospy.Subscriber(topic, TFMessage, hear) for topic in ("/tf", "/tf_static")]
        deadline = time.monotonic() + PATIENCE
        while not expected <= published and time.monotonic() < deadline:
            time.sleep(0.1)
        for subscriber in subscribers:
            subscriber.unregister()
        self.assertEqual(published, expected)

    def test_each_diagnostic_status_has_one_group(self):
        names = set()
        nodes = {"create2_stub", "dataset_recorder", "move_base"}
        rospy.init_node("interfaces")
        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray,
                                      lambda message: names.update(status.name for status in message.status))
        deadline = time.monotonic() + PATIENCE
        while not nodes <= {name.split(":")[0] for name in set(names)} and time.monotonic() < deadline:
            time.sleep(0.1)
        subscriber.unregister()
        self.assertEqual({name.split(":")[0] for name in names}, nodes)
        with open_in_package("config", "diagnostics.yaml") as file:
            groups = list(parts_of_names(yaml.safe_load(file)["analyzers"]))
        for name in names:
            self.assertEqual(sum(any(part in name for part in parts) for parts in groups), 1, name)


for one in NODES:
    setattr(Interfaces, "test_" + one, lambda self, node=one: self.check(node))


if __name__ == "__main__":
    rostest.rosrun("lstm_planner", "interfaces", Interfaces)
