#include "lstm_planner/grid_world/learning/grid_dataset.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "grid_world/agent/a_star_agent.hpp"
#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/grid_world/evaluation/grid_episode.hpp"
#include "lstm_planner/training/teacher_rescue.hpp"

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

/// What the supervisor of the parameters answers along one path.
class Supervisor {
 public:
  Supervisor(const CourseGoal& goal, CellIndex start, GridSupervisor kind) : goal_(goal) {
    if (kind == GridSupervisor::kShortestPath) return;
    AStarParameters parameters;
    parameters.heuristic = Heuristic::kScaledEuclidean;
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

/// Records what the agent at a place is told, and what the supervisor answers. The supervisor leads, or the `learner`
/// where there is one, whom it rescues.
class TaughtAgent : public GridAgent {
 public:
  TaughtAgent(const CourseGoal& goal, const GridDatasetParameters& parameters, std::unique_ptr<GridAgent> learner)
      : goal_(goal),
        learner_(std::move(learner)),
        rescue_(kNearer, parameters.stuck_steps, parameters.rescue_steps),
        kind_(parameters.supervisor) {}

  void start(CellIndex start, CellIndex goal) override {
    previous_direction_ = kNoPath;
    supervisor_.emplace(goal_, start, kind_);
    if (learner_) learner_->start(start, goal);
  }

  void observe(const GridObservation& observation) override {
    const std::size_t known = walk_.inputs.size();
    walk_.inputs.resize(known + kGridInputs);
    encodeGrid(observation, previous_direction_, &walk_.inputs[known], 1);
    direction_ = supervisor_->move(observation, previous_direction_);
    walk_.labels.push_back(direction_);
    if (!learner_) return;
    learner_->observe(observation);
    if (!rescue_.wanted(static_cast<double>(goal_.distances.at(observation.cell)))) direction_ = learner_->decide();
  }

  int decide() override { return direction_; }
  GridLeader leader() const override { return learner_ ? learner_->leader() : GridLeader::kSearch; }
  void step(int direction, bool moved) override {
    previous_direction_ = direction;
    if (learner_) learner_->step(direction, moved);
  }
  std::size_t peakBytes() const override { return 0; }

  Walk takeWalk() { return std::move(walk_); }

 private:
  const CourseGoal& goal_;
  int previous_direction_ = kNoPath;
  std::unique_ptr<GridAgent> learner_;
  TeacherRescue rescue_;
  GridSupervisor kind_;
  std::optional<Supervisor> supervisor_;
  Walk walk_;
  int direction_ = kNoPath;
};

/// One path, led by the supervisor where there is no `learner`, who is led to the end.
Walk walkOf(const GridCourse::Episode& episode, const GridDatasetParameters& parameters,
            std::unique_ptr<GridAgent> learner) {
  const CourseGoal& goal = *episode.goal;
  GridEpisodeRules rules;
  rules.corner_cutting = goal.corner_cutting;
  rules.max_steps = learner ? parameters.max_steps : gridStepBound(goal.map->grid);
  TaughtAgent agent(goal, parameters, std::move(learner));
  runGridEpisode(goal.map->grid, goal.map->ranges, episode.start, goal.goal, rules, &agent);
  return agent.takeWalk();
}

/// The first `steps` of it, each with weight.
Sequence toSequence(const Walk& walk, std::size_t steps) {
  const auto count = static_cast<Eigen::Index>(steps);
  return {Eigen::Map<const Eigen::MatrixXf>(walk.inputs.data(), kGridInputs, count),
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
  checkPositive("steps", parameters.steps);
  checkPositive("max_steps", parameters.max_steps);
  checkPositive("stuck_steps", parameters.stuck_steps);
  checkPositive("rescue_steps", parameters.rescue_steps);
  checkParameter(parameters.burn_in_steps >= 0, "burn_in_steps", parameters.burn_in_steps, "zero or more");
  checkParameter(parameters.sequence_steps > parameters.burn_in_steps, "sequence_steps", parameters.sequence_steps,
                 "more than burn_in_steps");
}

std::vector<Sequence> collectGridSequences(const GridDatasetParameters& parameters, const GridCourse& course,
                                           const Model* learner, double learner_share, std::uint64_t seed,
                                           int threads) {
  validate(parameters);
  NetworkGridAgent::Options shield_alone;
  shield_alone.guided = false;
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
      walks[static_cast<std::size_t>(index)] = walkOf(episode, parameters, std::move(agent));
    });
    for (const Walk& walk : walks) {
      const std::size_t steps = std::min(walk.labels.size(), missing);
      missing -= steps;
      cutIntoPieces(toSequence(walk, steps), cut, &sequences);
    }
  }
  return sequences;
}

}  // namespace lstm_planner
