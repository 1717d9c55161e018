#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

namespace lstm_planner {

/// Processes ("ranks") that share one piece of work; this base class is one process alone.
///
/// Every rank holds the whole state, does its part of the work, and exchanges what came out with all others. Each then
/// adds the parts up in the order in which one process alone would: the result is the same, bit for bit, for any number
/// of ranks on machines that round alike, and so is the state that every rank goes on with.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }

  /// `values` holds one part for each rank, in their order, part r of bytes[r] bytes, of which the caller has filled in
  /// its own; afterwards all are there. Every rank has to call it, with the same `bytes`.
  virtual void exchangeBytes(void* values, const std::vector<std::size_t>& bytes);
};

/// The part [first, last) of `count` pieces of work that falls to a rank, as equal as can be.
struct Share {
  int first = 0;
  int last = 0;
  int count() const { return last - first; }
};
Share shareOf(int count, int rank, int size);

/// Communicator::exchangeBytes() for the results of `count` pieces of work, `width` values each, that were done as
/// shareOf() says.
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

/// The largest of the ranks' numbers. Every rank has to ask.
int largestOfRanks(Communicator* communicator, int own);

/// Where a parameter struct names no communicator.
Communicator* oneProcess();

}  // namespace lstm_planner
