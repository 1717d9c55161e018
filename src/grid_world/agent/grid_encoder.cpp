#include "lstm_planner/grid_world/agent/grid_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "grid_world/agent/along_ray.hpp"

namespace lstm_planner {
namespace {

/// Cells ahead, as far as the ray is free, at which the trace's blocks are looked up.
constexpr int kSmallProbe = 5;
constexpr int kLargeProbe = 9;
constexpr int kFarProbe = 18;

/// Distances up to this one are told apart best (thesis: plain division by a scale).
constexpr float kDistanceScale = 100.0f;
constexpr float kMostLogSteps = 16.0f;  ///< log2 of the trace's longest memory

constexpr float kDiagonal = 0.70710678f;
constexpr std::array<float, kGridRayCount> kCosines = {1, kDiagonal, 0, -kDiagonal, -1, -kDiagonal, 0, kDiagonal};

float cosineOf(int eighths) { return kCosines[static_cast<std::size_t>(eighths & 7)]; }
float sineOf(int eighths) { return cosineOf(eighths + 6); }

/// log2 by table: ranges and ages come in steps of one, and this runs dozens of times a step.
class Logarithms {
 public:
  Logarithms() {
    for (std::size_t i = 1; i < values_.size(); ++i) values_[i] = std::log2(static_cast<float>(i));
  }
  float operator()(int number) const {
    const std::size_t index = static_cast<std::size_t>(number);
    return index < values_.size() ? values_[index] : std::log2(static_cast<float>(number));
  }

