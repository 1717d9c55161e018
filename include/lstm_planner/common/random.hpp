#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace lstm_planner {

/// Random numbers that are the same on every machine for the same seed. The standard defines std::mt19937_64 exactly,
/// but not its distributions and std::shuffle; these functions replace them.
using Random = std::mt19937_64;

/// Uniform in [0, 1), 53 bits.
inline double uniform(Random& random) { return static_cast<double>(random() >> 11) * 0x1.0p-53; }

/// Uniform in [low, high).
inline double uniform(Random& random, double low, double high) { return low + (high - low) * uniform(random); }

/// Uniform in 0 .. count - 1; 0 if count is 0.
inline std::size_t uniformIndex(Random& random, std::size_t count) {
  if (count <= 1) return 0;
  const std::uint64_t size = count;
  // The numbers above the largest multiple of `size` are drawn again, so that none is likelier than another.
  const std::uint64_t excess = (UINT64_MAX % size + 1) % size;
  std::uint64_t draw = random();
  while (draw > UINT64_MAX - excess) draw = random();
  return static_cast<std::size_t>(draw % size);
}

/// Mean 0, standard deviation 1: the sum of twelve uniform numbers, minus 6. Unlike transforms with logarithm and
/// cosine, it is rounded in the same way on every machine. Values beyond four deviations are rarer than in the normal
/// distribution, and none is beyond six.
inline double normal(Random& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += uniform(random);
  return sum;
}

/// Puts the elements in a random order (Fisher and Yates); every order has the same probability.
template <typename T>
void shuffle(std::vector<T>* elements, Random& random) {
  for (std::size_t left = elements->size(); left > 1; --left) {
    std::swap((*elements)[left - 1], (*elements)[uniformIndex(random, left)]);
  }
}

}  // namespace lstm_planner
