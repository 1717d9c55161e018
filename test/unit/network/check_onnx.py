#!/usr/bin/python3
"""Reads a model file without any code of ours: onnx's checker, shape inference, and an evaluation of the written steps.

usage: check_onnx.py MODEL STEPS
STEPS is a JSON file: {"inputs": [[...], ...], "outputs": [[...], ...]}, one entry a step, state carried from step to step.
Exit status: 0 when all is well, 77 when the onnx module is not installed or too old for the model's operators, anything
else when the model is not.
"""

import json
import sys

TOLERANCE = 1e-5
SKIPPED = 77

ACTIVATIONS = {}


def sigmoid(values):
    return 1.0 / (1.0 + numpy.exp(-values))


def recurrent_sums(inputs):
    """Weighted sums of all gates, for one step and batch 1 (ONNX operators LSTM and RNN)."""
    data, weights, recurrent, biases, _, hidden = inputs[:6]
    rows = weights.shape[1]
    return weights[0] @ data[0, 0] + recurrent[0] @ hidden[0, 0] + biases[0, :rows] + biases[0, rows:]


def run_lstm(inputs, attributes):
    names = attributes.get("activations", [b"Sigmoid", b"Tanh", b"Tanh"])
    gate, candidate, output = (ACTIVATIONS[name.decode()] for name in names)
    i, o, f, c = numpy.split(recurrent_sums(inputs), 4)
    cell = gate(f) * inputs[6][0, 0] + gate(i) * candidate(c)
    hidden = gate(o) * output(cell)
    return [hidden.reshape(1, 1, 1, -1), hidden.reshape(1, 1, -1), cell.reshape(1, 1, -1)]


def run_rnn(inputs, _attributes):
    hidden = numpy.tanh(recurrent_sums(inputs))
    return [hidden.reshape(1, 1, 1, -1), hidden.reshape(1, 1, -1)]


def run_node(node, inputs):
    attributes = {attribute.name: onnx.helper.get_attribute_value(attribute) for attribute in node.attribute}
    if node.op_type == "LSTM":
        return run_lstm(inputs, attributes)
    if node.op_type == "RNN":
        return run_rnn(inputs, attributes)
    if node.op_type == "Gemm":
        return [inputs[0] @ (inputs[1].T if attributes.get("transB") else inputs[1]) + inputs[2]]
    if node.op_type == "Softmax":
        powers = numpy.exp(inputs[0] - inputs[0].max())
        return [powers / powers.sum(axis=attributes["axis"], keepdims=True)]
    if node.op_type == "Squeeze":
        return [numpy.squeeze(inputs[0], axis=tuple(inputs[1]))]
    if node.op_type == "Unsqueeze":
        return [numpy.expand_dims(inputs[0], axis=tuple(inputs[1]))]
    return [ACTIVATIONS[node.op_type](inputs[0])]


def run_graph(graph, feeds):
    """All outputs of the graph, in double precision."""
    values = {"": None, **feeds}
    for tensor in graph.initializer:
        array = onnx.numpy_helper.to_array(tensor)
        values[tensor.name] = array.astype(float) if array.dtype == numpy.float32 else array
    for node in graph.node:
        results = run_node(node, [values[name] for name in node.input])
        values.update({name: result for name, result in zip(node.output, results) if name})
    return [values[output.name] for output in graph.output]


def runs_custom_activations(graph):
    return any(attribute.name == "activations" for node in graph.node for attribute in node.attribute)


def zero_states(graph, number):
    """Of the first step."""
    return {value.name: numpy.zeros([extent.dim_value for extent in value.type.tensor_type.shape.dim], number)
            for value in list(graph.input)[1:]}


def gives_all_outputs(evaluator, graph):
    """onnx's own LSTM gave no cell state before 1.18."""
    size = [extent.dim_value for extent in graph.input[0].type.tensor_type.shape.dim]
    feeds = {graph.input[0].name: numpy.zeros(size, numpy.float32), **zero_states(graph, numpy.float32)}
    try:
        evaluator.run(None, feeds)
    except RuntimeError as error:
        cells = [node.output[2] for node in graph.node if node.op_type == "LSTM"]
        if not any(cell in str(error) for cell in cells):
            raise
        return False
    return True


def evaluators(model):
    """(name, type of the numbers, function from feeds to outputs, steps) of each evaluation at hand; steps: None for all."""
    yield "numpy", numpy.float64, lambda feeds: run_graph(model.graph, feeds), None
    try:
        from onnx.reference import ReferenceEvaluator
    except ImportError:
        print("SKIPPED: this onnx has no reference evaluation")
        return
    if runs_custom_activations(model.graph):
        print("SKIPPED: onnx's reference evaluation knows the default activations only")
        return
    evaluator = ReferenceEvaluator(model)
    if gives_all_outputs(evaluator, model.graph):
        yield "onnx.reference", numpy.float32, lambda feeds: evaluator.run(None, feeds), None
    else:
        preferences = [model.graph.output[0].name]
        yield "onnx.reference", numpy.float32, lambda feeds: evaluator.run(preferences, feeds), 1


def largest_difference(graph, steps, number, run):
    observation = graph.input[0]
    size = [extent.dim_value for extent in observation.type.tensor_type.shape.dim]
    states = zero_states(graph, number)
    largest = 0.0
    for values, expected in steps:
        feeds = {observation.name: numpy.array(values, number).reshape(size), **states}
        preferences, *next_states = run(feeds)
        states = dict(zip(states, next_states))
        largest = max(largest, float(numpy.abs(preferences[0] - numpy.array(expected)).max()))
    return largest


def main():
    model = onnx.load(sys.argv[1])
    wanted = max(operators.version for operators in model.opset_import)
    if onnx.defs.onnx_opset_version() < wanted:
        print(f"SKIPPED: onnx {onnx.__version__} does not know version {wanted} of the operators")
        return SKIPPED
    onnx.checker.check_model(model, full_check=True)
    inferred = onnx.shape_inference.infer_shapes(model, strict_mode=True)
    print("checked:", ", ".join(node.op_type for node in inferred.graph.node))
    print("metadata:", json.dumps({entry.key: entry.value for entry in model.metadata_props}))
    with open(sys.argv[2], encoding="utf-8") as file:
        steps = json.load(file)
    steps = list(zip(steps["inputs"], steps["outputs"]))
    status = 0
    for name, number, run, count in evaluators(model):
        difference = largest_difference(model.graph, steps[:count], number, run)
        print(f"{name}: {len(steps[:count])} steps differ by at most {difference:.2g}")
        # Written so that NaN fails, too.
        if not difference < TOLERANCE:
            status = 1
    return status


if __name__ == "__main__":
    try:
        import numpy
        import onnx
        import onnx.checker
        import onnx.defs
        import onnx.numpy_helper
        import onnx.shape_inference
    except ImportError as error:
        print(f"SKIPPED: {error}")
        sys.exit(SKIPPED)
    ACTIVATIONS = {
        "Relu": lambda values: numpy.maximum(values, 0.0),
        "Sigmoid": sigmoid,
        "Tanh": numpy.tanh,
    }
    sys.exit(main())