 private:
  std::array<float, 4096> values_{};
};
const Logarithms kLog2;

float freshness(const Visit& visit) { return visit.count == 0 ? 0.0f : 1.0f - kLog2(visit.age + 1) / kMostLogSteps; }

float frequency(const Visit& visit) {
  const float count = static_cast<float>(visit.count);
  return count / (count + 2.0f);
}

/// Rounded as where the shipped networks learned: OctileDistance::length() may differ in the last bit.
double octileLength(CellIndex a, CellIndex b) {
  const int columns = std::abs(a.column - b.column);
  const int rows = std::abs(a.row - b.row);
  return std::max(columns, rows) + (moveLength(1) - 1.0) * std::min(columns, rows);
}

}  // namespace

void GridMemory::start() {
  if (trace_) trace_->clear();
  if (boundary_) boundary_->start();
  previous_direction_ = -1;
  progress_.clear();
}

void GridMemory::observe(const GridObservation& observation) {
  observation_ = observation;
  in_new_place_ = trace_ && trace_->visit(observation.cell);
  if (boundary_) boundary_->observe(observation);
  goal_distance_ = octileLength(observation.cell, observation.goal);
  progress_.note(goal_distance_);
}

GridEncoder::GridEncoder(const GridEncoderParameters& parameters) : parameters_(parameters) {
  if (parameters.views != 1 && parameters.views != kGridRayCount) {
    throw std::invalid_argument("grid_views is " + std::to_string(parameters.views) + ", expected 1 or 8");
  }
  if (parameters.inputs == GridEncoderParameters::Inputs::kBoundary) boundary_ = std::make_unique<BoundaryInputs>();
}

int GridEncoder::size() const {
  if (parameters_.inputs == GridEncoderParameters::Inputs::kThesis) return kThesisInputs;
  return kRayFeatures * kGridRayCount + kTraceScalars + (boundary_ ? BoundaryInputs::kCount : 0);
}

void GridEncoder::prepare(const GridMemory& memory) {
  const GridObservation& observation = memory.observation();
  const float columns = static_cast<float>(observation.goal.column - observation.cell.column);
  const float rows = static_cast<float>(observation.goal.row - observation.cell.row);
  goal_distance_ = std::hypot(columns, rows);
  goal_cos_ = goal_distance_ > 0.0f ? columns / goal_distance_ : 1.0f;
  goal_sin_ = goal_distance_ > 0.0f ? rows / goal_distance_ : 0.0f;
  previous_direction_ = memory.previousDirection();
  if (parameters_.inputs == GridEncoderParameters::Inputs::kThesis) {
    goal_angle_ = std::atan2(goal_sin_, goal_cos_);
    for (std::size_t ray = 0; ray < kGridRayCount; ++ray) {
      rays_[0][ray] = static_cast<float>(observation.ranges[ray]) / static_cast<float>(kGridRayCap);
    }
    return;
  }
  if (memory.trace() == nullptr) throw std::invalid_argument("grid_inputs is trace, expected a memory with a trace");
  lookAlongRays(memory);
  const VisitTrace& trace = *memory.trace();
  const int behind_best = static_cast<int>(memory.goalDistance() - memory.bestDistance());
  progress_ = {kLog2(static_cast<int>(goal_distance_) + 1) / 10.0f, kLog2(behind_best + 1) / 10.0f,
               kLog2(memory.stepsSinceBest() + 1) / kMostLogSteps,
               frequency(trace.at(VisitTrace::kSmallBlock, observation.cell)),
               frequency(trace.at(VisitTrace::kLargeBlock, observation.cell))};
  if (boundary_) {
    if (memory.boundary() == nullptr) {
      throw std::invalid_argument("grid_inputs is boundary, expected a memory of the boundary");
    }
    *boundary_ = BoundaryInputs(*memory.boundary(), observation);
  }
}

void GridEncoder::lookAlongRays(const GridMemory& memory) {
  const GridObservation& observation = memory.observation();
  const VisitTrace& trace = *memory.trace();
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    const std::size_t ray = static_cast<std::size_t>(direction);
    const int range = observation.ranges[ray];
    const auto probe = [&](VisitTrace::Scale scale, int steps) {
      return trace.at(scale, alongRay(observation.cell, ray, std::min(range - 1, steps)));
    };
    const Visit beside = range > 1 ? trace.at(VisitTrace::kCell, alongRay(observation.cell, ray, 1)) : Visit{};
    const Visit large = probe(VisitTrace::kLargeBlock, kLargeProbe);
    rays_[0][ray] = kLog2(range) / 5.643856f;  // log2 of the cap
    rays_[1][ray] = freshness(beside);
    rays_[2][ray] = frequency(beside);
    rays_[3][ray] = frequency(probe(VisitTrace::kSmallBlock, kSmallProbe));
    rays_[4][ray] = frequency(large);
    rays_[5][ray] = freshness(large);
    rays_[6][ray] = frequency(probe(VisitTrace::kLargeBlock, kFarProbe));
  }
}

/// Calls put(value) for each input in its order, where value(view) is what a view sees.
template <typename Put>
void GridEncoder::forEachInput(const Put& put) const {
  const bool thesis = parameters_.inputs == GridEncoderParameters::Inputs::kThesis;
  const auto putRays = [&put](const std::array<float, kGridRayCount>& values) {
    // Twice one after the other: turned for a view they lie in one piece.
    std::array<float, 2 * kGridRayCount> twice;
    std::copy(values.begin(), values.end(), twice.begin());
    std::copy(values.begin(), values.end(), twice.begin() + kGridRayCount);
    for (int ray = 0; ray < kGridRayCount; ++ray) {
      put([&](int view) { return twice[static_cast<std::size_t>(ray + view)]; });
    }
  };
  const auto putForAllViews = [&put](float value) { put([value](int) { return value; }); };
  for (std::size_t feature = 0; feature < (thesis ? 1 : rays_.size()); ++feature) putRays(rays_[feature]);
  if (boundary_) std::for_each(boundary_->rays.begin(), boundary_->rays.end(), putRays);
  const int previous = previous_direction_;
  const float moved = previous >= 0 ? 1.0f : 0.0f;
  if (thesis) {
    putForAllViews(goal_distance_ / (goal_distance_ + kDistanceScale));
    put([&](int view) {
      const float turn = std::remainder(goal_angle_ - static_cast<float>(view) * static_cast<float>(M_PI_4),
                                        static_cast<float>(2.0 * M_PI));
      return turn / static_cast<float>(M_PI);
    });
    put([&](int view) { return moved * (static_cast<float>(turned(previous, -view)) / 4.0f - 1.0f); });
    return;
  }
  put([&](int view) { return goal_cos_ * cosineOf(view) + goal_sin_ * sineOf(view); });
  put([&](int view) { return goal_sin_ * cosineOf(view) - goal_cos_ * sineOf(view); });
  put([&](int view) { return moved * cosineOf(previous - view); });
  put([&](int view) { return moved * sineOf(previous - view); });
  put([](int view) { return static_cast<float>(view & 1); });
  std::for_each(progress_.begin(), progress_.end(), putForAllViews);
  if (boundary_) std::for_each(boundary_->scalars.begin(), boundary_->scalars.end(), putForAllViews);
}

