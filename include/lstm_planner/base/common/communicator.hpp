#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

namespace lstm_planner {

/// Processes ("ranks") that share a computation. This base class is a single process.
///
/// Every rank holds the whole state, does its part of the work, and exchanges the results with all others. Then each
/// rank adds up the parts in the same order as a single process does. So the result and the state on every rank are the
/// same, bit for bit, for any number of ranks, on machines that round in the same way.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }

  /// Gives every rank the parts of all ranks. `values` holds one part for each rank, in the order of the ranks; part r
  /// has bytes[r] bytes. The caller has filled in its own part. Every rank must call this, with the same `bytes`.
  virtual void exchangeBytes(void* values, const std::vector<std::size_t>& bytes);
};

/// The pieces of work [first, last) of `count` pieces that a rank does. The parts are as equal as possible.
struct Share {
  int first = 0;
  int last = 0;
  int count() const { return last - first; }
};
Share shareOf(int count, int rank, int size);

/// Communicator::exchangeBytes() for the results of `count` pieces of work that were divided as in shareOf(). Each
/// piece has `width` values.
template <typename Value>
void exchangeShares(Communicator* communicator, int count, std::size_t width, Value* values) {
  static_assert(std::is_trivially_copyable_v<Value>, "values are sent as bytes");
  std::vector<std::size_t> bytes;
  for (int rank = 0; rank < communicator->size(); ++rank) {
    const auto pieces = static_cast<std::size_t>(shareOf(count, rank, communicator->size()).count());
    bytes.push_back(pieces * width * sizeof(Value));
  }
  communicator->exchangeBytes(values, bytes);
}

/// The largest of the ranks' numbers. Every rank must call this.
int largestOfRanks(Communicator* communicator, int own);

/// The default of parameter structs: a single process.
Communicator* oneProcess();

}  // namespace lstm_planner
