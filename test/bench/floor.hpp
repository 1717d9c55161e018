#pragma once

#include "lstm_planner/base/network/instruction_set.hpp"
#include "lstm_planner/base/network/layers.hpp"

namespace lstm_planner {

/// How fast one core of this machine does what a network's step is made of. Minima of many short repetitions, so that
/// other programs on the machine hardly change them. A multiply-add is one instruction where the set has it, and two
/// in the baseline of x86-64.
struct CoreSpeed {
  double multiply_add_ns = 0.0;       ///< until a multiply-add's result can be multiplied
  double multiplication_ns = 0.0;     ///< until a product can be multiplied
  double addition_ns = 0.0;           ///< until a sum can be added to
  double division_ns = 0.0;           ///< until a quotient of four numbers can be divided by
  double broadcast_ns = 0.0;          ///< until one number of a register is in all of another
  double multiply_adds_per_ns = 0.0;  ///< peak, in numbers: a register of 16 counts 16
  double l1_bytes_per_ns = 0.0;       ///< reads of a buffer that fits the first level of the cache
  double l2_bytes_per_ns = 0.0;       ///< and of one of 512 KiB
  double l1_bytes = 0.0;              ///< size of the first level
  double register_bytes = 0.0;        ///< of all vector registers
};

/// Measured at the first call (half a second) with code of that instruction set alone.
const CoreSpeed& measuredSpeed(InstructionSet set);

/// A time, in ns, that no implementation of an LSTM network's step goes below on this machine: the largest of three
/// lower bounds, each of which leaves out what it does not name. One agent, single precision; a step's inputs come when
/// the last step's output is there.
///
/// - `chain`: instructions of which each needs the one before, with any number of units to run the others. A layer's
///   input is brought into all lanes (one broadcast) and multiplied, and n of them are summed by a tree of log2(n)
///   additions, or by n * units multiply-adds at the peak where that takes longer; products with the previous output
///   do not wait for anything and cost nothing here. An activation is a quotient of two polynomials of third degree in
///   x^2 (after one another two multiplications and two multiply-adds) and its division; bounding its argument costs
///   nothing. A cell needs input gate * candidate (numerators are multiplied before their one division), one addition
///   to what is left of the cell state, and the tanh of that; the output gate is multiplied in beside it.
/// - `multiply`: all multiply-adds of the products at the peak. Activations count nothing.
/// - `read`: every weight is read once a step, but for those that could stay in the registers; none faster than the
///   first level of the cache delivers, and those that do not fit into it, even if it held nothing else, no faster than
///   the second.
///
/// A latency is the shortest, and a throughput the highest, of `set` and of the sets below it.
struct StepFloor {
  double chain = 0.0;
  double multiply = 0.0;
  double read = 0.0;

  double ns() const;
};

StepFloor stepFloorParts(const LayerStack& layers, InstructionSet set);

/// How long it takes to read so many bytes as the layers have weights, over and over in the same order; ns. No floor:
/// where the first level of the cache is a little too small, reading there and back by turns is faster, as every pass
/// starts with what the last one has left in it.
double readInOrder(const LayerStack& layers, InstructionSet set);

/// stepFloorParts().ns().
double stepFloor(const LayerStack& layers, InstructionSet set);

/// Multiply-adds of a step's products, all layers together, biases not counted.
double multiplyAddsOfStep(const LayerStack& layers);

}  // namespace lstm_planner
