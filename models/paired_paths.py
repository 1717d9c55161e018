#!/usr/bin/python3
"""How much longer the network's paths are than those of the remembered path: the same drives with both leaders, in pairs.

  python3 models/paired_paths.py                                600 generated worlds
  python3 models/paired_paths.py --maps a.yaml b.yaml=0.19      and 50 goals in each of these maps (FILE, or FILE=FREE_THRESH)
  python3 models/paired_paths.py --drift 0.02                   with the error of odometry of the other tables
  python3 models/paired_paths.py --model random.onnx            another network, for example one with random weights
  python3 models/paired_paths.py --ceiling --drift 0.02         what knowing the map would save of the remembered path

Runs `lstm_planner drive --leader network` and `--leader route` and prints, by kind of world and for all together, how many
drives arrived with each, which share of the steps without the goal in sight the network decided, and path over path where
both arrived: mean, median and 95th percentile with 95 % intervals (bootstrap), and the ratio of the sums. Needs
lstm_planner on the path.

With --ceiling it drives `--leader route` without drift and with it, and the same without drift and with `--knows-map`. It
prints for each kind of world and each map path over path with the map, and which share of its path each drive would have
saved with the map, on average: no leader with the same clearances can gain more."""
import argparse
import csv
import os
import random
import subprocess
import sys
import tempfile

KINDS = ["mazes", "offices", "corridors", "rooms", "forest", "open"]
NETWORK, ROUTE, WITH_MAP = ["network"], ["route"], ["route", "--knows-map"]
HEAD = ("| drives | number | arrived: network, route | contacts | decided by the network | path / route's path | median "
        "| 95th percentile | sum / route's sum |\n|---|---|---|---|---|---|---|---|---|")
HEAD_OF_CEILING = ("| drives | number | arrived: route, with the map | contacts | with the map: path / shortest | "
                   "route's path / path with the map | median | 95th percentile | sum / sum with the map | saved by the map "
                   "|\n|---|---|---|---|---|---|---|---|---|---|")


def drive(leader, drift, where, goals, options, folder):
    """The rows of the drives there, by world and number."""
    details = os.path.join(folder, "details.csv")
    command = ["lstm_planner", "drive", "--leader", *leader, *where, "--goals", str(goals), "--threads",
               str(options.threads), "--drift", str(drift), "--seed", str(options.seed), "--details", details]
    for option in ("model", "detour_allowance", "detour_share"):
        value = getattr(options, option)
        if value and leader == NETWORK:
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


def mean(values):
    return sum(values) / len(values)


def decided(pairs):
    """By the network, of the steps without the goal in sight."""
    out_of_sight = sum(int(network["steps"]) - int(network["by_goal_in_sight"]) for network, _ in pairs)
    return "%.0f %%" % (100 * sum(int(network["by_network"]) for network, _ in pairs) / out_of_sight)


def length(row):
    return float(row["path_m"])


def report(name, pairs, is_ceiling):
    both = [pair for pair in pairs if all(row["end"] == "reached" for row in pair)]
    ratios = [length(row) / length(other) for row, other in both]
    columns = [name, len(pairs)]
    for figure in (lambda row: row["end"] == "reached", lambda row: int(row["contacts"])):
        columns.append("%d, %d" % tuple(sum(figure(pair[leader]) for pair in pairs) for leader in (0, 1)))
    if is_ceiling:
        columns.append("%.3f" % mean([length(known) / float(known["shortest_m"]) for _, known in both]))
    else:
        columns.append(decided(pairs))
    columns += [interval(ratios, mean), "%.3f" % percentile(ratios, 0.5),
                interval(ratios, lambda some: percentile(some, 0.95)),
                "%.3f" % (sum(length(row) for row, _ in both) / sum(length(other) for _, other in both))]
    if is_ceiling:
        columns.append(interval([1 - 1 / ratio for ratio in ratios], mean))
    print("| %s |" % " | ".join(str(column) for column in columns), flush=True)


def compared(where, goals, options):
    """The drives there in pairs, by what they differ in from others."""
    with tempfile.TemporaryDirectory() as folder:
        if not options.ceiling:
            network = drive(NETWORK, options.drift, where, goals, options, folder)
            route = drive(ROUTE, options.drift, where, goals, options, folder)
            return {"": [(network[key], route[key]) for key in network]}
        known = drive(WITH_MAP, 0.0, where, goals, options, folder)
        pairs = {}
        for drift in sorted({0.0, options.drift}):
            route = drive(ROUTE, drift, where, goals, options, folder)
            pairs[", drift %g" % drift] = [(route[key], known[key]) for key in route]
        return pairs


def places(options):
    """Name, options and number of the drives, and in which sums they are."""
    for kind in options.kinds:
        yield kind, ["--worlds", kind], options.goals, ["generated worlds", "all"] if options.ceiling else ["all"]
    for file in options.maps if options.ceiling else []:
        yield os.path.basename(file).split(".yaml")[0], ["--map", file], options.goals // 2, ["buildings", "all"]
    if options.maps and not options.ceiling:
        yield "maps", ["--map", *options.maps], options.goals // 2, ["all"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--maps", nargs="+", default=[], help="map files, FILE, or FILE=FREE_THRESH")
    parser.add_argument("--ceiling", action="store_true", help="compare the remembered path with a robot that knows the map")
    parser.add_argument("--model", default="", help="ONNX file of the network; default: the one that is shipped")
    parser.add_argument("--detour-allowance", default="", help="m; default: the planner's")
    parser.add_argument("--detour-share", default="", help="of the driven distance; default: the planner's")
    parser.add_argument("--kinds", nargs="*", default=KINDS, help="of generated worlds")
    parser.add_argument("--goals", type=int, default=100, help="worlds of each kind, half as many goals in each map")
    parser.add_argument("--drift", type=float, default=0.0, help="error of odometry, as a share of the path")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    print(HEAD_OF_CEILING if options.ceiling else HEAD)
    sums = {}
    for name, where, goals, parts in places(options):
        for how, pairs in compared(where, goals, options).items():
            report(name + how, pairs, options.ceiling)
            for part in parts:
                sums.setdefault(part + how, []).extend(pairs)
    for name in sorted(sums, key=lambda name: name.startswith("all")):
        report(name, sums[name], options.ceiling)


if __name__ == "__main__":
    main()
