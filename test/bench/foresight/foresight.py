#!/usr/bin/env python3
"""How much of what lies behind the borders of what was seen could be foreseen.

Reads the files of lstm_planner_foresight (see foresight.cpp). Boosted trees, or a small network, learn from what is
known of a way on what it truly costs more than the remembered path says. In drives that they have not learnt from, the
way on with the least predicted cost is compared with the remembered path: what it would save, step by step, as a share
of the path; also where the detours that are known before must stay within a bound, as the network's.

    foresight.py --judge offices.bin                        each fifth of the worlds is judged, after learning in the others
    foresight.py --judge offices.bin --network              a network (needs python3-torch) in place of trees
    foresight.py --learn offices.bin rooms.bin --judge building.bin     all drives of the file are judged
"""
import argparse
import copy

import numpy as np

STEP = 0.5  # m, of foresight.cpp
MOST = 20.0  # m; what costs more is as bad
ON_PATH = 8  # `way` along the remembered path
WAYS = 9
SAMPLES = 500  # of the bootstrap
LEAST_GAIN = 0.05  # m that must be predicted, or the path is followed
FOLDS = 5
BOUNDS = ((0.1, 0.08), (1.0, 0.2), (np.inf, 0.0))  # m, and share of the driven path, that detours may cost
LENGTHS = ("regret", "length", "unseen", "to_border", "border_to_goal", "to_goal")


class Steps:
    """The steps of a file: arrays of steps x ways (x inputs). A way on that is not possible costs MOST."""

    def __init__(self, name, goals):
        with open(name, "rb") as file:
            names = file.readline().decode().strip().split(",")
            rows = np.fromfile(file, np.float32).reshape(-1, len(names))
        self.names = names[names.index("regret") :]
        drive, step, way, truth = rows[:, :4].T
        key = drive.astype(np.int64) << 20 | step.astype(np.int64)
        keys, at = np.unique(key, return_inverse=True)
        way = way.astype(int)
        self.inputs = np.zeros((len(keys), WAYS, len(self.names)), np.float32)
        self.truth = np.full((len(keys), WAYS), MOST, np.float32)
        self.possible = np.zeros((len(keys), WAYS), bool)
        self.inputs[at, way] = rows[:, 4:]
        self.truth[at, way] = np.clip(truth, 0, MOST)
        self.possible[at, way] = True
        self.drive = keys >> 20
        self.world = self.drive // goals
        self.regret = np.clip(self.inputs[:, :, self.names.index("regret")], 0, MOST)
        self.keep(self.possible[:, ON_PATH])

    def keep(self, which):
        for name in ("inputs", "truth", "possible", "drive", "world", "regret"):
            setattr(self, name, getattr(self, name)[which])

    def only(self, which):
        """Some of the steps: `which` is true for them."""
        steps = copy.copy(self)
        steps.keep(which)
        return steps


class Trees:
    def __init__(self, parts):
        from sklearn.ensemble import HistGradientBoostingRegressor

        trees = HistGradientBoostingRegressor(max_iter=200, learning_rate=0.08, min_samples_leaf=100, random_state=0)
        inputs = np.concatenate([part.inputs[part.possible] for part in parts])
        self.trees = trees.fit(inputs, np.concatenate([(part.truth - part.regret)[part.possible] for part in parts]))

    def surprise(self, steps):
        surprise = np.zeros(steps.possible.shape, np.float32)
        surprise[steps.possible] = self.trees.predict(steps.inputs[steps.possible])
        return surprise


