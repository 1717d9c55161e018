// Included once by each scan_kernels_*.cpp, which are compiled for different instruction sets. Everything but the
// function at the end, SCAN_KERNELS, has internal linkage, as simd.hpp explains.

#include "lstm_planner/base/common/simd.hpp"
#include "robot/perception/beam_kernels_source.hpp"
#include "robot/perception/scan_kernels.hpp"

#if !defined(SCAN_KERNELS)
#error "SCAN_KERNELS names the function that this file defines"
#endif

namespace lstm_planner {
namespace {

using namespace simd;

constexpr float kPi = 3.14159265358979f;

constexpr int kSide = 4;  ///< squares a side of a cell
constexpr int kCellSquares = kSide * kSide;

constexpr float kNear = 0.5f;  ///< m; nearer neighbourhoods may always be cleared

// ---------------------------------------------------------------- vectors

template <class V>
LSTM_PLANNER_INLINE IntegersOf<V> integers(V values) {
  return __builtin_convertvector(values, IntegersOf<V>);
}
template <class V>
LSTM_PLANNER_INLINE V floats(IntegersOf<V> values) {
  return __builtin_convertvector(values, V);
}

template <class V>
LSTM_PLANNER_INLINE IntegersOf<V> loadKeys(const std::uint32_t* keys) {
  IntegersOf<V> vector;
  __builtin_memcpy(&vector, keys, sizeof(V));
  return vector;
}
template <class Integers>
LSTM_PLANNER_INLINE void storeKeys(std::uint32_t* keys, Integers vector) {
  __builtin_memcpy(keys, &vector, sizeof(vector));
}

/// Numbers at some places.
LSTM_PLANNER_INLINE Floats<4> gather(const float* from, IntegersOf<Floats<4>> at) {
  return Floats<4>{from[at[0]], from[at[1]], from[at[2]], from[at[3]]};
}
#if defined(__AVX2__)
LSTM_PLANNER_INLINE Floats<8> gather(const float* from, IntegersOf<Floats<8>> at) {
  return _mm256_i32gather_ps(from, (__m256i)at, sizeof(float));
}
#endif
#if defined(__AVX512F__)
LSTM_PLANNER_INLINE Floats<16> gather(const float* from, IntegersOf<Floats<16>> at) {
  return _mm512_mask_i32gather_ps(Floats<16>{}, 0xffff, (__m512i)at, from, sizeof(float));
}
#endif

/// Stores the lanes that have a bit, one after the other, and anything behind them; returns how many these are.
template <class V, class Number>
LSTM_PLANNER_INLINE std::size_t storeSome(V values, unsigned bits, Number* to) {
  constexpr int kLanes = sizeof(V) / sizeof(Number);
#if defined(__AVX512F__)
  if constexpr (kLanes == 16) {
    const __m512i some = _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), (__m512i)values);
    __builtin_memcpy(to, &some, sizeof(some));
    return static_cast<std::size_t>(__builtin_popcount(bits));
  }
#endif
  std::size_t count = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    // Written in any case, and overwritten by the next: faster than a jump that nobody can foresee.
    to[count] = static_cast<Number>(values[lane]);
    count += bits >> lane & 1;
  }
  return count;
}

/// Calls body(i, V{}) for all of `count`, V wide at first and four lanes wide for the rest.
template <class Body>
LSTM_PLANNER_INLINE void inVectors(std::size_t count, const Body& body) {
  std::size_t i = 0;
  for (; i + kWidest <= count; i += kWidest) body(i, Wide{});
  for (; i < count; i += 4) body(i, Floats<4>{});
}

// ------------------------------------------------------------------ beams

