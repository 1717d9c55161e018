"""What tests that start processes share."""
import os
import signal
import socket
import subprocess
import time

import rospkg


def package_file(*path):
    return os.path.join(rospkg.RosPack().get_path("lstm_planner"), *path)


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def eventually(condition, patience=60.0):
    """Whether it comes to hold within so many s of the computer's clock."""
    deadline = time.monotonic() + patience
    while time.monotonic() < deadline:
        if condition():
            return True
        time.sleep(0.005)
    return condition()


def end(process, patience=30.0):
    """Ctrl-C, and whatever it takes if that is not heard."""
    for number in (signal.SIGINT, signal.SIGKILL):
        if process.poll() is None:
            process.send_signal(number)
            try:
                process.wait(patience)
            except subprocess.TimeoutExpired:
                pass
