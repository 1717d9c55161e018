#!/usr/bin/python3
"""Drives the simulated robot through the same worlds with several planners in the navigation stack's move_base, and
prints what came of it as a table (markdown). Every run has a ROS master of its own, so several can go on at a time.

Needs the environment of a workspace that was built against the navigation stack."""
import argparse
import json
import os
import queue
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

import yaml

FOLDER = os.path.dirname(os.path.realpath(__file__))
PACKAGE = os.path.realpath(os.path.join(FOLDER, "..", "..", ".."))
SHARED = os.environ.get("LSTM_PLANNER_SHARED", os.path.join(PACKAGE, "..", "shared"))

GLOBAL_PLANNERS = {  # name in a combination: plugin, arguments of the launch file that make it what it is
    "network": ("lstm_planner/LstmGlobalPlanner", {"leader": "network"}),
    "route": ("lstm_planner/LstmGlobalPlanner", {"leader": "route"}),  # the remembered path, without the network
    "navfn": ("navfn/NavfnROS", {}),
    "global_planner": ("global_planner/GlobalPlanner", {}),
}
LOCAL_PLANNERS = {
    "steering": "lstm_planner/SteeringController",
    "dwa": "dwa_local_planner/DWAPlannerROS",
    "trajectory": "base_local_planner/TrajectoryPlannerROS",
}
COMBINATIONS = ["network+steering", "route+steering", "network+dwa", "route+dwa", "network+trajectory",
                "route+trajectory", "navfn+dwa", "navfn+trajectory", "global_planner+dwa", "global_planner+trajectory"]

STARTUP = 120.0  # s of the computer's clock beside the driving
ATTEMPTS = 3  # at a run that ends without a result: on a busy machine ROS's master may come too late
SLOWEST = 0.2  # simulated seconds in a second; slower is taken for a hang


def find_file(name):
    """The path of a file of this package or of the shared data, None where there is none."""
    for folder in (PACKAGE, SHARED):
        path = os.path.realpath(os.path.join(folder, name))
        if os.path.exists(path):
            return path
    return None


def load_runs(path):
    """One dictionary a run; those whose files are missing are left out, with a line that says so."""
    with open(path) as file:
        groups = yaml.safe_load(file)
    runs = []
    for group in groups:
        kind = next((kind for kind in ("circles", "map") if kind in group), None)  # None: the simulator has its own world
        file = kind and find_file(group[kind])
        if kind and file is None:
            print("SKIPPED: %s, there is no %s" % (group["name"], group[kind]), file=sys.stderr)
            continue
        common = {key: group[key] for key in ("radius", "time_limit")}
        common.update(group=group["name"], pass_by=group.get("pass_by", False), world=["%s:=%s" % (kind, file)] if kind else [])
        if kind == "circles":
            for world in group["worlds"]:
                runs.append(dict(common, name=str(world), start=group["start"], goal=group["goal"],
                                 world=common["world"] + ["circle_world:=%d" % world]))
        else:
            starts = [group["start"]] + group["goals"]
            for number, (start, goal) in enumerate(zip(starts, group["goals"]), 1):
                runs.append(dict(common, name=str(number), start=start, goal=goal[:2]))
    return runs


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def stop(process, patience=20.0):
    """As Ctrl-C would; True when nobody had to be killed."""
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(patience)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return False
    return True