/// Direction of vectors, rad in [0, 2 pi], to 1.2e-5 rad: Abramowitz and Stegun, Handbook of Mathematical Functions,
/// 4.4.49, in the first eighth of a turn.
template <class V>
LSTM_PLANNER_INLINE V directionOf(V x, V y) {
  constexpr float kTiny = 1e-30f;
  const V abs_x = magnitude(x);
  const V abs_y = magnitude(y);
  const V ratio = minimum(abs_x, abs_y) / maximum(maximum(abs_x, abs_y), broadcast<V>(kTiny));
  const V squared = ratio * ratio;
  V sum = multiplyAdd(squared, broadcast<V>(0.0208351f), broadcast<V>(-0.0851330f));
  sum = multiplyAdd(sum, squared, broadcast<V>(0.1801410f));
  sum = multiplyAdd(sum, squared, broadcast<V>(-0.3302995f));
  sum = multiplyAdd(sum, squared, broadcast<V>(0.9998660f));
  V direction = ratio * sum;
  direction = abs_y > abs_x ? broadcast<V>(0.5f * kPi) - direction : direction;
  direction = x < V{} ? broadcast<V>(kPi) - direction : direction;
  return y < V{} ? broadcast<V>(2.0f * kPi) - direction : direction;
}

/// In beams from the first one, from 0 to less than a whole turn.
template <class V>
LSTM_PLANNER_INLINE V positionOf(const FirstBeam& first, V x, V y) {
  const V along_x = broadcast<V>(first.along_x);
  const V along_y = broadcast<V>(first.along_y);
  const V along = multiplyAdd(along_x, x, along_y * y);
  const V aside = broadcast<V>(first.aside) * (along_x * y - along_y * x);
  return directionOf(along, aside) * broadcast<V>(first.beams_a_radian);
}

void find(const FirstBeam& first, const float* x, const float* y, std::size_t count, float* positions) {
  inVectors(
      count, [&](std::size_t i, auto v) __attribute__((always_inline)) {
        using V = decltype(v);
        store(positionOf(first, load<V>(x + i), load<V>(y + i)), positions + i);
      });
}

// ---------------------------------------------------------------- returns

std::size_t squaresOf(const SquareFrame& frame, const double* places, std::size_t count, std::uint32_t* work,
                      std::uint32_t* keys) {
  constexpr std::size_t kChunk = 256;
  float x[kChunk];
  float y[kChunk];
  *work = kNoSquare;
  std::uint32_t* const all = work + 1;
  const auto reach = broadcast<Wide>(frame.farthest);
  for (std::size_t i = 0; i < count; i += kWidest) {
    const std::size_t in_chunk = i % kChunk;
    if (in_chunk == 0) {  // a chunk at once, or the processor would wait for what it has just written
      const std::size_t these = count - i < kChunk ? count - i : kChunk;
      for (std::size_t j = 0; j < these; ++j) {
        x[j] = static_cast<float>(places[2 * (i + j)]);
        y[j] = static_cast<float>(places[2 * (i + j) + 1]);
      }
      for (std::size_t j = these; j % kWidest != 0; ++j) {
        x[j] = x[these - 1];
        y[j] = y[these - 1];
      }
    }
    const Wide xs = load<Wide>(x + in_chunk);
    const Wide ys = load<Wide>(y + in_chunk);
    const auto near = xs * xs + ys * ys <= reach;
    // What is far away may be too much for a whole number.
    const auto columns = integers(near ? frame.cosine * xs - frame.sine * ys + frame.x : Wide{}) + frame.first_column;
    const auto rows = integers(near ? frame.sine * xs + frame.cosine * ys + frame.y : Wide{}) + frame.first_row;
    const auto outside = ~near | (columns < 0) | (columns >= frame.sides) | (rows < 0) | (rows >= frame.sides);
    storeKeys(all + i, ((rows << 16) | columns) | outside);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; i += kWidest) {
    const auto these = loadKeys<Wide>(all + i);
    const auto before = loadKeys<Wide>(all + i - 1);
    kept += storeSome(these, bitsOf((these != before) & (these != -1)), keys + kept);
  }
  return kept;
}

// ------------------------------------------------------------------ sight

