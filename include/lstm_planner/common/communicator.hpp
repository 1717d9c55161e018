#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace lstm_planner {

/// Gives out the numbers 0 to count - 1 among all ranks and their threads, each number once: a thread that has time
/// takes the next piece of work.
class Tickets {
 public:
  virtual ~Tickets() = default;
  /// The next number; `count` if there is none left. Every thread must draw until it gets `count`. May be called from
  /// several threads at once.
  virtual std::size_t draw() = 0;
  /// Lets other ranks draw, as draw() also does. Call it often during a long piece of work.
  virtual void letOthersDraw() {}
};

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

  /// Numbers for `count` pieces of work. Every rank must call this with the same `count`.
  virtual std::unique_ptr<Tickets> tickets(std::size_t count);
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

/// Gives every rank the values of all ranks, those of the first rank first. Every rank must call this.
template <typename Value>
std::vector<Value> gatherFromRanks(Communicator* communicator, const std::vector<Value>& own) {
  static_assert(std::is_trivially_copyable_v<Value>, "values are sent as bytes");
  std::vector<std::size_t> counts(static_cast<std::size_t>(communicator->size()), own.size());
  exchangeShares(communicator, communicator->size(), 1, counts.data());
  std::size_t before = 0;
  std::size_t total = 0;
  std::vector<std::size_t> bytes;
  for (std::size_t rank = 0; rank < counts.size(); ++rank) {
    if (static_cast<int>(rank) < communicator->rank()) before += counts[rank];
    total += counts[rank];
    bytes.push_back(counts[rank] * sizeof(Value));
  }
  std::vector<Value> values(total);
  std::copy(own.begin(), own.end(), values.begin() + static_cast<std::ptrdiff_t>(before));
  communicator->exchangeBytes(values.data(), bytes);
  return values;
}

/// The largest of the ranks' numbers. Every rank must call this.
int largestOfRanks(Communicator* communicator, int own);

/// The default of parameter structs: a single process.
Communicator* oneProcess();

}  // namespace lstm_planner
