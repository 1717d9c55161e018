#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// The answer of a supervisor that knows the map in `cell`: the first move of a shortest path (thesis 3.2: of A*). If
/// there are several, it goes on in `previous_direction` (-1: none), or else takes the one that points best at the
/// goal; so the answer depends on what the agent knows. -1 if there is no path.
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
  int burn_in_steps = 32;    ///< before a sequence that starts in the middle of a path: steps that only set the hidden
                             ///< state
  int max_steps = 1000;      ///< of a path that the learner leads
  int stuck_steps = 24;      ///< steps in which the learner comes no nearer to the goal; then the supervisor leads
  int rescue_steps = 16;     ///< steps that the supervisor then leads
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridDatasetParameters& parameters);

/// Paths of a course as sequences of inputs and the supervisor's answers. The hidden state starts at zero with every
/// path, as it does when the agent walks. A path ends within one cell of the goal.
///
/// The supervisor leads along the paths ("teacher forcing", thesis Fig. 3.6). A `learner` (a model of the grid world),
/// if there is one, leads a `learner_share` of them, and chooses among the moves that the shield allows (DAgger). The
/// same for any number of threads.
std::vector<Sequence> collectGridSequences(const GridDatasetParameters& parameters, const GridCourse& course,
                                           const Model* learner, double learner_share, std::uint64_t seed, int threads);

}  // namespace lstm_planner
