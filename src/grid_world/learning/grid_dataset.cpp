#include "lstm_planner/grid_world/learning/grid_dataset.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "grid_world/agent/a_star_agent.hpp"
#include "lstm_planner/base/common/parallel_for.hpp"
#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/learning/teacher_rescue.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"

namespace lstm_planner {
namespace {

/// Paths of the same length differ by the rounding of distances that are summed up as float.
constexpr double kEqualLengths = 1e-3;

/// Cells; a learner that comes less near to the goal than that makes no progress.
constexpr double kNearer = 0.5;

/// Walks at a time, of which those that are not needed any more are thrown away.
constexpr int kBlock = 64;

struct Walk {
  std::vector<float> inputs;  ///< step after step
  std::vector<int> labels;
};

/// How far the two directions point the same way: 1 for the same, -1 for opposite ones.
double alignment(CellIndex step, CellIndex to_goal) {
  const double product =
      static_cast<double>(step.column) * to_goal.column + static_cast<double>(step.row) * to_goal.row;
  return product / (std::hypot(step.column, step.row) * std::hypot(to_goal.column, to_goal.row));
}

bool arrived(CellIndex cell, CellIndex goal) {
  return std::max(std::abs(goal.column - cell.column), std::abs(goal.row - cell.row)) <= 1;
}

/// What the supervisor of the parameters answers along one path.
class Supervisor {
 public:
  Supervisor(const CourseGoal& goal, CellIndex start, GridSupervisor kind) : goal_(goal) {
    if (kind == GridSupervisor::kShortestPath) return;
    AStarParameters parameters;
    parameters.heuristic.kind = Heuristic::kScaledEuclidean;
    parameters.corner_cutting = goal.corner_cutting;
    parameters.closed_cells = ClosedCells::kStayClosed;
    search_.emplace(goal.map->grid, parameters);
    search_->start(start, goal.goal);
  }

  int move(const GridObservation& observation, int previous_direction) {
    if (!search_) return supervisorMove(goal_, observation.cell, previous_direction);
    search_->observe(observation);
    return search_->decide();
  }

 private:
  const CourseGoal& goal_;
  std::optional<AStarAgent> search_;
};

/// One path, led by the supervisor where there is no `agent`.
Walk walk(const GridCourse::Episode& episode, const GridDatasetParameters& parameters, GridEncoder encoder,
          GridAgent* agent) {
  const CourseGoal& goal = *episode.goal;
  GridMemory memory = makeGridMemory(encoder.parameters());
  memory.start();
  if (agent != nullptr) agent->start(episode.start, goal.goal);
  TeacherRescue rescue(kNearer, parameters.stuck_steps, parameters.rescue_steps);
  Supervisor supervisor(goal, episode.start, parameters.supervisor);
  Walk walk;
  CellIndex cell = episode.start;
  const auto inputs = static_cast<std::size_t>(encoder.size());
  while (!arrived(cell, goal.goal) &&
         (agent == nullptr || static_cast<int>(walk.labels.size()) < parameters.max_steps)) {
    const GridObservation observation{cell, goal.goal, goal.map->ranges.at(cell)};
    memory.observe(observation);
    encoder.look(memory);
    walk.inputs.resize(walk.inputs.size() + inputs);
    encoder.encode(0, &walk.inputs[walk.inputs.size() - inputs], 1);
    const int label = supervisor.move(observation, memory.previousDirection());
    walk.labels.push_back(label);
    int direction = label;
    if (agent != nullptr) {
      agent->observe(observation);
      if (!rescue.wanted(static_cast<double>(goal.distances.at(cell)))) direction = agent->decide();
      agent->step(direction, true);
    }
    memory.step(direction);
    cell = cellBeside(cell, direction);
  }
  return walk;
}

/// The first `steps` of it, each with weight.
Sequence toSequence(const Walk& walk, std::size_t steps, int inputs) {
  const auto count = static_cast<Eigen::Index>(steps);
  return {Eigen::Map<const Eigen::MatrixXf>(walk.inputs.data(), inputs, count),
          Eigen::Map<const Eigen::VectorXi>(walk.labels.data(), count), Eigen::VectorXf::Ones(count)};
}

}  // namespace

int supervisorMove(const CourseGoal& goal, CellIndex cell, int previous_direction) {
  std::array<double, kGridMoveCount> lengths{};
  double shortest = std::numeric_limits<double>::infinity();
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    double& length = lengths[static_cast<std::size_t>(direction)];
    length = std::numeric_limits<double>::infinity();
    if (!movePossible(goal.map->ranges.at(cell), direction, goal.corner_cutting)) continue;
    length = moveLength(direction) + static_cast<double>(goal.distances.at(cellBeside(cell, direction)));
    shortest = std::min(shortest, length);
  }
  if (std::isinf(shortest)) return -1;
  const CellIndex to_goal{goal.goal.column - cell.column, goal.goal.row - cell.row};
  int best = -1;
  double best_alignment = 0.0;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (lengths[static_cast<std::size_t>(direction)] > shortest + kEqualLengths) continue;
    if (direction == previous_direction) return direction;
    const double aligned = alignment(kGridRaySteps[static_cast<std::size_t>(direction)], to_goal);
    if (best < 0 || aligned > best_alignment) {
      best = direction;
      best_alignment = aligned;
    }
  }
  return best;
}

