#pragma once

// The part of step_kernel_source.hpp for whole networks; compiled like it, and with internal linkage like it.

#if defined(__AVX2__)

namespace lstm_planner {
namespace {

/// One lane in all, without a path through memory.
template <class V>
LSTM_PLANNER_INLINE V broadcastLane(Floats<8> v, int lane) {
#if defined(__AVX512F__)
  if constexpr (kLanesOf<V> == 16) {
    return _mm512_maskz_permutexvar_ps(0xffff, _mm512_set1_epi32(lane), _mm512_castps256_ps512(v));
  } else
#endif
  {
    return _mm256_permutevar8x32_ps(v, _mm256_set1_epi32(lane));
  }
}

#if defined(__AVX512F__)
// With a mask of all lanes where there is one to choose, as in simd.hpp.
LSTM_PLANNER_INLINE Floats<8> lowHalf(Floats<16> v) { return _mm512_maskz_extractf32x8_ps(0xff, v, 0); }
LSTM_PLANNER_INLINE Floats<8> highHalf(Floats<16> v) { return _mm512_maskz_extractf32x8_ps(0xff, v, 1); }
#endif

/// Two LSTMs of eight cells and a dense layer of five to eight outputs in one go. The second layer and the dense one
/// take what they read from registers, where a layer by itself waits until the last one has stored it. A vector of
/// sixteen lanes takes two gates at a time, where a layer by itself would fill only half of it.
class LstmPair {
 public:
  static bool fits(const LayerShape* shapes, int count) {
    return count == 3 && isLstm(shapes[0]) && isLstm(shapes[1]) && shapes[2].kind == LayerKind::kDense &&
           shapes[2].units > kCells / 2 && shapes[2].units <= kCells;
  }

  /// Products that wait for nothing stand where the processor would otherwise wait for activations.
  static bool step(const PackedLayer* layers, const LayerValues* values) {
    Cells watched = {};
    Sums watched_sums = {};
    Sums first_sums[kSums];
    loadColumn(values[0].sums, first_sums);
    multiplyAddInput(layers[0].input, values[0].input, first_sums);
    Sums second_sums[kSums];
    loadColumn(layers[1].bias.weights, second_sums);
    multiplyAddRecurrent(layers[1].recurrent, values[1].last_output, second_sums);
    const Cells first_output = finishLstm(first_sums, values[0], &watched_sums, &watched);

    multiplyAddLanes(layers[1].input, first_output, second_sums);
    const Cells second_output = finishLstm(second_sums, values[1], &watched_sums, &watched);
    loadColumn(layers[0].bias.weights, first_sums);
    multiplyAddRecurrent(layers[0].recurrent, values[0].output, first_sums);
    for (int i = 0; i < kSums; ++i) store(first_sums[i], values[0].next_sums + i * kLanesOf<Sums>);

    const LayerShape& dense = layers[2].shape;
    Cells sums[1] = {load<Cells>(layers[2].bias.weights)};
    multiplyAddLanes(layers[2].input, second_output, sums);
    storeFirst(activated(dense.activation, sums[0]), dense.units, values[2].output);
    watch(sums[0], &watched);
    return noneIsNan(watched) && noneIsNan(watched_sums);
  }

 private:
  typedef Floats<8> Cells;
  typedef Floats<kWidest> Sums;
  static constexpr int kCells = kLanesOf<Cells>;
  static constexpr int kGates = 4;
  static constexpr int kColumn = kGates * kCells;
  static constexpr int kSums = kColumn / kLanesOf<Sums>;

  static bool isLstm(const LayerShape& shape) {
    return shape.kind == LayerKind::kLstm && shape.activation == Activation::kTanh && shape.units == kCells;
  }

  static LSTM_PLANNER_INLINE void loadColumn(const float* column, Sums (&sums)[kSums]) {
    for (int i = 0; i < kSums; ++i) sums[i] = load<Sums>(column + i * kLanesOf<Sums>);
  }

  /// In two parts, as TiledLayer has it: a recurrent product that it has prepared is the same to the last bit.
  static LSTM_PLANNER_INLINE void multiplyAddRecurrent(const PackedMatrix& matrix, const float* x,
                                                       Sums (&sums)[kSums]) {
    multiplyAddColumns<Sums, kSums, 2>(matrix.weights, kColumn, x, kCells, sums);
  }

