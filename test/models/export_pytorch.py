#!/usr/bin/env python3
"""Writes pytorch_*.onnx, as PyTorch exports networks in its several ways, and pytorch_outputs.csv: what they answer.

Debian: python3-torch. The files are in the repository; run this again for another version of PyTorch.
Input i at step t is sin(0.7 i + 1.3 t).
"""
import csv
import math
import os
import sys

import torch
from torch import nn

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "models"))
from train_pytorch import export as export_onnx
INPUTS, CELLS, OUTPUTS, STEPS = 14, 4, 5, 6


class Lstm(nn.Module):
    """Two layers, batch first, states as inputs and outputs."""

    def __init__(self):
        super().__init__()
        self.lstm = nn.LSTM(INPUTS, CELLS, num_layers=2, batch_first=True)
        self.out = nn.Linear(CELLS, OUTPUTS)

    def forward(self, x, hidden, cell):
        y, (hidden, cell) = self.lstm(x, (hidden, cell))
        return self.out(y[:, -1]), hidden, cell


class LstmWithoutStates(Lstm):
    """Its states are zeros in the file; the planner carries them from step to step."""

    def forward(self, x):
        return torch.softmax(self.out(self.lstm(x)[0][:, -1]), -1)


class SequenceRnn(nn.Module):
    """Linear layers on sequences, which become MatMul and Add."""

    def __init__(self):
        super().__init__()
        self.first = nn.Linear(INPUTS, 6)
        self.rnn = nn.RNN(6, CELLS, batch_first=True)
        self.out = nn.Linear(CELLS, OUTPUTS)

    def forward(self, x):
        return self.out(self.rnn(torch.tanh(self.first(x)))[0]).squeeze(1)


class EqualBiases(nn.Module):
    """Biases that are all zero, which the exporter stores once and copies by Identity."""

    def __init__(self):
        super().__init__()
        self.layers = nn.Sequential(nn.Linear(INPUTS, 6), nn.ReLU(), nn.Linear(6, 6), nn.Tanh(), nn.Linear(6, OUTPUTS))
        for layer in self.layers[::2]:
            nn.init.zeros_(layer.bias)

    def forward(self, x):
        return self.layers(x)


class TwoInputs(nn.Module):
    """Ranges and the rest as two inputs."""

    def __init__(self):
        super().__init__()
        self.layers = nn.Sequential(nn.Linear(INPUTS, 6), nn.ReLU(), nn.Linear(6, OUTPUTS))

    def forward(self, ranges, rest):
        return self.layers(torch.cat([ranges, rest], -1))


def sequence():
    return torch.tensor([[[math.sin(0.7 * i + 1.3 * t) for i in range(INPUTS)] for t in range(STEPS)]])


def export(name, net, arguments, answers, writer, **options):
    export_onnx(net, arguments, os.path.join(HERE, name), **options)
    for step in range(STEPS):
        writer.writerow([name, step] + ["%.9g" % value for value in answers[step].tolist()])


def main():
    torch.manual_seed(1)
    x = sequence()
    one = x[:, :1]
    states = torch.zeros(2, 1, CELLS)
    with open(os.path.join(HERE, "pytorch_outputs.csv"), "w", newline="") as file, torch.no_grad():
        writer = csv.writer(file, lineterminator="\n")
        net = Lstm().eval()
        export("pytorch_states.onnx", net, (one, states, states), net.out(net.lstm(x)[0][0]), writer)
        net = LstmWithoutStates().eval()
        answers = torch.softmax(net.out(net.lstm(x)[0][0]), -1)
        for opset in (9, 11, 13):
            export("pytorch_opset_%d.onnx" % opset, net, (one,), answers, writer, opset_version=opset)
        export("pytorch_dynamic.onnx", net, (one,), answers, writer, input_names=["x"],
               dynamic_axes={"x": {0: "batch", 1: "time"}})
        net = SequenceRnn().eval()
        export("pytorch_sequence.onnx", net, (one,), net(x).squeeze(0), writer)
        net = TwoInputs().eval()
        export("pytorch_two_inputs.onnx", net, (x[0, :1, :8], x[0, :1, 8:]), net(x[0, :, :8], x[0, :, 8:]), writer)
        net = Lstm().eval()
        export("pytorch_unfolded.onnx", net, (one, states, states), net.out(net.lstm(x)[0][0]), writer,
               do_constant_folding=False)
        net = EqualBiases().eval()
        export("pytorch_equal_biases.onnx", net, (x[0, :1],), net(x[0]), writer)


if __name__ == "__main__":
    main()
