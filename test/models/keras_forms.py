#!/usr/bin/python3
"""Writes keras_*.onnx, in the forms that tf2onnx makes of Keras models, and keras_outputs.csv: what Keras would answer.

Neither Keras nor tf2onnx is needed: the graphs are built from what tf2onnx's sources say, the answers are calculated with
the weights as Keras holds them (gates i, f, c, o). Debian: python3-onnx. Input i at step t is sin(0.7 i + 1.3 t).
"""
import csv
import os

import numpy
from onnx import TensorProto, checker, helper, numpy_helper, save

HERE = os.path.dirname(os.path.abspath(__file__))
INPUTS, CELLS, OUTPUTS, STEPS = 14, 4, 5, 6
random = numpy.random.RandomState(1)


def weights(*shape):
    return random.uniform(-0.7, 0.7, shape).astype(numpy.float32)


def sigmoid(values):
    return 1.0 / (1.0 + numpy.exp(-values))


class Lstm:
    """tf.keras.layers.LSTM"""

    def __init__(self, inputs):
        self.kernel, self.recurrent_kernel = weights(inputs, 4 * CELLS), weights(CELLS, 4 * CELLS)
        self.bias = weights(4 * CELLS)
        self.hidden = self.cell = numpy.zeros(CELLS)

    def step(self, values):
        gates = values @ self.kernel + self.hidden @ self.recurrent_kernel + self.bias
        i, f, c, o = numpy.split(gates, 4)
        self.cell = sigmoid(f) * self.cell + sigmoid(i) * numpy.tanh(c)
        self.hidden = sigmoid(o) * numpy.tanh(self.cell)
        return self.hidden

    def onnx_weights(self, name):
        def rows(matrix):  # one row a cell, gates i, o, f, c
            i, f, c, o = numpy.split(matrix, 4, axis=-1)
            return numpy.concatenate([i, o, f, c], axis=-1).T[None]
        biases = numpy.concatenate([rows(self.bias)[0], numpy.zeros(4 * CELLS, numpy.float32)])[None]
        return [numpy_helper.from_array(numpy.ascontiguousarray(values), name + suffix) for suffix, values in
                (("W", rows(self.kernel)), ("R", rows(self.recurrent_kernel)), ("B", biases))]


class Dense:
    """tf.keras.layers.Dense"""

    def __init__(self):
        self.kernel, self.bias = weights(CELLS, OUTPUTS), weights(OUTPUTS)

    def step(self, values):
        return values @ self.kernel + self.bias