void GridEncoder::encode(int view, float* input, int stride) const {
  forEachInput([&](const auto& value) {
    *input = value(view);
    input += stride;
  });
}

void GridEncoder::encodeViews(float* input, int stride) const {
  if (parameters_.views == 1) {
    encode(0, input, stride);
    return;
  }
  forEachInput([&](const auto& value) {
    for (int view = 0; view < kGridRayCount; ++view) input[view] = value(view);
    input += stride;
  });
}

namespace {

using Inputs = GridEncoderParameters::Inputs;
constexpr std::array<std::pair<const char*, Inputs>, 3> kInputNames = {
    {{"thesis", Inputs::kThesis}, {"trace", Inputs::kTrace}, {"boundary", Inputs::kBoundary}}};

}  // namespace

const char* nameOf(GridEncoderParameters::Inputs inputs) {
  return std::find_if(kInputNames.begin(), kInputNames.end(), [&](const auto& name) { return name.second == inputs; })
      ->first;
}

std::vector<std::string> gridInputNames() {
  std::vector<std::string> names;
  for (const auto& name : kInputNames) names.emplace_back(name.first);
  return names;
}

GridEncoderParameters::Inputs gridInputsNamed(const std::string& name) {
  for (const auto& [known, inputs] : kInputNames) {
    if (name == known) return inputs;
  }
  throw std::invalid_argument("grid_inputs is '" + name + "', expected thesis, trace or boundary");
}

void writeMetadata(const GridEncoderParameters& parameters, std::map<std::string, std::string>* metadata) {
  (*metadata)["grid_inputs"] = nameOf(parameters.inputs);
  (*metadata)["grid_views"] = std::to_string(parameters.views);
}

GridEncoderParameters readGridEncoderParameters(const std::map<std::string, std::string>& metadata) {
  const auto text = [&](const char* key) {
    const auto entry = metadata.find(key);
    if (entry == metadata.end()) {
      throw std::invalid_argument(std::string("the model has no ") + key + ", expected one made for the grid world");
    }
    return entry->second;
  };
  GridEncoderParameters parameters;
  parameters.inputs = gridInputsNamed(text("grid_inputs"));
  const std::string views = text("grid_views");
  if (views != "1" && views != "8") {
    throw std::invalid_argument("grid_views is '" + views + "', expected 1 or 8");
  }
  parameters.views = views == "1" ? 1 : kGridRayCount;
  return parameters;
}

GridMemory makeGridMemory(const GridEncoderParameters& parameters, CornerCutting corner_cutting, bool notes_places) {
  const bool has_trace = notes_places || parameters.inputs != GridEncoderParameters::Inputs::kThesis;
  const bool has_boundary = parameters.inputs == GridEncoderParameters::Inputs::kBoundary;
  return GridMemory(has_trace ? std::make_optional<VisitTrace>() : std::nullopt,
                    has_boundary ? std::make_unique<BoundaryMemory>(corner_cutting) : nullptr);
}

}  // namespace lstm_planner