/// 1 / sqrt(x) or up to 0.2 % less: an approximation by the bits of a float, and one of Newton's steps.
template <class V>
LSTM_PLANNER_INLINE V inverseRoot(V x) {
  const V guess = (V)(0x5f3759df - ((IntegersOf<V>)x >> 1));
  return guess * (1.5f - 0.5f * x * guess * guess);
}

/// The most of the blocks from the first to the last: two powers of two that overlap.
template <class V>
LSTM_PLANNER_INLINE V farthest(const SightBeams& beams, IntegersOf<V> first, IntegersOf<V> last) {
  constexpr int kMantissa = 23;
  const IntegersOf<V> count = (IntegersOf<V>)floats<V>(last - first + 1);
  const IntegersOf<V> level = (count >> kMantissa) - 127;
  const IntegersOf<V> power_of_two = integers((V)(count & (0xff << kMantissa)));
  const IntegersOf<V> row = (level < beams.levels ? level : IntegersOf<V>{}) * beams.blocks;
  const IntegersOf<V> other = level < beams.levels ? last + 1 - power_of_two : first;
  const V most = maximum(gather(beams.farthest, row + first), gather(beams.farthest, row + other));
  return level < beams.levels ? most : broadcast<V>(kInfinity);
}

/// Square of the distance, m^2, from which on the scan surely clears no place of the neighbourhood of (x, y); 0
/// when it does so nowhere in it.
template <class V>
LSTM_PLANNER_INLINE V limitOf(const SightBeams& beams, V x, V y) {
  // A neighbourhood's half angle is the arc sine of its radius by its distance, less than 1.1 times that less 0.2 %;
  // and a beam is looked for half a beam to each side.
  const float beams_a_metre = 1.1f * beams.neighbourhood * beams.first.beams_a_radian;
  const V squared = multiplyAdd(x, x, y * y);
  const V half = multiplyAdd(broadcast<V>(beams_a_metre), inverseRoot(squared), broadcast<V>(1.0f));
  const V position = positionOf(beams.first, x, y);
  const V first = position - half;
  const V beyond = position + half;
  const V last_beam = broadcast<V>(static_cast<float>(beams.beams - 1));
  const auto inside = (first >= V{}) & (beyond <= last_beam);
  const auto blockOf = [&](V beam) __attribute__((always_inline)) {
    return integers(minimum(maximum(beam, V{}), last_beam)) >> 2;
  };
  const V most = farthest<V>(beams, blockOf(first), blockOf(beyond));
  const V least = most + beams.neighbourhood;  // for the middle, so that something of it may be nearer
  const V limit = least * least > squared ? most * most : V{};
  // At the edges of what the scanner sees a neighbourhood may be half in sight.
  const auto at_edge = (first <= last_beam) | (beyond >= broadcast<V>(beams.beams_a_turn));
  const V beside = at_edge ? broadcast<V>(kInfinity) : V{};
  return squared < broadcast<V>(kNear * kNear) ? broadcast<V>(kInfinity) : inside ? limit : beside;
}

template <class V>
LSTM_PLANNER_INLINE auto isClear(const SightBeams& beams, V x, V y) {
  using Integers = IntegersOf<V>;
  const V position = positionOf(beams.first, x, y);
  const Integers nearest = integers(position + 0.5f);
  // Just before the first beam is nearly a whole turn after it.
  const auto before_first = beams.beams_a_turn - position < broadcast<V>(1.0f);
  const auto beyond_last = position >= broadcast<V>(static_cast<float>(beams.beams));
  const Integers end = before_first ? Integers{} : Integers{} + (beams.beams - 1);
  const auto is_beam = nearest < beams.beams;
  const V limit = gather(beams.limits, is_beam ? nearest : end);
  return (limit > multiplyAdd(x, x, y * y)) & (is_beam | before_first | ~beyond_last);
}

