#!/usr/bin/env python3
"""How much of what lies behind the borders of what was seen could be foreseen.

Reads the files of lstm_planner_foresight (see foresight.cpp). Boosted trees learn, from all that is known of a way on,
what it truly costs more than the remembered path says. In drives that they have not learnt from, the way on with the
least predicted cost is compared with the remembered path: what it would save, step by step, as a share of the path.

    foresight.py --judge offices.bin                        every fifth world of the file is judged
    foresight.py --learn offices.bin rooms.bin --judge building.bin     all drives of the file are judged
"""
import argparse

import numpy as np
from sklearn.ensemble import HistGradientBoostingRegressor

STEP = 0.5  # m, of foresight.cpp
MOST = 20.0  # m; what costs more is as bad
ON_PATH = 8  # `way` along the remembered path
SAMPLES = 500  # of the bootstrap
GAINS = (0.0, 0.02, 0.05, 0.1, 0.2)  # m that must be predicted, or the path is followed


def read(name):
    with open(name, "rb") as file:
        names = file.readline().decode().strip().split(",")
        rows = np.fromfile(file, np.float32).reshape(-1, len(names))
    return {name: rows[:, i] for i, name in enumerate(names)}, rows[:, names.index("regret"):]


def learn(parts):
    inputs = np.concatenate([inputs for _, inputs in parts])
    surprise = np.concatenate([np.clip(c["truth"], 0, MOST) - np.clip(c["regret"], 0, MOST) for c, _ in parts])
    trees = HistGradientBoostingRegressor(max_iter=200, learning_rate=0.08, min_samples_leaf=100, random_state=0)
    return trees.fit(inputs, surprise)


def saved(columns, costs, least_gain):
    """m, by drive: what the choice saves; and the share of the steps that it changes."""
    key = columns["drive"].astype(np.int64) << 20 | columns["step"].astype(np.int64)
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.diff(key[order], prepend=-1))
    drives, savings = [], []
    for rows in np.split(order, first[1:]):
        path = rows[columns["way"][rows] == ON_PATH]
        if len(path) == 0:
            continue
        best = rows[np.argmin(costs[rows])]
        if costs[best] > costs[path[0]] - least_gain:
            best = path[0]
        drives.append(columns["drive"][path[0]])
        savings.append(min(columns["truth"][path[0]], MOST) - min(columns["truth"][best], MOST))
    return np.array(drives), np.array(savings)


def interval(drives, savings):
    """The mean saving a step and its 95 % interval; whole drives are drawn."""
    _, inverse = np.unique(drives, return_inverse=True)
    sums, counts = np.bincount(inverse, savings), np.bincount(inverse)
    random = np.random.default_rng(0)
    drawn = random.integers(0, len(sums), (SAMPLES, len(sums)))
    means = sums[drawn].sum(1) / counts[drawn].sum(1)
    return savings.mean(), *np.quantile(means, (0.025, 0.975))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--learn", nargs="*", default=[], help="files to learn from")
    parser.add_argument("--judge", required=True, help="file to judge")
    parser.add_argument("--goals", type=int, default=3, help="drives a world of the file to judge")
    options = parser.parse_args()
    columns, inputs = read(options.judge)
    parts = [read(name) for name in options.learn]
    judged = np.ones(len(inputs), bool)
    if not parts:
        judged = columns["drive"] // options.goals % 5 == 0
        parts = [({name: values[~judged] for name, values in columns.items()}, inputs[~judged])]
    trees = learn(parts)
    columns = {name: values[judged] for name, values in columns.items()}
    predicted = trees.predict(inputs[judged]) + np.clip(columns["regret"], 0, MOST)
    for least_gain in GAINS:
        mean, low, high = interval(*saved(columns, predicted, least_gain))
        print(f"predicted gain of {least_gain} m or more: saves {100 * mean / STEP:.1f} % [{100 * low / STEP:.1f}, "
              f"{100 * high / STEP:.1f}] of the path")
    mean, low, high = interval(*saved(columns, np.clip(columns["truth"], 0, MOST), 0.0))
    print(f"with the true costs: {100 * mean / STEP:.1f} % [{100 * low / STEP:.1f}, {100 * high / STEP:.1f}]")


if __name__ == "__main__":
    main()