def run_once(run, combination, real_time_factor, log_folder, extra=()):
    """The result of drive_to_goal.py, or {"error": reason}."""
    global_planner, local_planner = combination.split("+")
    plugin, settings = GLOBAL_PLANNERS[global_planner]
    home = tempfile.mkdtemp(prefix="lstm_planner_compare_")
    port = free_port()
    environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % port, ROS_HOME=home, ROS_HOSTNAME="localhost")
    environment.pop("ROS_LOG_DIR", None)
    launch_command = ["roslaunch", "-p", str(port), os.path.join(FOLDER, "navigation_stack.launch"),
                      "global_planner:=" + plugin,
                      "local_planner:=" + LOCAL_PLANNERS[local_planner],
                      "real_time_factor:=%g" % real_time_factor, "start:=%s" % run["start"]] + run["world"] + list(extra)
    launch_command += ["%s:=%s" % setting for setting in settings.items()]
    driver_command = ["/usr/bin/python3", os.path.join(FOLDER, "drive_to_goal.py"), "--radius", str(run["radius"]),
                      "--time-limit", str(run["time_limit"]), "--start"]
    driver_command += [str(value) for value in run.get("origin", run["start"])]
    driver_command += ["--goal"] + [str(value) for value in run["goal"]] + (["--pass-by"] if run["pass_by"] else [])
    log_path = os.path.join(log_folder, "%s_%s_%s.log" % (combination, run["group"].replace(" ", "_"), run["name"]))
    with open(log_path, "w") as log:
        launch = subprocess.Popen(launch_command, env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                  start_new_session=True)
        driver = subprocess.Popen(driver_command, env=environment, stdout=subprocess.PIPE, stderr=log, text=True,
                                  start_new_session=True)
        deadline = time.monotonic() + STARTUP + run["time_limit"] / SLOWEST
        while driver.poll() is None and launch.poll() is None and time.monotonic() < deadline:
            time.sleep(0.1)
        result = {"error": "roslaunch ended" if launch.poll() is not None else "no result, see %s" % log_path}
        if driver.poll() == 0:
            result = json.loads(driver.stdout.read().strip().splitlines()[-1])
        stop(driver)
        result["clean"] = stop(launch)
    shutil.rmtree(home, ignore_errors=True)
    return dict(result, combination=combination, group=run["group"], run=run["name"])


