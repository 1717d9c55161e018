// Included once by each step_kernel_*.cpp, which are compiled for different instruction sets. Everything but the
// function at the end, LAYER_KERNEL, has internal linkage, as simd.hpp explains.

#include "network/network_functions.hpp"
#include "network/step_kernel.hpp"

#if !defined(LAYER_KERNEL)
#error "LAYER_KERNEL names the function that this file defines"
#endif

namespace lstm_planner {
namespace {

using namespace simd;

constexpr float kHalf = 0.5f;

/// sums += weights * x for a tile, `kSums` vectors high. Sums that wait for one another would leave the processor idle
/// where a tile is small: `kParts` of them are made side by side, each from every kParts-th column.
template <class V, int kSums, int kParts>
LSTM_PLANNER_INLINE void multiplyAddColumns(const float* weights, const float* x, int columns, V (&sums)[kSums]) {
  V parts[kParts][kSums];
#pragma GCC unroll 16
  for (int sum = 0; sum < kSums; ++sum) {
    parts[0][sum] = sums[sum];
    for (int part = 1; part < kParts; ++part) parts[part][sum] = V{};
  }
  const auto multiplyAddColumn = [&](int part, int column) __attribute__((always_inline)) {
    const V factor = broadcast<V>(x[column]);
#pragma GCC unroll 16
    for (int sum = 0; sum < kSums; ++sum) {
      const V weight = load<V>(weights + (column * kSums + sum) * kLanesOf<V>);
      parts[part][sum] = multiplyAdd(weight, factor, parts[part][sum]);
    }
  };
  int column = 0;
  for (; column < columns % kParts; ++column) multiplyAddColumn(0, column);
  for (; column < columns; column += kParts) {
#pragma GCC unroll 4
    for (int part = 0; part < kParts; ++part) multiplyAddColumn(part, column + part);
  }
#pragma GCC unroll 16
  for (int sum = 0; sum < kSums; ++sum) {
    for (int step = 1; step < kParts; step *= 2) {
      for (int part = 0; part < kParts; part += 2 * step) parts[part][sum] += parts[part + step][sum];
    }
    sums[sum] = parts[0][sum];
  }
}

/// 0 in each lane while all values are finite, NaN from then on.
template <class V>
LSTM_PLANNER_INLINE void watch(V value, V* watched) {
  *watched = multiplyAdd(value, V{}, *watched);
}

/// Of a block, up to the cell states.
template <class V>
struct LstmCells {
  V cell;
  Fraction<V> half_output_gate;
};

/// Equations in LstmLayer, from the sums of the four gates: two and two side by side, as the registers do not hold
/// more.
template <class V, Activation kCandidate>
LSTM_PLANNER_INLINE LstmCells<V> lstmCells(const Group<V, 4>& sums, const float* cells) {
  const V half = broadcast<V>(kHalf);
  const auto twiceSigmoid = [](const TanhTerms<Group<V, 2>>& terms, int gate) __attribute__((always_inline)) {
    return multiplyAdd(terms.limited_x.of[gate], terms.p.of[gate], terms.q.of[gate]);
  };
  const TanhTerms<Group<V, 2>> input_candidate = tanhTerms(Group<V, 2>{{sums.of[0], sums.of[2]}});
  const V half_candidate = kCandidate == Activation::kTanh
                               ? half * input_candidate.limited_x.of[1] * input_candidate.p.of[1]
                               : half * half * twiceSigmoid(input_candidate, 1);
  const V update =
      (twiceSigmoid(input_candidate, 0) * half_candidate) / (input_candidate.q.of[0] * input_candidate.q.of[1]);
  const TanhTerms<Group<V, 2>> forget_output = tanhTerms(Group<V, 2>{{sums.of[1], sums.of[3]}});
  const V forget = twiceSigmoid(forget_output, 0) / forget_output.q.of[0];
  return {multiplyAdd(forget, half * load<V>(cells), update),
          {half * twiceSigmoid(forget_output, 1), forget_output.q.of[1]}};
}

/// The rest of an LSTM's step for the blocks of a tile.
template <class V, Activation kCandidate, int kBlocks>
LSTM_PLANNER_INLINE void lstmBlocks(const V (&sums)[4 * kBlocks], int first_unit, int units, const LayerValues& values,
                                    V* watched) {
  Group<V, kBlocks> cell;
  Group<V, kBlocks> gate_numerator;
  Group<V, kBlocks> gate_denominator;
#pragma GCC unroll 4
  for (int block = 0; block < kBlocks; ++block) {
    const Group<V, 4> gates = {
        {sums[block], sums[kBlocks + block], sums[2 * kBlocks + block], sums[3 * kBlocks + block]}};
    const LstmCells<V> cells = lstmCells<V, kCandidate>(gates, values.cells + first_unit + block * kLanesOf<V>);
    cell.of[block] = cells.cell;
    gate_numerator.of[block] = cells.half_output_gate.numerator;
    gate_denominator.of[block] = cells.half_output_gate.denominator;
  }
  const TanhTerms<Group<V, kBlocks>> terms = tanhTerms(cell);
  const Group<V, kBlocks> output = (gate_numerator * terms.limited_x * terms.p) / (gate_denominator * terms.q);
#pragma GCC unroll 4
  for (int block = 0; block < kBlocks; ++block) {
    const int unit = first_unit + block * kLanesOf<V>;
    storeFirst(output.of[block], units - unit, values.output + unit);
    storeFirst(cell.of[block], units - unit, values.next_cells + unit);
    watch(cell.of[block], watched);
  }
#pragma GCC unroll 16
  for (int sum = 0; sum < 4 * kBlocks; ++sum) watch(sums[sum], watched);
}

template <class V>
LSTM_PLANNER_INLINE V activated(Activation activation, V sum) {
  switch (activation) {
    case Activation::kIdentity:
      return sum;
    case Activation::kTanh:
      return simd::tanh(sum);
    case Activation::kSigmoid:
      return sigmoid(sum);
    case Activation::kRelu:
      return maximum(sum, V{});
  }
  return sum;
}

/// One kind of layer in vectors V, in tiles of at most kMostBlocks blocks; of kUnits units, or of any number if that is
/// 0.
template <class V, LayerKind kKind, Activation kCandidate, int kMostBlocks, int kUnits>
struct TiledLayer {
  static LSTM_PLANNER_INLINE int units(const PackedLayer& layer) { return kUnits > 0 ? kUnits : layer.shape.units; }

