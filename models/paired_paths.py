#!/usr/bin/python3
"""How much longer the network's paths are than those of the remembered path: the same drives with both leaders, in pairs.

  python3 models/paired_paths.py                                600 generated worlds
  python3 models/paired_paths.py --maps a.yaml b.yaml=0.19      and 50 goals in each of these maps (FILE, or FILE=FREE_THRESH)

Runs `lstm_planner drive --leader network` and `--leader route` without drift and prints, by kind of world and for all
together, how many drives arrived with each, and path over path where both did: mean, median and 95th percentile with 95 %
intervals (bootstrap). Needs lstm_planner on the path."""
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
               str(options.threads), "--details", details]
    if options.model:
        command += ["--model", options.model]
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
    return "%.2f [%.2f, %.2f]" % (figure(values), figures[int(0.025 * trials)], figures[int(0.975 * trials)])


def report(name, pairs):
    both = [(network, route) for network, route in pairs if network["end"] == "reached" and route["end"] == "reached"]
    ratios = [float(network["path_m"]) / float(route["path_m"]) for network, route in both]
    led = sum(int(network["by_network"]) for network, _ in pairs) / sum(int(network["steps"]) for network, _ in pairs)
    arrived = [sum(pair[leader]["end"] == "reached" for pair in pairs) for leader in (0, 1)]
    print("| %s | %d | %d | %d | %.0f %% | %s | %.2f | %s |" %
          (name, len(pairs), arrived[0], arrived[1], 100 * led, interval(ratios, lambda some: sum(some) / len(some)),
           percentile(ratios, 0.5), interval(ratios, lambda some: percentile(some, 0.95))), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--maps", nargs="+", default=[], help="map files, FILE, or FILE=FREE_THRESH")
    parser.add_argument("--model", default="", help="ONNX file of the network; default: the one that is shipped")
    parser.add_argument("--goals", type=int, default=100, help="worlds of each kind, half as many goals in each map")
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    print("| drives | number | network arrived | route arrived | steps led by the network | path / route's path | median "
          "| 95th percentile |\n|---|---|---|---|---|---|---|---|")
    everything = []
    places = [(kind, ["--worlds", kind], options.goals) for kind in KINDS]
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
