#!/usr/bin/python3
"""What each idea is worth on the robot: a row of the table in models/create2_lstm.md, by one command a row.

  python3 models/robot_table.py lstm            trains and judges the row, adds it to the results, and prints it
  python3 models/robot_table.py --print         prints the table of all results that there are

Every row is trained alike and shortly, with three seeds: imitation, then actor-critic. It is judged alone, without boundary following,
by `lstm_planner judge` in worlds that no training saw, the same ones for all rows. Needs lstm_planner on the path."""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

KINDS = ["mazes", "offices", "corridors", "rooms", "forest", "open", "all"]
# In the order in which the rows of the table were trained and judged: the number of a world decides on its kind.
COURSE = "--kinds mazes offices corridors forest open rooms"
IMITATION = "--rounds 2 --worlds 60 --validation 12 --epochs 15"
ACTOR_CRITIC = ("--iterations 20 --worlds 24 --starts 8 --validation 12 --max-steps 400 --entropy-start 0.006 "
                "--entropy-end 0.001")
JUDGE = "--worlds 504 --max-steps 500 --seed 7 " + COURSE

# Name: what it is, options of a new network, options of the course. MLP and RNN have as many weights as the LSTM.
ROWS = {
    "greedy": ("no network: the allowed angle nearest to the goal", None, None),
    "route": ("no network: the path through the remembered obstacles", None, None),
    "mlp": ("MLP 2x55, thesis's inputs and events", "--inputs events --network mlp --cells 55 55", ""),
    "rnn": ("RNN 2x35, the same inputs", "--inputs events --network rnn --cells 35 35", ""),
    "lstm": ("LSTM 2x16, the same inputs", "--inputs events --cells 16 16", ""),
    "lstm_2x8": ("LSTM 2x8", "--inputs events --cells 8 8", ""),
    "lstm_2x32": ("LSTM 2x32", "--inputs events --cells 32 32", ""),
    "lstm_2x64": ("LSTM 2x64", "--inputs events --cells 64 64", ""),
    "thesis": ("LSTM 2x16, the thesis's inputs alone", "--cells 16 16", ""),
    "events_alone": ("events in place of the ranges (4.3.1)", "--inputs events-alone --cells 16 16", ""),
    "trace": ("the thesis's inputs and the trace", "--inputs trace --cells 16 16", ""),
    "events_trace": ("events and the trace", "--inputs events trace --cells 16 16", ""),
    "motion": ("events and the motion since the last step", "--inputs events motion --cells 16 16", ""),
    "rounded": ("odometry rounded to 0.35 m (4.3.2)", "--inputs events --cells 16 16 --position-cell 0.35", ""),
    "pose_rounded": ("and the heading to 22.5 degrees",
                     "--inputs events --cells 16 16 --position-cell 0.35 --heading-cell 0.3926991", ""),
    "angles": ("the thesis's 12 inputs: bearing and heading as one number each", "--inputs angles --cells 16 16", ""),
    "events_alone_angles": ("12 inputs, events in place of the ranges", "--inputs events-alone angles --cells 16 16", ""),
    "dead_ends": ("half of the drives start in a dead end (ch. 5)", "--inputs events --cells 16 16",
                  "--dead-ends 0.5"),
    "imitation": ("LSTM 2x16, imitation only", "--inputs events --cells 16 16", ""),
    "reinforcement": ("LSTM 2x16, reinforcement only", "--inputs events --cells 16 16", ""),
}


def tool(arguments):
    command = ["lstm_planner"] + arguments.split()
    if subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode != 0:
        sys.exit("robot_table.py: this command failed: " + " ".join(command))


def train(name, seed, folder, threads):
    """The file of a network of that row."""
    _, network, course = ROWS[name]
    common = " %s %s --seed %d --threads %d" % (COURSE, course, seed, threads)
    first = os.path.join(folder, "imitation.onnx")
    last = os.path.join(folder, "reinforced.onnx")
    if name == "reinforcement":
        tool("train --method actor-critic %s %s %s --output %s" % (network, ACTOR_CRITIC, common, last))
        return last
    tool("train %s %s %s --output %s" % (network, IMITATION, common, first))
    if name == "imitation":
        return first
    tool("train --method actor-critic --init %s %s %s --output %s" % (first, ACTOR_CRITIC, common, last))
    return last


def judge(name, model, folder, threads):
    result = os.path.join(folder, "judged.json")
    leader = {"greedy": "none", "route": "route"}.get(name, "network --model " + model)
    tool("judge --leader %s %s --threads %d --json %s" % (leader, JUDGE, threads, result))
    with open(result) as file:
        return json.load(file)["worlds"]


def make_row(name, seeds, threads):
    judged = []
    for seed in [1] if ROWS[name][1] is None else seeds:
        with tempfile.TemporaryDirectory() as folder:
            model = "" if ROWS[name][1] is None else train(name, seed, folder, threads)
            judged.append(judge(name, model, folder, threads))
    return {kind: {key: [one[kind][key] for one in judged] for key in judged[0][kind]} for kind in KINDS}


def interval(values, counts):
    """Mean share of all drives and half of its 95 % interval: of the drives, and between the seeds where that is wider."""
    total = sum(counts)
    share = sum(values) / total
    half = 1.96 * math.sqrt(max(share * (1 - share), 1.0 / total) / total)
    if len(counts) > 1:
        shares = [value / count for value, count in zip(values, counts)]
        spread = sum((one - share) ** 2 for one in shares) / (len(shares) - 1)
        t = {2: 12.71, 3: 4.30, 4: 3.18, 5: 2.78, 6: 2.57}.get(len(shares), 2.0)
        half = max(half, t * math.sqrt(spread / len(shares)))
    return share, half


def print_table(results):
    print("| | " + " | ".join(KINDS) + " | efficiency |")
    print("|---" * (len(KINDS) + 2) + "|")
    for name in ROWS:
        if name not in results:
            continue
        cells = []
        for kind in KINDS:
            share, half = interval(results[name][kind]["arrived"], results[name][kind]["drives"])
            cells.append("%.1f ± %.1f" % (100 * share, 100 * half))
        everything = results[name]["all"]
        means = zip(everything["efficiency"], everything["drives"])
        efficiency = sum(mean * drives for mean, drives in means) / sum(everything["drives"])
        print("| %s | %s | %.2f |" % (ROWS[name][0], " | ".join(cells), efficiency))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows", nargs="*", help="names of rows: " + ", ".join(ROWS))
    parser.add_argument("--results", default="robot_table.json", help="file that holds all results so far")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--print", action="store_true", help="only print what there is")
    options = parser.parse_args()
    unknown = [row for row in options.rows if row not in ROWS]
    if unknown:
        parser.error("there is no row '%s', expected some of %s" % (unknown[0], ", ".join(ROWS)))
    results = {}
    if os.path.exists(options.results):
        with open(options.results) as file:
            results = json.load(file)
    for row in options.rows:
        results[row] = make_row(row, options.seeds, options.threads)
        with open(options.results, "w") as file:
            json.dump(results, file)
    print_table(results)


if __name__ == "__main__":
    main()