  /// From the last column to the first: where a network reads its own last output, it does so at input 0.
  static LSTM_PLANNER_INLINE void multiplyAddInput(const PackedMatrix& matrix, const float* x, Sums (&sums)[kSums]) {
    for (int column = matrix.columns - 1; column >= 0; --column) {
      const Sums factor = broadcast<Sums>(x[column]);
      for (int i = 0; i < kSums; ++i) {
        const Sums weight = load<Sums>(matrix.weights + column * kColumn + i * kLanesOf<Sums>);
        sums[i] = multiplyAdd(weight, factor, sums[i]);
      }
    }
  }

  /// sums += matrix * x, in as many parts side by side as the registers have room for.
  template <class V, int kCount>
  static LSTM_PLANNER_INLINE void multiplyAddLanes(const PackedMatrix& matrix, Cells x, V (&sums)[kCount]) {
    constexpr int kParts = kCount == 1 || kWidest == 16 ? 4 : 2;
    V parts[kParts][kCount];
#pragma GCC unroll 8
    for (int column = 0; column < kCells; ++column) {
      const V factor = broadcastLane<V>(x, column);
#pragma GCC unroll 4
      for (int i = 0; i < kCount; ++i) {
        const V weight = load<V>(matrix.weights + (column * kCount + i) * kLanesOf<V>);
        V& part = parts[column % kParts][i];
        part = column == 0       ? multiplyAdd(weight, factor, sums[i])
               : column < kParts ? weight * factor
                                 : multiplyAdd(weight, factor, part);
      }
    }
#pragma GCC unroll 4
    for (int i = 0; i < kCount; ++i) {
      sums[i] = parts[0][i] + parts[1][i];
      if constexpr (kParts == 4) sums[i] += parts[2][i] + parts[3][i];
    }
  }

  /// lstmCells() for the gates in whatever vectors they are.
  static LSTM_PLANNER_INLINE LstmCells<Cells> cellsOf(const Floats<8> (&sums)[4], const float* cells) {
    return lstmCells<Cells, Activation::kTanh>(Group<Cells, 4>{{sums[0], sums[1], sums[2], sums[3]}}, cells);
  }
#if defined(__AVX512F__)
  /// Input gate and forget gate, candidate and output gate: what is multiplied first lies in the same lanes.
  static LSTM_PLANNER_INLINE LstmCells<Cells> cellsOf(const Floats<16> (&sums)[2], const float* cells) {
    typedef Floats<16> V;
    const TanhTerms<Group<V, 2>> terms = tanhTerms(Group<V, 2>{{sums[0], sums[1]}});
    const V input_forget = multiplyAdd(terms.limited_x.of[0], terms.p.of[0], terms.q.of[0]);
    const V half_candidate = broadcast<V>(kHalf) * terms.limited_x.of[1] * terms.p.of[1];
    const V output = multiplyAdd(terms.limited_x.of[1], terms.p.of[1], terms.q.of[1]);
    const Cells update = lowHalf(input_forget * half_candidate) / lowHalf(terms.q.of[0] * terms.q.of[1]);
    const Cells forget = highHalf(input_forget) / highHalf(terms.q.of[0]);
    const Cells half = broadcast<Cells>(kHalf);
    return {multiplyAdd(forget, half * load<Cells>(cells), update), {half * highHalf(output), highHalf(terms.q.of[1])}};
  }
#endif

  /// The rest of an LSTM's step; the result is its outputs.
  static LSTM_PLANNER_INLINE Cells finishLstm(const Sums (&sums)[kSums], const LayerValues& values, Sums* watched_sums,
                                              Cells* watched) {
    const LstmCells<Cells> cells = cellsOf(sums, values.cells);
    const TanhTerms<Cells> terms = tanhTerms(cells.cell);
    const Cells output =
        (cells.half_output_gate.numerator * terms.limited_x * terms.p) / (cells.half_output_gate.denominator * terms.q);
    store(output, values.output);
    store(cells.cell, values.next_cells);
    watch(cells.cell, watched);
    for (int i = 0; i < kSums; ++i) watch(sums[i], watched_sums);
    return output;
  }
};

}  // namespace
}  // namespace lstm_planner

#endif