class Network:
    """19 inputs (all but the picture of what was seen), 32 and 16 cells: 1,185 weights. It learns to choose so that the
    true cost is least."""

    EPOCHS = 20
    TEMPERATURE = 0.5  # m

    def __init__(self, parts):
        import torch

        torch.manual_seed(0)
        torch.set_num_threads(1)
        self.torch = torch
        names = parts[0].names
        self.used = [i for i, name in enumerate(names) if not name.startswith(("unseen_", "wall_"))]
        self.lengths = [name in LENGTHS or name.startswith("sight_") for name in names]
        known = np.concatenate([self.scaled(part)[part.possible] for part in parts])
        self.mean, self.spread = known.mean(0), known.std(0) + 1e-6
        linear = torch.nn.Linear
        self.layers = torch.nn.Sequential(linear(len(self.used), 32), torch.nn.ReLU(), linear(32, 16), torch.nn.ReLU(), linear(16, 1))
        data = [torch.cat(values) for values in zip(*(self.tensors(part) for part in parts))]
        rate = 2e-3
        optimiser = torch.optim.AdamW(self.layers.parameters(), lr=rate, weight_decay=0.3)
        for epoch in range(self.EPOCHS):
            for group in optimiser.param_groups:
                group["lr"] = rate * (1 - epoch / self.EPOCHS)
            for batch in torch.randperm(len(data[0])).split(256):
                loss = self.expected(*(values[batch] for values in data))
                optimiser.zero_grad()
                loss.backward()
                optimiser.step()

    def scaled(self, steps):
        return np.where(self.lengths, np.log1p(np.clip(steps.inputs, 0, 60)), steps.inputs)[..., self.used]

    def tensors(self, steps):
        inputs = (self.scaled(steps) - self.mean) / self.spread * steps.possible[..., None]
        return [self.torch.tensor(values) for values in (inputs.astype(np.float32), steps.regret, steps.truth, steps.possible)]

    def expected(self, inputs, regret, truth, possible):
        """m that a step drawn by the predicted costs truly costs more than the remembered path."""
        cost = regret + self.layers(inputs)[..., 0]
        share = self.torch.softmax((-cost / self.TEMPERATURE).masked_fill(~possible, -1e9), -1)
        return (share * (truth - truth[:, ON_PATH:])).sum(-1).mean()

    def surprise(self, steps):
        with self.torch.no_grad():
            return self.layers(self.tensors(steps)[0])[..., 0].numpy()


def saved(steps, cost, bound):
    """m that the choice saves, by step. `bound`: see BOUNDS; what a step costs more by what is remembered is a detour."""
    allowance, share = bound
    cost = np.where(steps.possible, cost, np.inf)
    savings = np.zeros(len(cost))
    used = driven = 0.0
    for i, costs in enumerate(cost):
        if i == 0 or steps.drive[i] != steps.drive[i - 1]:
            used = driven = 0.0
        regret = steps.regret[i]
        allowed = (costs <= costs[ON_PATH] - LEAST_GAIN) & (used + regret <= allowance + share * driven)
        if np.any(allowed):
            best = np.argmin(np.where(allowed, costs, np.inf))
            used += regret[best]
            savings[i] = steps.truth[i, ON_PATH] - steps.truth[i, best]
        driven += STEP
    return savings


def interval(drives, savings):
    """The mean saving as a share of the path and its 95 % interval, in %; whole drives are drawn."""
    _, inverse = np.unique(drives, return_inverse=True)
    sums, counts = np.bincount(inverse, savings), np.bincount(inverse)
    random = np.random.default_rng(0)
    drawn = random.integers(0, len(sums), (SAMPLES, len(sums)))
    means = sums[drawn].sum(1) / counts[drawn].sum(1)
    return [100 * value / STEP for value in (savings.mean(), *np.quantile(means, (0.025, 0.975)))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--learn", nargs="*", default=[], help="files to learn from")
    parser.add_argument("--judge", required=True, help="file to judge")
    parser.add_argument("--goals", type=int, default=3, help="drives a world of the files")
    parser.add_argument("--network", action="store_true", help="a small network learns in place of trees")
    options = parser.parse_args()
    learner = Network if options.network else Trees
    judged = Steps(options.judge, options.goals)
    cost = judged.regret.copy()
    if options.learn:
        cost += learner([Steps(name, options.goals) for name in options.learn]).surprise(judged)
    elif len(np.unique(judged.world)) < FOLDS:
        parser.error(f"{options.judge} has drives in fewer than {FOLDS} worlds, expected files to learn from (--learn)")
    else:
        for fold in range(FOLDS):
            mine = judged.world % FOLDS == fold
            cost[mine] += learner([judged.only(~mine)]).surprise(judged.only(mine))
    for allowance, share in BOUNDS:
        mean, low, high = interval(judged.drive, saved(judged, cost, (allowance, share)))
        bound = "without a bound" if allowance == np.inf else f"detours of at most {allowance} m + {share} of the path"
        print(f"{bound}: saves {mean:.1f} % [{low:.1f}, {high:.1f}] of the path")
    mean, low, high = interval(judged.drive, saved(judged, judged.truth, (np.inf, 0.0)))
    print(f"with the true costs: {mean:.1f} % [{low:.1f}, {high:.1f}]")


if __name__ == "__main__":
    main()
