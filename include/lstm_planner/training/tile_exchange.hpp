#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "lstm_planner/common/communicator.hpp"
#include "lstm_planner/common/parallel_for.hpp"

namespace lstm_planner {

/// The numbers of a sum, which are added up, and exchanged by ranks. A sum of another type has a function of its own,
/// in the same namespace.
inline std::vector<double*> numbersOf(double* sum) { return {sum}; }

/// Adds the numbers of another sum.
template <typename Sum>
void addTo(Sum* sum, Sum more) {
  const std::vector<double*> numbers = numbersOf(sum);
  const std::vector<double*> added = numbersOf(&more);
  for (std::size_t i = 0; i < numbers.size(); ++i) *numbers[i] += *added[i];
}

/// Shares the tiles (pieces of work) of an update among ranks and threads, and adds up their results in the order of
/// the tiles. So the result is the same for any number of both. Every rank must make the same calls.
class TileExchange {
 public:
  TileExchange(Communicator* ranks, int threads) : ranks_(*ranks), threads_(threads) {}

  /// The sum of the results of `work(tile, thread)` over so many tiles. `zero`: the sum over nothing.
  template <typename Sum, typename Work>
  Sum run(int tiles, const Sum& zero, const Work& work) const {
    std::vector<Sum> sums(static_cast<std::size_t>(tiles), zero);
    const Share own = ownOf(tiles);
    parallelFor(own.count(), threads_, [&](int index, int thread) {
      const int tile = own.first + index;
      sums[static_cast<std::size_t>(tile)] = work(tile, thread);
    });
    exchange(&sums);
    Sum all = zero;
    for (const Sum& sum : sums) addTo(&all, sum);
    return all;
  }

  /// The sum of the vectors `vectorOf(tile)`, of `size` numbers each. Calls it only for tiles of this rank.
  template <typename VectorOf>
  Eigen::VectorXf sumOf(int tiles, Eigen::Index size, const VectorOf& vectorOf) const {
    Eigen::VectorXf sum = Eigen::VectorXf::Zero(size);
    if (ranks_.size() == 1) {
      for (int tile = 0; tile < tiles; ++tile) sum += vectorOf(tile);
      return sum;
    }
    Eigen::MatrixXf columns(size, static_cast<Eigen::Index>(tiles));
    const Share own = ownOf(tiles);
    for (int tile = own.first; tile < own.last; ++tile) columns.col(tile) = vectorOf(tile);
    exchangeShares(&ranks_, tiles, static_cast<std::size_t>(size), columns.data());
    for (int tile = 0; tile < tiles; ++tile) sum += columns.col(tile);
    return sum;
  }

 private:
  Share ownOf(int tiles) const { return shareOf(tiles, ranks_.rank(), ranks_.size()); }

  template <typename Sum>
  void exchange(std::vector<Sum>* sums) const {
    if (ranks_.size() == 1) return;
    const std::size_t width = numbersOf(&sums->front()).size();
    std::vector<double> numbers;
    for (Sum& sum : *sums) {
      for (const double* number : numbersOf(&sum)) numbers.push_back(*number);
    }
    exchangeShares(&ranks_, static_cast<int>(sums->size()), width, numbers.data());
    const double* next = numbers.data();
    for (Sum& sum : *sums) {
      for (double* number : numbersOf(&sum)) *number = *next++;
    }
  }

  Communicator& ranks_;
  int threads_;
};

}  // namespace lstm_planner