  static constexpr int kGates = kKind == LayerKind::kLstm ? 4 : 1;

  /// Where a tile starts: its first unit, and the vectors that lie before it in the layer's sums.
  struct Place {
    int unit = 0;
    int vector = 0;
  };

  /// Sums of small tiles are split until there are as many as a processor has multiplications under way.
  static constexpr int parts(int sums) { return sums >= 8 ? 1 : sums >= 4 ? 2 : 4; }

  template <int kBlocks>
  static LSTM_PLANNER_INLINE void multiplyAddTile(const PackedMatrix& matrix, const float* start, const float* x,
                                                  int columns, Place place, V (&sums)[kGates * kBlocks]) {
    constexpr int kSums = kGates * kBlocks;
#pragma GCC unroll 16
    for (int sum = 0; sum < kSums; ++sum) sums[sum] = load<V>(start + (place.vector + sum) * kLanesOf<V>);
    const float* weights = matrix.weights + place.vector * kLanesOf<V> * matrix.columns;
    multiplyAddColumns<V, kSums, parts(kSums)>(weights, x, columns, sums);
  }

  template <int kBlocks>
  static LSTM_PLANNER_INLINE void recurrentTile(const PackedLayer& layer, const float* outputs, float* all_sums,
                                                Place* place) {
    V sums[kGates * kBlocks];
    multiplyAddTile<kBlocks>(layer.recurrent, layer.bias.weights, outputs, units(layer), *place, sums);
#pragma GCC unroll 16
    for (int sum = 0; sum < kGates * kBlocks; ++sum) store(sums[sum], all_sums + (place->vector + sum) * kLanesOf<V>);
    place->unit += kBlocks * kLanesOf<V>;
    place->vector += kBlocks * kGates;
  }

  static void recurrentSums(const PackedLayer& layer, const float* outputs, float* sums) {
    Place place;
    if constexpr (kMostBlocks >= 4) {
      while (blocksLeft(layer, place) >= 4) recurrentTile<4>(layer, outputs, sums, &place);
    }
    if constexpr (kMostBlocks >= 2) {
      while (blocksLeft(layer, place) >= 2) recurrentTile<2>(layer, outputs, sums, &place);
    }
    while (blocksLeft(layer, place) >= 1) recurrentTile<1>(layer, outputs, sums, &place);
  }

