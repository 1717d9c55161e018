#include "drive/local_map/return_squares.hpp"

#include <algorithm>

#include "drive/perception/baseline_vectors.hpp"

namespace lstm_planner {
namespace {

/// Of a place that has none, or is out of reach: all bits.
constexpr std::uint32_t kNoSquare = ~std::uint32_t{0};

Ints toInts(Floats values) { return __builtin_convertvector(values, Ints); }

/// keyOf() the squares of four places.
Ints keysOf(const SquareFrame& frame, const Point2* places) {
  Floats x;
  Floats y;
  for (int lane = 0; lane < kLanes; ++lane) {
    x[lane] = static_cast<float>(places[lane].x);
    y[lane] = static_cast<float>(places[lane].y);
  }
  const Ints near = x * x + y * y <= allOf(frame.farthest);
  // What is far away may be too much for a whole number.
  const Ints columns = toInts(near ? frame.cosine * x - frame.sine * y + frame.x : Floats{}) + frame.first_column;
  const Ints rows = toInts(near ? frame.sine * x + frame.cosine * y + frame.y : Floats{}) + frame.first_row;
  const Ints outside = ~near | (columns < 0) | (columns >= frame.sides) | (rows < 0) | (rows >= frame.sides);
  return ((rows << 16) | columns) | outside;
}

}  // namespace

void findSquares(const SquareFrame& frame, const std::vector<Point2>& places, std::vector<std::uint32_t>* keys) {
  keys->resize(places.size() + kLanes);
  std::uint32_t* const all = keys->data();
  const auto store = [all](std::size_t first, Ints four) { __builtin_memcpy(all + first, &four, sizeof(four)); };
  std::size_t i = 0;
  for (; i + kLanes <= places.size(); i += kLanes) store(i, keysOf(frame, &places[i]));
  if (i < places.size()) {
    Point2 rest[kLanes] = {};
    std::copy(places.begin() + static_cast<std::ptrdiff_t>(i), places.end(), rest);
    store(i, keysOf(frame, rest));
  }
  std::size_t kept = 0;
  std::uint32_t before = kNoSquare;
  for (i = 0; i < places.size(); ++i) {
    const std::uint32_t key = all[i];
    // Written in any case, and overwritten by the next: faster than a jump that nobody can foresee.
    all[kept] = key;
    kept += key != before && key != kNoSquare ? 1 : 0;
    before = key;
  }
  keys->resize(kept);
}

}  // namespace lstm_planner