void validate(const GridDatasetParameters& parameters) {
  const auto check_positive = [](const char* name, int value) {
    checkParameter(value > 0, name, value, "a positive number");
  };
  check_positive("steps", parameters.steps);
  check_positive("max_steps", parameters.max_steps);
  check_positive("stuck_steps", parameters.stuck_steps);
  check_positive("rescue_steps", parameters.rescue_steps);
  checkParameter(parameters.burn_in_steps >= 0, "burn_in_steps", parameters.burn_in_steps, "zero or more");
  checkParameter(parameters.sequence_steps > parameters.burn_in_steps, "sequence_steps", parameters.sequence_steps,
                 "more than burn_in_steps");
}

std::vector<Sequence> collectGridSequences(const GridDatasetParameters& parameters,
                                           const GridEncoderParameters& encoder_parameters, const GridCourse& course,
                                           const Model* learner, double learner_share, std::uint64_t seed,
                                           int threads) {
  validate(parameters);
  if (encoder_parameters.views != 1) {
    throw std::invalid_argument("imitation with " + std::to_string(encoder_parameters.views) +
                                " views is not possible, expected 1 view: networks of 8 views learn by reinforcement");
  }
  const GridEncoder encoder(encoder_parameters);
  NetworkGridAgent::Options shield_alone;
  shield_alone.escape = false;
  shield_alone.corner_cutting = course.cornerCutting();
  Random seeds(seed);
  const SequenceCut cut = overlappingPieces(parameters.sequence_steps, parameters.burn_in_steps);
  std::vector<Sequence> sequences;
  std::size_t missing = static_cast<std::size_t>(parameters.steps);
  while (missing > 0) {
    std::array<std::uint64_t, kBlock> walk_seeds{};
    for (std::uint64_t& walk_seed : walk_seeds) walk_seed = seeds();
    std::array<Walk, kBlock> walks;
    parallelFor(kBlock, threads, [&](int index, int) {
      Random random(walk_seeds[static_cast<std::size_t>(index)]);
      const GridCourse::Episode episode = course.draw(random);
      std::unique_ptr<GridAgent> agent;
      if (learner != nullptr && uniform(random) < learner_share) {
        agent = std::make_unique<NetworkGridAgent>(*learner, shield_alone);
      }
      walks[static_cast<std::size_t>(index)] = walk(episode, parameters, encoder, agent.get());
    });
    for (const Walk& walk : walks) {
      const std::size_t steps = std::min(walk.labels.size(), missing);
      missing -= steps;
      cutIntoPieces(toSequence(walk, steps, encoder.size()), cut, &sequences);
    }
  }
  return sequences;
}

}  // namespace lstm_planner