  template <int kBlocks>
  static LSTM_PLANNER_INLINE void advanceTile(const PackedLayer& layer, const LayerValues& values, V* watched,
                                              Place* place) {
    const float* start = kKind == LayerKind::kDense ? layer.bias.weights : values.sums;
    V sums[kGates * kBlocks];
    multiplyAddTile<kBlocks>(layer.input, start, values.input, layer.input.columns, *place, sums);
    if constexpr (kKind == LayerKind::kLstm) {
      lstmBlocks<V, kCandidate, kBlocks>(sums, place->unit, units(layer), values, watched);
    } else {
#pragma GCC unroll 4
      for (int block = 0; block < kBlocks; ++block) {
        const int unit = place->unit + block * kLanesOf<V>;
        const V output =
            kKind == LayerKind::kRecurrent ? simd::tanh(sums[block]) : activated(layer.shape.activation, sums[block]);
        storeFirst(output, units(layer) - unit, values.output + unit);
        watch(sums[block], watched);
      }
    }
    place->unit += kBlocks * kLanesOf<V>;
    place->vector += kBlocks * kGates;
  }

  static bool advance(const PackedLayer& layer, const LayerValues& values) {
    Place place;
    V watched = {};
    if constexpr (kMostBlocks >= 4) {
      while (blocksLeft(layer, place) >= 4) advanceTile<4>(layer, values, &watched, &place);
    }
    if constexpr (kMostBlocks >= 2) {
      while (blocksLeft(layer, place) >= 2) advanceTile<2>(layer, values, &watched, &place);
    }
    while (blocksLeft(layer, place) >= 1) advanceTile<1>(layer, values, &watched, &place);
    return noneIsNan(watched);
  }

  static LSTM_PLANNER_INLINE int blocksLeft(const PackedLayer& layer, Place place) {
    return (units(layer) - place.unit + kLanesOf<V> - 1) / kLanesOf<V>;
  }
};

/// Probabilities are the same for preferences shifted by a constant; with the largest at 0 no exponential overflows.
bool softmax(const PackedLayer& layer, const LayerValues& values) {
  typedef Floats<4> V;
  const int count = layer.shape.units;
  float largest = values.input[0];
  for (int unit = 1; unit < count; ++unit) largest = values.input[unit] > largest ? values.input[unit] : largest;
  float sum = 0.0f;
  for (int unit = 0; unit < count; unit += kLanesOf<V>) {
    storeFirst(exponential(load<V>(values.input + unit) - broadcast<V>(largest)), count - unit, values.output + unit);
  }
  for (int unit = 0; unit < count; ++unit) sum += values.output[unit];
  for (int unit = 0; unit < count; ++unit) values.output[unit] /= sum;
  return true;
}

template <class V, LayerKind kKind, Activation kCandidate, int kMostBlocks, int kUnits = 0>
LayerKernel tiled() {
  using Layer = TiledLayer<V, kKind, kCandidate, kMostBlocks, kUnits>;
  return {kLanesOf<V>, kMostBlocks, &Layer::recurrentSums, &Layer::advance};
}

template <class V, int kMostBlocks>
LayerKernel lstm(const LayerShape& shape) {
  if (shape.activation == Activation::kSigmoid) {
    return tiled<V, LayerKind::kLstm, Activation::kSigmoid, kMostBlocks>();
  }
  switch (shape.units) {
    case 8:
      return tiled<V, LayerKind::kLstm, Activation::kTanh, kMostBlocks, 8>();
    case 16:
      return tiled<V, LayerKind::kLstm, Activation::kTanh, kMostBlocks, 16>();
    case 32:
      return tiled<V, LayerKind::kLstm, Activation::kTanh, kMostBlocks, 32>();
    case 64:
      return tiled<V, LayerKind::kLstm, Activation::kTanh, kMostBlocks, 64>();
    default:
      return tiled<V, LayerKind::kLstm, Activation::kTanh, kMostBlocks>();
  }
}

template <class V>
LayerKernel layerKernel(const LayerShape& shape) {
  switch (shape.kind) {
    case LayerKind::kLstm:
      return lstm<V, 2>(shape);
    case LayerKind::kRecurrent:
      return tiled<V, LayerKind::kRecurrent, Activation::kTanh, 4>();
    case LayerKind::kDense:
      return shape.units == 8 ? tiled<V, LayerKind::kDense, Activation::kIdentity, 4, 8>()
                              : tiled<V, LayerKind::kDense, Activation::kIdentity, 4>();
    case LayerKind::kSoftmax:
      break;
  }
  return {4, 1, nullptr, &softmax};
}

}  // namespace

LayerKernel LAYER_KERNEL(const LayerShape& shape) {
#if defined(__AVX512F__)
  if (shape.units > 8) return layerKernel<Floats<16>>(shape);
#endif
#if defined(__AVX__)
  if (shape.units > 4) return layerKernel<Floats<8>>(shape);
#endif
  return layerKernel<Floats<4>>(shape);
}

}  // namespace lstm_planner