class Graph:
    def __init__(self, layers):
        self.layers, self.nodes, self.constants = layers, [], []

    def constant(self, name, values, data_type):
        self.constants.append(numpy_helper.from_array(numpy.array(values, data_type), name))
        return name

    def add(self, operator, *inputs, **attributes):
        output = "%s__%d" % (operator, len(self.nodes))
        outputs = [output] if operator != "LSTM" else [output, output + "_h", output + "_c"]
        self.nodes.append(helper.make_node(operator, inputs, outputs, output, **attributes))
        return outputs

    def indices(self, *values):
        return self.constant("const__%d" % len(self.constants), values, numpy.int64)

    def lstm(self, layer, values, initial):
        """Of batch first values; the outputs of all steps, time first, and of the last one."""
        name = "lstm_%d_" % len(self.nodes)
        self.constants += layer.onnx_weights(name)
        transposed, = self.add("Transpose", values, perm=[1, 0, 2])
        return self.add("LSTM", transposed, name + "W", name + "R", name + "B", "", initial, initial,
                        hidden_size=CELLS, direction="forward")

    def batch_first(self, all_steps):
        squeezed, = self.add("Squeeze", all_steps, self.indices(1))
        return self.add("Transpose", squeezed, perm=[1, 0, 2])[0]

    def dense(self, layer, values, reshape):
        kernel = self.constant("kernel", layer.kernel, numpy.float32)
        bias = self.constant("bias", layer.bias, numpy.float32)
        if not reshape:
            return self.add("Add", self.add("MatMul", values, kernel)[0], bias)[0]
        flat, = self.add("Reshape", values, self.indices(1, CELLS))
        product, = self.add("MatMul", flat, kernel)
        return self.add("Add", self.add("Reshape", product, self.indices(1, 1, OUTPUTS))[0], bias)[0]

    def zeros_of_the_batch(self):
        """tf.zeros([tf.shape(x)[0], units])"""
        shape, = self.add("Shape", "lstm_input")
        as_int32, = self.add("Cast", shape, to=TensorProto.INT32)
        first, = self.add("Slice", as_int32, self.indices(0), self.indices(1), self.indices(0))
        batch, = self.add("Squeeze", first, self.indices(0))
        units = self.constant("units", [CELLS], numpy.int32)
        packed, = self.add("Concat", self.add("Unsqueeze", batch, self.indices(0))[0], units, axis=0)
        as_int64, = self.add("Cast", packed, to=TensorProto.INT64)
        filled, = self.add("Expand", self.constant("zero", 0.0, numpy.float32), as_int64)
        return self.add("Unsqueeze", filled, self.indices(0))[0]

    def save(self, name, batch, time, output, output_shape):
        tensor = helper.make_tensor_value_info
        graph = helper.make_graph(self.nodes, "tf2onnx", [tensor("lstm_input", TensorProto.FLOAT, [batch, time, INPUTS])],
                                  [tensor(output, TensorProto.FLOAT, output_shape)], self.constants)
        model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)])
        model.ir_version = 7
        checker.check_model(model, full_check=True)
        save(model, os.path.join(HERE, name))

    def answers(self):
        for step in range(STEPS):
            values = numpy.sin(0.7 * numpy.arange(INPUTS) + 1.3 * step)
            for layer in self.layers:
                values = layer.step(values)
            yield step, values


def sequence():
    """LSTM(return_sequences=True), Dense, with batch and length fixed to 1: all else is folded."""
    graph = Graph([Lstm(INPUTS), Dense()])
    zeros = graph.constant("zeros", numpy.zeros((1, 1, CELLS)), numpy.float32)
    hidden = graph.lstm(graph.layers[0], "lstm_input", zeros)[0]
    graph.save("keras_sequence.onnx", 1, 1, graph.dense(graph.layers[1], graph.batch_first(hidden), True), [1, 1, OUTPUTS])
    return graph


def any_batch():
    """The same with neither fixed: the initial state has the batch's shape."""
    graph = Graph([Lstm(INPUTS), Dense()])
    hidden = graph.lstm(graph.layers[0], "lstm_input", graph.zeros_of_the_batch())[0]
    graph.save("keras_any_batch.onnx", "unk__0", "unk__1",
               graph.dense(graph.layers[1], graph.batch_first(hidden), False), ["unk__0", "unk__1", OUTPUTS])
    return graph


def stacked():
    """LSTM(return_sequences=True), LSTM, Dense: the last step's output only."""
    graph = Graph([Lstm(INPUTS), Lstm(CELLS), Dense()])
    zeros = graph.constant("zeros", numpy.zeros((1, 1, CELLS)), numpy.float32)
    hidden = graph.lstm(graph.layers[0], "lstm_input", zeros)[0]
    last = graph.lstm(graph.layers[1], graph.batch_first(hidden), zeros)[1]
    squeezed, = graph.add("Squeeze", last, graph.indices(0))
    graph.save("keras_stacked.onnx", 1, 1, graph.dense(graph.layers[2], squeezed, False), [1, OUTPUTS])
    return graph


with open(os.path.join(HERE, "keras_outputs.csv"), "w", newline="", encoding="utf-8") as file:
    table = csv.writer(file, lineterminator="\n")
    for name, make in (("keras_sequence.onnx", sequence), ("keras_any_batch.onnx", any_batch),
                       ("keras_stacked.onnx", stacked)):
        for step, values in make().answers():
            table.writerow([name, step] + ["%.9g" % value for value in values])
