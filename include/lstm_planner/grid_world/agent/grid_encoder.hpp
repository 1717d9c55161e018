#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/common/progress_watch.hpp"
#include "lstm_planner/grid_world/agent/boundary_inputs.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/agent/visit_trace.hpp"

namespace lstm_planner {

/// What an agent remembers of its episode besides the hidden state: bounded, and updated in one place.
class GridMemory {
 public:
  /// What is not needed may be left out: where the agent has been, and the boundary between it and the goal.
  explicit GridMemory(std::optional<VisitTrace> trace = VisitTrace(),
                      std::unique_ptr<BoundaryMemory> boundary = nullptr)
      : trace_(std::move(trace)), boundary_(std::move(boundary)) {}

  void start();

  /// Once before every step.
  void observe(const GridObservation& observation);

  /// After the step; the direction in which the agent moved.
  void step(int direction) { previous_direction_ = direction; }

  const GridObservation& observation() const { return observation_; }
  const VisitTrace* trace() const { return trace_ ? &*trace_ : nullptr; }
  const BoundaryMemory* boundary() const { return boundary_.get(); }
  int previousDirection() const { return previous_direction_; }  ///< -1 before the first step
  double goalDistance() const { return goal_distance_; }         ///< octile, cells
  double bestDistance() const { return progress_.best(); }       ///< the least goalDistance() so far
  int stepsSinceBest() const { return progress_.steps(); }
  /// A large block of the trace that was not visited before; never without a trace.
  bool inNewPlace() const { return in_new_place_; }
  std::size_t bytes() const { return (trace_ ? VisitTrace::bytes() : 0) + (boundary_ ? sizeof(*boundary_) : 0); }

 private:
  GridObservation observation_;
  std::optional<VisitTrace> trace_;
  std::unique_ptr<BoundaryMemory> boundary_;
  int previous_direction_ = -1;
  double goal_distance_ = 0.0;
  ProgressWatch progress_{0.0};
  bool in_new_place_ = false;
};

/// Which inputs a network for the grid world has, and from how many sides it looks; travels in the model file.
struct GridEncoderParameters {
  /// What the inputs tell the network.
  enum class Inputs {
    kThesis,    ///< 8 ranges, distance, angle, previous action (thesis 3.2): 11 inputs
    kTrace,     ///< and where the agent has been, around it and along the rays, on the scales of VisitTrace
    kBoundary,  ///< kTrace, and BoundaryInputs: what a bug algorithm remembers; nothing is searched
  };
  Inputs inputs = Inputs::kTrace;

  /// 1: one network with an output a direction. 8: the same network, with one output, looks into each direction in
  /// turn, everything turned such that it lies ahead; the weights are shared and each view has a hidden state of its
  /// own.
  int views = 8;
};

/// "thesis", "trace" or "boundary"; throws std::invalid_argument for another name.
const char* nameOf(GridEncoderParameters::Inputs inputs);
std::vector<std::string> gridInputNames();
GridEncoderParameters::Inputs gridInputsNamed(const std::string& name);

/// The memory that an agent with such inputs needs. `notes_places`: it knows new places, whatever the inputs.
GridMemory makeGridMemory(const GridEncoderParameters& parameters,
                          CornerCutting corner_cutting = CornerCutting::kForbidden, bool notes_places = false);

/// To and from the metadata of a model file (keys: grid_inputs, grid_views). Reading throws std::invalid_argument for a
/// missing or malformed key.
void writeMetadata(const GridEncoderParameters& parameters, std::map<std::string, std::string>* metadata);
GridEncoderParameters readGridEncoderParameters(const std::map<std::string, std::string>& metadata);

/// Turns an agent's memory into the network's input. All inputs are finite and about in [-1, 1].
class GridEncoder {
 public:
  /// Throws std::invalid_argument for a number of views other than 1 and 8.
  explicit GridEncoder(const GridEncoderParameters& parameters);

  const GridEncoderParameters& parameters() const { return parameters_; }
  int size() const;
  int outputs() const { return parameters_.views == 1 ? kGridMoveCount : 1; }

  /// Reads off what does not depend on the view.
  void prepare(const GridMemory& memory);

  /// Input i of a view goes to input[i * stride].
  void encode(int view, float* input, int stride) const;

  /// Input i of each view goes to input[i * stride + view].
  void encodeViews(float* input, int stride) const;

  static constexpr int kRayFeatures = 7;
  static constexpr int kThesisInputs = kGridRayCount + 3;
  static constexpr int kTraceScalars = 10;

 private:
  void lookAlongRays(const GridMemory& memory);
  template <typename Put>
  void forEachInput(const Put& put) const;

  GridEncoderParameters parameters_;
  std::array<std::array<float, kGridRayCount>, kRayFeatures> rays_{};
  int previous_direction_ = -1;
  float goal_angle_ = 0.0f;     ///< rad, from the first ray's direction to the second's
  float goal_distance_ = 0.0f;  ///< cells
  float goal_cos_ = 1.0f;
  float goal_sin_ = 0.0f;
  std::array<float, 5> progress_{};
  std::unique_ptr<BoundaryInputs> boundary_;  ///< if they are inputs
};

}  // namespace lstm_planner
