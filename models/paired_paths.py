#!/usr/bin/python3
"""How much longer the network's paths are than those of the remembered path: the same drives with both leaders, in pairs.

  python3 models/paired_paths.py                                600 generated worlds
  python3 models/paired_paths.py --maps a.yaml b.yaml=0.19      and 50 goals in each of these maps (FILE, or FILE=FREE_THRESH)
  python3 models/paired_paths.py --drift 0.02                   with the error of odometry of the other tables
  python3 models/paired_paths.py --model random.onnx            another network, for example one with random weights

Runs `lstm_planner drive --leader network` and `--leader route` and prints, by kind of world and for all together, how many
drives arrived with each, which share of the steps without the goal in sight the network decided, and path over path where
both arrived: mean, median and 95th percentile with 95 % intervals (bootstrap), and the ratio of the sums. Needs
lstm_planner on the path."""
import argparse
import csv
import os
import random
import subprocess
import sys
import tempfile

KINDS = ["mazes", "offices", "corridors", "rooms", "forest", "open"]


def drive(leader, where, goals, options, folder):
    """The rows of the drives there, by world and number."""
    details = os.path.join(folder, "details.csv")
    command = ["lstm_planner", "drive", "--leader", leader, *where, "--goals", str(goals), "--threads",
               str(options.threads), "--drift", str(options.drift), "--seed", str(options.seed), "--details", details]
    for option in ("model", "detour_allowance", "detour_share"):
        value = getattr(options, option)
        if value and leader == "network":
            command += ["--" + option.replace("_", "-"), value]
    if subprocess.run(command, stdout=subprocess.DEVNULL).returncode != 0:
        sys.exit("paired_paths.py: this command failed: " + " ".join(command))
    with open(details) as file:
        return {(row["world"], row["number"]): row for row in csv.DictReader(file)}


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def interval(values, figure, trials=1000):
    """The middle 95 % of a figure of samples drawn anew, with seed 1."""
    draw = random.Random(1)
    figures = sorted(figure(draw.choices(values, k=len(values))) for _ in range(trials))
    return "%.3f [%.3f, %.3f]" % (figure(values), figures[int(0.025 * trials)], figures[int(0.975 * trials)])


def report(name, pairs):
    both = [(network, route) for network, route in pairs if network["end"] == "reached" and route["end"] == "reached"]
    paths = [(float(network["path_m"]), float(route["path_m"])) for network, route in both]
    ratios = [network / route for network, route in paths]
    out_of_sight = sum(int(network["steps"]) - int(network["by_goal_in_sight"]) for network, _ in pairs)
    decided = sum(int(network["by_network"]) for network, _ in pairs) / out_of_sight
    arrived = [sum(pair[leader]["end"] == "reached" for pair in pairs) for leader in (0, 1)]
    contacts = [sum(int(pair[leader]["contacts"]) for pair in pairs) for leader in (0, 1)]
    print("| %s | %d | %d, %d | %d, %d | %.0f %% | %s | %.3f | %s | %.3f |" %
          (name, len(pairs), arrived[0], arrived[1], contacts[0], contacts[1], 100 * decided,
           interval(ratios, lambda some: sum(some) / len(some)), percentile(ratios, 0.5),
           interval(ratios, lambda some: percentile(some, 0.95)),
           sum(path[0] for path in paths) / sum(path[1] for path in paths)), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--maps", nargs="+", default=[], help="map files, FILE, or FILE=FREE_THRESH")
    parser.add_argument("--model", default="", help="ONNX file of the network; default: the one that is shipped")
    parser.add_argument("--detour-allowance", default="", help="m; default: the planner's")
    parser.add_argument("--detour-share", default="", help="of the driven distance; default: the planner's")
    parser.add_argument("--kinds", nargs="*", default=KINDS, help="of generated worlds")
    parser.add_argument("--goals", type=int, default=100, help="worlds of each kind, half as many goals in each map")
    parser.add_argument("--drift", type=float, default=0.0, help="error of odometry, as a share of the path")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    print("| drives | number | arrived: network, route | contacts | decided by the network | path / route's path | median "
          "| 95th percentile | sum / route's sum |\n|---|---|---|---|---|---|---|---|---|")
    everything = []
    places = [(kind, ["--worlds", kind], options.goals) for kind in options.kinds]
    if options.maps:
        places.append(("maps", ["--map", *options.maps], options.goals // 2))
    with tempfile.TemporaryDirectory() as folder:
        for name, where, goals in places:
            network = drive("network", where, goals, options, folder)
            route = drive("route", where, goals, options, folder)
            pairs = [(network[key], route[key]) for key in network]
            report(name, pairs)
            everything += pairs
    report("all", everything)


if __name__ == "__main__":
    main()
