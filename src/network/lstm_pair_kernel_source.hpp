#pragma once

// The part of step_kernel_source.hpp for whole networks; compiled like it, and with internal linkage like it.

#if defined(__AVX2__)

namespace lstm_planner {
namespace {

/// Two LSTMs of eight cells and a dense layer of five to eight outputs in one go. With one vector a gate, the second
/// layer and the dense one take what they read from registers, where a layer by itself waits until the last one has
/// stored it.
class LstmPair {
 public:
  static bool fits(const LayerShape* shapes, int count) {
    return count == 3 && isLstm(shapes[0]) && isLstm(shapes[1]) && shapes[2].kind == LayerKind::kDense &&
           shapes[2].units > kCells / 2 && shapes[2].units <= kCells;
  }

  /// Products that wait for nothing stand where the processor would otherwise wait for activations.
  static bool step(const PackedLayer* layers, const LayerValues* values) {
    V watched = {};
    V first_sums[kGates];
    loadColumn(values[0].sums, first_sums);
    multiplyAddInput(layers[0].input, values[0].input, first_sums);
    V second_sums[kGates];
    loadColumn(layers[1].bias.weights, second_sums);
    multiplyAddMatrix(layers[1].recurrent, values[1].last_output, second_sums);
    const V first_output = finishLstm(first_sums, values[0], &watched);

    multiplyAddLanes(layers[1].input, first_output, second_sums);
    loadColumn(layers[0].bias.weights, first_sums);
    multiplyAddMatrix(layers[0].recurrent, values[0].output, first_sums);
    for (int gate = 0; gate < kGates; ++gate) store(values[0].next_sums + gate * kCells, first_sums[gate]);
    const V second_output = finishLstm(second_sums, values[1], &watched);

    const LayerShape& dense = layers[2].shape;
    V sums[1] = {load<V>(layers[2].bias.weights)};
    multiplyAddLanes(layers[2].input, second_output, sums);
    storeFirst(values[2].output, activated(dense.activation, sums[0]), dense.units);
    watch(sums[0], &watched);
    return noneIsNan(watched);
  }

 private:
  typedef Floats<8> V;
  static constexpr int kCells = kLanesOf<V>;
  static constexpr int kGates = 4;

  static bool isLstm(const LayerShape& shape) {
    return shape.kind == LayerKind::kLstm && shape.activation == StepActivation::kTanh && shape.units == kCells;
  }

  static LSTM_PLANNER_INLINE void loadColumn(const float* column, V (&sums)[kGates]) {
    for (int gate = 0; gate < kGates; ++gate) sums[gate] = load<V>(column + gate * kCells);
  }

  /// In two parts, as TiledLayer has it: a recurrent product that it has prepared is the same to the last bit.
  static LSTM_PLANNER_INLINE void multiplyAddMatrix(const PackedMatrix& matrix, const float* x, V (&sums)[kGates]) {
    multiplyAddColumns<V, kGates, 2>(matrix.weights, kGates * kCells, x, matrix.columns, sums);
  }

  /// From the last column to the first: where a network reads its own last output, it does so at input 0.
  static LSTM_PLANNER_INLINE void multiplyAddInput(const PackedMatrix& matrix, const float* x, V (&sums)[kGates]) {
    for (int column = matrix.columns - 1; column >= 0; --column) {
      const V factor = broadcast<V>(x[column]);
      for (int gate = 0; gate < kGates; ++gate) {
        const V weight = load<V>(matrix.weights + (column * kGates + gate) * kCells);
        sums[gate] = multiplyAdd(weight, factor, sums[gate]);
      }
    }
  }

  /// sums += matrix * x, in as many parts side by side as the registers have room for.
  template <int kSums>
  static LSTM_PLANNER_INLINE void multiplyAddLanes(const PackedMatrix& matrix, V x, V (&sums)[kSums]) {
    constexpr int kParts = kSums == 1 || kWidest == 16 ? 4 : 2;
    V parts[kParts][kSums];
#pragma GCC unroll 8
    for (int column = 0; column < kCells; ++column) {
      const V factor = broadcastLane(x, column);
#pragma GCC unroll 4
      for (int sum = 0; sum < kSums; ++sum) {
        const V weight = load<V>(matrix.weights + (column * kSums + sum) * kCells);
        V& part = parts[column % kParts][sum];
        part = column == 0      ? multiplyAdd(weight, factor, sums[sum])
               : column < kParts ? weight * factor
                                 : multiplyAdd(weight, factor, part);
      }
    }
#pragma GCC unroll 4
    for (int sum = 0; sum < kSums; ++sum) {
      sums[sum] = parts[0][sum] + parts[1][sum];
      if constexpr (kParts == 4) sums[sum] += parts[2][sum] + parts[3][sum];
    }
  }

  /// The rest of an LSTM's step; the result is its outputs.
  static LSTM_PLANNER_INLINE V finishLstm(const V (&sums)[kGates], const LayerValues& values, V* watched) {
    const LstmCells<V> cells =
        lstmCells<V, StepActivation::kTanh>(Group<V, kGates>{{sums[0], sums[1], sums[2], sums[3]}}, values.cells);
    const TanhTerms<V> terms = tanhTerms(cells.cell);
    const V output = (cells.half_output_gate.numerator * terms.limited_x * terms.p) /
                     (cells.half_output_gate.denominator * terms.q);
    store(values.output, output);
    store(values.next_cells, cells.cell);
    watch(cells.cell, watched);
    for (int gate = 0; gate < kGates; ++gate) watch(sums[gate], watched);
    return output;
  }
};

}  // namespace
}  // namespace lstm_planner

#endif
