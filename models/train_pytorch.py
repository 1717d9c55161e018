#!/usr/bin/env python3
"""Trains a network of PyTorch on what `lstm_planner dataset export --encoded` writes, and exports it as ONNX.

usage: train_pytorch.py encoded.csv exported.onnx [LABEL]     (apt: python3-torch, python3-numpy; pip: torch, numpy, onnx)
Then: lstm_planner model convert exported.onnx --output own.onnx
"""
import inspect
import sys

import numpy as np
import torch
from torch import nn

CELLS = 32
EPOCHS = 60


class Net(nn.Module):
    """Two LSTM layers and a linear one, as in the thesis."""

    def __init__(self, inputs, actions):
        super().__init__()
        self.lstm = nn.LSTM(inputs, CELLS, num_layers=2, batch_first=True)
        self.out = nn.Linear(CELLS, actions)

    def forward(self, x, hidden, cell):
        y, (hidden, cell) = self.lstm(x, (hidden, cell))
        return self.out(y), hidden, cell


class OneStep(Net):
    """What the planner asks: the preferences after one step."""

    def forward(self, x, hidden, cell):
        y, hidden, cell = super().forward(x, hidden, cell)
        return y[:, -1], hidden, cell


def read(path, label):
    """A tensor of inputs and one of labels for each episode."""
    with open(path) as file:
        names = file.readline().strip().split(",")
        table = np.loadtxt(file, delimiter=",", ndmin=2)
    inputs = [i for i, name in enumerate(names) if name not in ("episode", "step") and not name.startswith("label_")]
    for episode in np.unique(table[:, 0]):
        rows = table[table[:, 0] == episode]
        yield torch.tensor(rows[:, inputs], dtype=torch.float32), torch.tensor(rows[:, names.index(label)]).long()


def export(net, arguments, path, **options):
    """As ONNX in one file. What exports by default since PyTorch 2.9 needs onnxscript, and may write a second file."""
    if "dynamo" in inspect.signature(torch.onnx.export).parameters:
        options["dynamo"] = False
    torch.onnx.export(net.eval(), arguments, path, **options)


def main(encoded, exported, label="label_0.4"):
    torch.manual_seed(1)
    episodes = list(read(encoded, label))
    inputs, actions = episodes[0][0].shape[1], 5
    net = OneStep(inputs, actions)
    zeros = torch.zeros(2, 1, CELLS)
    optimiser = torch.optim.Adam(net.parameters(), lr=3e-3)
    for epoch in range(EPOCHS):
        right = total = 0
        for x, y in episodes:
            preferences = Net.forward(net, x[None], zeros, zeros)[0][0]
            optimiser.zero_grad()
            nn.functional.cross_entropy(preferences, y).backward()
            optimiser.step()
            right += (preferences.argmax(1) == y).sum().item()
            total += len(y)
    print("%d episodes, %d steps, %.1f %% of the labels after %d epochs" % (len(episodes), total, 100 * right / total, EPOCHS))
    export(net, (torch.zeros(1, 1, inputs), zeros, zeros), exported, input_names=["observation", "hidden", "cell"],
           output_names=["preferences", "next_hidden", "next_cell"])


if __name__ == "__main__":
    main(*sys.argv[1:])