def run_all(runs, combinations, arguments, extra=(), run_one=run_once):
    """All results, those in arguments.results from earlier included; it grows line by line."""
    results = []
    if arguments.results and os.path.exists(arguments.results):
        with open(arguments.results) as file:
            results = [json.loads(line) for line in file]
    done = {(result["combination"], result["group"], result["run"]) for result in results}
    tasks = queue.Queue()
    for combination in combinations:
        for run in runs:
            if (combination, run["group"], run["name"]) not in done:
                tasks.put((combination, run))
    os.makedirs(arguments.logs, exist_ok=True)
    lock = threading.Lock()

    def work():
        while True:
            try:
                combination, run = tasks.get_nowait()
            except queue.Empty:
                return
            begin = time.monotonic()
            for _ in range(ATTEMPTS):
                result = run_one(run, combination, arguments.real_time_factor, arguments.logs, extra)
                if "error" not in result:
                    break
            result["wall"] = time.monotonic() - begin
            with lock:
                results.append(result)
                if "error" not in result and arguments.results:
                    with open(arguments.results, "a") as file:
                        file.write(json.dumps(result) + "\n")
                print(describe(result), file=sys.stderr, flush=True)

    workers = [threading.Thread(target=work) for _ in range(arguments.jobs)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    return results


def describe(result):
    where = "%s, %s %s: " % (result["combination"], result["group"], result["run"])
    if "error" in result:
        return where + "error: " + result["error"]
    outcome = "arrived" if result["arrived"] else "%s, %.1f m left" % (result["text"], result["remaining"])
    return where + "%s after %.1f s and %.1f m, %d contacts (%.0f s of the computer's)" % (
        outcome, result["time"], result["path"], result["contacts"], result["wall"])


def mean(values):
    return sum(values) / len(values) if values else float("nan")


def summary(results):
    arrived = [result for result in results if result["arrived"]]
    calls = sum(result["calls"] for result in results)
    return {
        "arrived": len(arrived),
        "runs": len(results),
        "early": sum(result["early"] for result in results),
        "contacts": sum(result["contacts"] for result in results),
        "time": mean([result["time"] for result in arrived]),
        "path": mean([result["path"] for result in arrived]),
        "calls": calls / max(1, len(results)),
        "cpu_ms": 1e3 * sum(result["cpu"] for result in results) / max(1.0, calls),
    }


def describe_planner(name):
    plugin, settings = GLOBAL_PLANNERS[name]
    return ", ".join([plugin.split("/")[-1]] + ["%s: %s" % setting for setting in settings.items()])


def table(results, groups, combinations):
    """Markdown; times and paths are means over the runs that arrived."""
    lines = ["| where | global planner | local planner | arrived | contacts | time, s | path, m | calls a run | CPU a call, ms |",
             "|---|---|---|---|---|---|---|---|---|"]
    for group in groups:
        for combination in combinations:
            chosen = [result for result in results if result["group"] == group
                      and result["combination"] == combination and "error" not in result]
            if not chosen:
                continue
            row = summary(chosen)
            global_planner, local_planner = combination.split("+")
            early = " (%d early)" % row["early"] if row["early"] else ""
            lines.append("| %s | %s | %s | %d / %d%s | %d | %.1f | %.1f | %.0f | %.2f |" % (
                group, describe_planner(global_planner), LOCAL_PLANNERS[local_planner].split("/")[-1],
                row["arrived"], row["runs"], early, row["contacts"], row["time"], row["path"], row["calls"],
                row["cpu_ms"]))
    return "\n".join(lines)


def parse(argv=None, doc=__doc__, combinations=COMBINATIONS, runs=os.path.join(FOLDER, "runs.yaml"), robot=None):
    """The last three are defaults."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--combinations", nargs="+", default=combinations, metavar="GLOBAL+LOCAL",
                        help="of %s + %s; default: %s" % (", ".join(GLOBAL_PLANNERS), ", ".join(LOCAL_PLANNERS),
                                                          " ".join(combinations)))
    parser.add_argument("--runs", default=runs, help="default: " + runs)
    parser.add_argument("--only", nargs="+", metavar="GROUP", help="these of its groups")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time")
    parser.add_argument("--seed", type=int, default=1, help="of the simulated noise and slip; default 1")
    parser.add_argument("--real-time-factor", type=float, default=4.0,
                        help="simulated seconds in a second at most; default 4")
    parser.add_argument("--results", help="file to which results are added; runs that it holds are not run again")
    parser.add_argument("--logs", default=os.path.join(tempfile.gettempdir(), "lstm_planner_compare"),
                        help="folder of the runs' output")
    parser.add_argument("--model", help="ONNX file of our planner's network; default: the planner's own")
    parser.add_argument("--robot", default=robot, help="a file of config/robots (without .yaml), for SteeringController; default: %s"
                        % (robot or "Create 2 with a Hokuyo"))
    parser.add_argument("--print-only", action="store_true", help="only the table of what the results file holds")
    arguments = parser.parse_args(argv)
    for combination in arguments.combinations:
        names = combination.split("+")
        if len(names) != 2 or names[0] not in GLOBAL_PLANNERS or names[1] not in LOCAL_PLANNERS:
            parser.error("'%s' is no combination; expected for example navfn+dwa" % combination)
    return arguments


def compare(arguments, run_one=run_once):
    """Prints the table; 1 where a run has no result."""
    runs = load_runs(arguments.runs)
    if arguments.only:
        runs = [run for run in runs if run["group"] in arguments.only]
    extra = ["seed:=%d" % arguments.seed]
    extra += ["model:=" + os.path.abspath(arguments.model)] if arguments.model else []
    extra += ["robot:=" + arguments.robot] if arguments.robot else []
    results = run_all([] if arguments.print_only else runs, arguments.combinations, arguments, extra, run_one)
    groups = list(dict.fromkeys(run["group"] for run in runs))
    print(table(results, groups, arguments.combinations))
    return 1 if any("error" in result for result in results) else 0


if __name__ == "__main__":
    sys.exit(compare(parse()))