template <class V>
LSTM_PLANNER_INLINE V xOf(const SquareGrid& grid, IntegersOf<V> keys) {
  return multiplyAdd(floats<V>(keys & 0xffff), broadcast<V>(grid.resolution), broadcast<V>(grid.left));
}
template <class V>
LSTM_PLANNER_INLINE V yOf(const SquareGrid& grid, IntegersOf<V> keys) {
  return multiplyAdd(floats<V>(keys >> 16), broadcast<V>(grid.resolution), broadcast<V>(grid.bottom));
}

std::size_t cellsInSight(const SightBeams& beams, const SquareGrid& grid, std::uint32_t* cells, std::size_t count,
                         float* limits) {
  const float to_middle = 0.5f * (kSide - 1) * grid.resolution;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; i += kWidest) {
    const auto keys = loadKeys<Wide>(cells + i);
    const Wide limit = limitOf(beams, xOf<Wide>(grid, keys) + to_middle, yOf<Wide>(grid, keys) + to_middle);
    const unsigned bits = bitsOf(limit > Wide{}) & firstBits(count - i);
    storeSome(limit, bits, limits + kept);
    kept += storeSome(keys, bits, cells + kept);
  }
  return kept;
}

/// A bit for each square of a cell whose distance squared is less than `limit`.
LSTM_PLANNER_INLINE unsigned nearerSquares(const SquareGrid& grid, std::uint32_t cell, float limit) {
  const Floats<4> steps = {0.0f, 1.0f, 2.0f, 3.0f};
  const float x = grid.left + static_cast<float>(cell & 0xffff) * grid.resolution;
  const float y = grid.bottom + static_cast<float>(cell >> 16) * grid.resolution;
  const Floats<4> dx = x + steps * grid.resolution;
  const Floats<4> squared = dx * dx;
  unsigned bits = 0;
  for (int row = 0; row < kSide; ++row) {
    const float dy = y + static_cast<float>(row) * grid.resolution;
    bits |= bitsOf(squared < broadcast<Floats<4>>(limit - dy * dy)) << (kSide * row);
  }
  return bits;
}

LSTM_PLANNER_INLINE std::size_t storeSquares(std::uint32_t cell, unsigned bits, std::uint32_t* keys) {
#if defined(__AVX512F__)
  constexpr int kRow = 1 << 16;
  const IntegersOf<Wide> squares = {0,
                                    1,
                                    2,
                                    3,
                                    kRow,
                                    kRow + 1,
                                    kRow + 2,
                                    kRow + 3,
                                    2 * kRow,
                                    2 * kRow + 1,
                                    2 * kRow + 2,
                                    2 * kRow + 3,
                                    3 * kRow,
                                    3 * kRow + 1,
                                    3 * kRow + 2,
                                    3 * kRow + 3};
  return storeSome(squares + static_cast<int>(cell), bits, keys);
#else
  std::size_t count = 0;
  for (; bits != 0; bits &= bits - 1) {
    const auto square = static_cast<std::uint32_t>(__builtin_ctz(bits));
    keys[count++] = cell + (square / kSide << 16) + square % kSide;
  }
  return count;
#endif
}

std::size_t clearSquares(const SightBeams& beams, const SquareGrid& grid, const std::uint32_t* cells,
                         const float* limits, const std::uint16_t* occupied, std::size_t count, std::uint32_t* clear) {
  std::size_t squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    squares += storeSquares(cells[i], occupied[i] & nearerSquares(grid, cells[i], limits[i]), clear + squares);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < squares; i += kWidest) {
    const auto keys = loadKeys<Wide>(clear + i);
    const auto seen = isClear(beams, xOf<Wide>(grid, keys), yOf<Wide>(grid, keys));
    kept += storeSome(keys, bitsOf(seen) & firstBits(squares - i), clear + kept);
  }
  return kept;
}

}  // namespace

ScanKernels SCAN_KERNELS() { return {&meanings, &sum, &points, &find, &squaresOf, &cellsInSight, &clearSquares}; }

}  // namespace lstm_planner
