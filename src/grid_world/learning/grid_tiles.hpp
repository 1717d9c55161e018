#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "grid_world/learning/grid_actor.hpp"
#include "lstm_planner/training/tile_exchange.hpp"

namespace lstm_planner {

/// Some agents that go through a window together, with the hidden state they carry between windows. A way of learning
/// adds what else they carry.
struct GridTile {
  std::vector<GridActor> actors;
  std::vector<float> state;
};

/// Tiles of agents that learn together. `Runner` leads a tile through a window, of which each thread has one.
template <typename Tile, typename Runner>
class GridTiles {
 public:
  /// `make` makes a runner.
  template <typename Make>
  GridTiles(Communicator* ranks, int threads, const Make& make) : exchange_(ranks, threads) {
    for (int thread = 0; thread < threads; ++thread) runners_.push_back(make());
  }

  /// New agents on a course: so many, rounded up to whole tiles.
  void start(int agents, const GridCourse& course, const GridEncoderParameters& encoder, std::uint64_t seed) {
    Random seeds(seed);
    const int actors = runners_.front()->actors();
    tiles_.clear();
    tiles_.resize(static_cast<std::size_t>((agents + actors - 1) / actors));
    for (Tile& tile : tiles_) {
      for (int actor = 0; actor < actors; ++actor) tile.actors.emplace_back(course, encoder, seeds());
    }
  }

  bool empty() const { return tiles_.empty(); }

  /// Adds what `run(runner, tile)` says of each tile up to `zero`.
  template <typename Sum, typename Run>
  Sum run(Sum zero, const Run& run) {
    const auto work = [&](int tile, int thread) {
      return run(runners_[static_cast<std::size_t>(thread)].get(), &tiles_[static_cast<std::size_t>(tile)]);
    };
    for (const Sum& sum : exchange_.each(count(), zero, work)) zero += sum;
    return zero;
  }

  /// The sum of one of the gradients that the tiles hold then.
  Eigen::VectorXf sumOf(Eigen::VectorXf Tile::*gradient, Eigen::Index size) const {
    return exchange_.sumOf(count(), size, [&](int tile) -> const Eigen::VectorXf& {
      return tiles_[static_cast<std::size_t>(tile)].*gradient;
    });
  }

 private:
  int count() const { return static_cast<int>(tiles_.size()); }

  TileExchange exchange_;
  std::vector<std::unique_ptr<Runner>> runners_;
  std::vector<Tile> tiles_;
};

}  // namespace lstm_planner
