#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "lstm_planner/common/communicator.hpp"

namespace lstm_planner {

/// What the ranks of one test have in common.
class RankTable {
 public:
  explicit RankTable(int ranks) : ranks_(ranks) {}
  int ranks() const { return ranks_; }

  void exchange(int rank, std::uint8_t* values, const std::vector<std::size_t>& bytes) {
    const std::size_t offset = std::accumulate(bytes.begin(), bytes.begin() + rank, std::size_t{0});
    const std::size_t total = std::accumulate(bytes.begin(), bytes.end(), std::size_t{0});
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!agreed_.empty() && agreed_ != bytes) throw std::logic_error("ranks exchange parts of different sizes");
      agreed_ = bytes;
      table_.resize(total);
      if (total > 0) std::memcpy(table_.data() + offset, values + offset, bytes[static_cast<std::size_t>(rank)]);
    }
    wait();
    if (total > 0) std::memcpy(values, table_.data(), total);
    wait();
  }

  std::unique_ptr<Tickets> tickets(int rank, std::size_t count) {
    class SharedTickets : public Tickets {
     public:
      SharedTickets(std::atomic<std::size_t>* next, std::size_t count) : next_(next), count_(count) {}
      std::size_t draw() override { return std::min((*next_)++, count_); }

     private:
      std::atomic<std::size_t>* next_;
      std::size_t count_;
    };
    if (rank == 0) next_ticket_ = 0;
    wait();
    return std::make_unique<SharedTickets>(&next_ticket_, count);
  }

 private:
  void wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    const int round = round_;
    if (++waiting_ == ranks_) {
      waiting_ = 0;
      agreed_.clear();
      ++round_;
      all_here_.notify_all();
      return;
    }
    all_here_.wait(lock, [&] { return round_ != round; });
  }

  int ranks_;
  std::mutex mutex_;
  std::condition_variable all_here_;
  std::vector<std::uint8_t> table_;
  std::vector<std::size_t> agreed_;
  int waiting_ = 0;
  int round_ = 0;
  std::atomic<std::size_t> next_ticket_{0};
};

/// A rank that is a thread: what mpirun does with processes, without it.
class ThreadRank : public Communicator {
 public:
  ThreadRank(int rank, RankTable* table) : rank_(rank), table_(table) {}
  int rank() const override { return rank_; }
  int size() const override { return table_->ranks(); }
  void exchangeBytes(void* values, const std::vector<std::size_t>& bytes) override {
    table_->exchange(rank_, static_cast<std::uint8_t*>(values), bytes);
  }
  std::unique_ptr<Tickets> tickets(std::size_t count) override { return table_->tickets(rank_, count); }

 private:
  int rank_;
  RankTable* table_;
};

/// What work(communicator) returns on each rank.
template <typename Work>
auto onRanks(int ranks, const Work& work) {
  RankTable table(ranks);
  std::vector<decltype(work(oneProcess()))> results(static_cast<std::size_t>(ranks));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < ranks; ++rank) {
    threads.emplace_back([&, rank] {
      ThreadRank communicator(rank, &table);
      results[static_cast<std::size_t>(rank)] = work(&communicator);
    });
  }
  for (std::thread& thread : threads) thread.join();
  return results;
}

}  // namespace lstm_planner
