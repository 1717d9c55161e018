#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// What a supervisor that knows the map answers in `cell`: the first move of a shortest path (thesis 3.2: of A*). Where
/// there are several it goes on in `previous_direction` (-1: none), else takes the one that points best at the goal, so
/// that the answer can be told from what the agent knows. -1 when there is no path.
int supervisorMove(const CourseGoal& goal, CellIndex cell, int previous_direction);

/// Who answers.
enum class GridSupervisor {
  kShortestPath,  ///< supervisorMove()
  kThesisAStar,   ///< A* with 25 times the Euclidean distance, closed cells stay closed (thesis 3.2): not the shortest
};

/// How much is collected, and who leads when.
struct GridDatasetParameters {
  GridSupervisor supervisor = GridSupervisor::kShortestPath;
  int steps = 102400;        ///< with a label (thesis Table 3.1)
  int sequence_steps = 512;  ///< the thesis's "time sequence": errors go back this far at most
  int burn_in_steps = 32;    ///< of a sequence that is not the start of a path, steps that only bring the hidden
                             ///< state up to date
  int max_steps = 1000;      ///< of a path that the learner leads
  int stuck_steps = 24;      ///< of a learner that comes no nearer to the goal, after which the supervisor leads
  int rescue_steps = 16;     ///< and for how long
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridDatasetParameters& parameters);

/// Paths of a course as sequences of inputs and the supervisor's answers; the hidden state starts anew with every path,
/// as it does when the agent walks. A path ends within one cell of the goal.
///
/// The supervisor leads along the paths ("teacher forcing", thesis Fig. 3.6). With a `learner` (a model of the grid
/// world) that one leads a `learner_share` of them, choosing among the moves that the shield allows (DAgger). The same
/// for any number of threads.
std::vector<Sequence> collectGridSequences(const GridDatasetParameters& parameters, const GridCourse& course,
                                           const Model* learner, double learner_share, std::uint64_t seed, int threads);

}  // namespace lstm_planner
