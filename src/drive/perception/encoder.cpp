#include "lstm_planner/drive/perception/encoder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace lstm_planner {
namespace {

constexpr double kSmallestScale = 1e-3;
constexpr double kLargestScale = 1e6;
constexpr double kSameSpan = 1e-3;  ///< rad

void checkScale(const std::string& name, double value) {
  if (!(value >= kSmallestScale && value <= kLargestScale)) {
    throw std::invalid_argument(name + " is " + metadataText(value) + ", expected a number in [0.001, 1000000]");
  }
}

/// A view takes over what another one saw there: each direction must be told.
void checkGroupsAreWhole(const std::vector<std::string>& layout) {
  std::map<const NetworkInput*, int> counts;
  for (const std::string& name : layout) ++counts[inputNamed(name).input];
  for (const auto& [input, count] : counts) {
    if (count == input->count) continue;
    const std::string stem = input->name + std::string("_");
    throw std::invalid_argument("input_layout names " + std::to_string(count) + " of " + stem + "0 .. " + stem +
                                "7, expected all of them or none for eight views");
  }
}

bool hasEvents(const std::vector<std::string>& layout) {
  return std::any_of(layout.begin(), layout.end(),
                     [](const std::string& name) { return name.rfind("event_", 0) == 0; });
}

/// A sector is half as wide as views lie apart.
constexpr int kSectorsAView = 2;

/// What the view ahead sees, for each view: `at` are the rows of a group's eight inputs, `ahead` is the view ahead,
/// which looks into `direction`. `on`: of the inputs from one view to the next.
void spread(const std::array<std::int16_t, kDriveViews>& at, const float* ahead, int direction, int on, float* inputs,
            int stride) {
  const int all_around = on * kDriveViews;
  for (int i = 0; i < kDriveViews; ++i) {
    float* const row = inputs + at[static_cast<std::size_t>(i)] * stride;
    for (int view = 0; view < kDriveViews; ++view) {
      const auto from = static_cast<std::size_t>((i + on * (view - direction)) & (all_around - 1));
      row[view] = from < at.size() ? ahead[at[from]] : 0.0f;  // the scanner does not see all around
    }
  }
}

}  // namespace

void validate(const EncoderParameters& parameters) {
  if (parameters.input_layout.empty()) {
    throw std::invalid_argument("input_layout is empty, expected at least one input name");
  }
  std::set<std::string> seen;
  for (const std::string& name : parameters.input_layout) {
    inputNamed(name);
    if (!seen.insert(name).second) {
      throw std::invalid_argument("input_layout names '" + name + "' twice, expected each input once");
    }
  }
  if (!(std::abs(parameters.angle_span - M_PI) < kSameSpan)) {
    throw std::invalid_argument("angle_span is " + metadataText(parameters.angle_span) + ", expected pi");
  }
  checkScale("range_cap", parameters.range_cap);
  checkScale("distance_scale", parameters.distance_scale);
  checkScale("angle_scale", parameters.angle_scale);
  checkScale("action_scale", parameters.action_scale);
  if (!(parameters.position_cell >= 0.0 && parameters.position_cell <= kLargestScale)) {
    throw std::invalid_argument("position_cell is " + metadataText(parameters.position_cell) +
                                ", expected a number in [0, 1000000]");
  }
  if (!(parameters.heading_cell >= 0.0 && parameters.heading_cell <= M_PI)) {
    throw std::invalid_argument("heading_cell is " + metadataText(parameters.heading_cell) +
                                ", expected a number in [0, pi]");
  }
  if (parameters.heading_cell > 0.0 && parameters.views != 1) {
    throw std::invalid_argument("heading_cell is " + metadataText(parameters.heading_cell) +
                                ", expected 0 with eight views, which do not depend on the odometry frame");
  }
  checkScale("event_range", parameters.event_range);
  if (parameters.views != 1 && parameters.views != kDriveViews) {
    throw std::invalid_argument("views is " + std::to_string(parameters.views) + ", expected 1 or 8");
  }
  if (parameters.views != 1) checkGroupsAreWhole(parameters.input_layout);
}

void writeMetadata(const EncoderParameters& parameters, std::map<std::string, std::string>* metadata) {
  std::string layout;
  for (const std::string& name : parameters.input_layout) layout += (layout.empty() ? "" : ",") + name;
  (*metadata)["input_layout"] = layout;
  (*metadata)["sector_count"] = std::to_string(kSectorCount);
  (*metadata)["angle_span"] = metadataText(parameters.angle_span);
  (*metadata)["range_cap"] = metadataText(parameters.range_cap);
  (*metadata)["distance_scale"] = metadataText(parameters.distance_scale);
  (*metadata)["angle_scale"] = metadataText(parameters.angle_scale);
  (*metadata)["action_scale"] = metadataText(parameters.action_scale);
  (*metadata)["position_cell"] = metadataText(parameters.position_cell);
  for (const char* only_sometimes : {"heading_cell", "event_range", "views"}) metadata->erase(only_sometimes);
  if (parameters.heading_cell > 0.0) (*metadata)["heading_cell"] = metadataText(parameters.heading_cell);
  if (hasEvents(parameters.input_layout)) (*metadata)["event_range"] = metadataText(parameters.event_range);
  if (parameters.views != 1) (*metadata)["views"] = std::to_string(parameters.views);
}

EncoderParameters readEncoderParameters(MetadataReader* metadata) {
  EncoderParameters parameters;
  parameters.input_layout.clear();
  std::istringstream layout(metadata->text("input_layout"));
  for (std::string name; std::getline(layout, name, ',');) {
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    parameters.input_layout.push_back(name);
  }
  parameters.input_layout.shrink_to_fit();
  metadata->whole("sector_count", kSectorCount, kSectorCount);
  parameters.angle_span = metadata->number("angle_span", M_PI - kSameSpan, M_PI + kSameSpan);
  const auto scale = [metadata](const char* key) { return metadata->number(key, kSmallestScale, kLargestScale); };
  parameters.range_cap = scale("range_cap");
  parameters.distance_scale = scale("distance_scale");
  parameters.angle_scale = scale("angle_scale");
  parameters.action_scale = scale("action_scale");
  parameters.position_cell = metadata->number("position_cell", 0.0, kLargestScale);
  if (metadata->has("heading_cell")) parameters.heading_cell = metadata->number("heading_cell", 0.0, M_PI);
  if (hasEvents(parameters.input_layout)) parameters.event_range = scale("event_range");
  if (metadata->has("views")) parameters.views = metadata->whole("views", 1, kDriveViews);
  if (!metadata->has("input_layout")) return parameters;
  try {
    validate(parameters);
  } catch (const std::invalid_argument& error) {
    metadata->note(error.what());
  }
  return parameters;
}

Encoder::Encoder(const EncoderParameters& parameters)
    : Encoder(std::make_shared<const EncoderParameters>(parameters)) {}

Encoder::Encoder(std::shared_ptr<const EncoderParameters> parameters) : parameters_(std::move(parameters)) {
  validate(*parameters_);
  findGroups();
}

void Encoder::findGroups() {
  std::int16_t at = 0;
  for (const std::string& name : parameters_->input_layout) {
    const InputName found = inputNamed(name);
    const auto isIt = [&](const Group& group) { return group.input == found.input; };
    auto group = std::find_if(groups_.begin(), groups_.end(), isIt);
    if (group == groups_.end()) {
      group = groups_.insert(group, Group{found.input, {}});
      group->at.fill(-1);
    }
    group->at[static_cast<std::size_t>(found.index)] = at++;
  }
}

void Encoder::encode(const Observation& observation, Eigen::Ref<Eigen::VectorXf> input) const {
  if (input.size() != size()) {
    throw std::invalid_argument("the input has " + std::to_string(input.size()) + " values, expected " +
                                std::to_string(size()));
  }
  Observation seen = observation;
  if (parameters_->views != 1) {
    const ViewBearings bearings = bearingsOf(observation);
    seen.heading = 0.0;
    seen.previous_action = bearings.previous_action;
    seen.motion = bearings.motion;
  }
  for (const Group& group : groups_) {
    for (int i = 0; i < group.input->count; ++i) {
      const std::int16_t at = group.at[static_cast<std::size_t>(i)];
      if (at >= 0) input[at] = static_cast<float>(group.input->value(seen, *parameters_, i));
    }
  }
}

int viewNearest(double angle) {
  return static_cast<int>(std::lround(normalizeAngle(angle) / kViewAngle)) & (kDriveViews - 1);
}

ViewBearings bearingsOf(const Observation& observation) {
  ViewBearings bearings;
  bearings.ahead = viewNearest(observation.heading);
  bearings.goal = observation.goal_bearing;
  bearings.previous_action = normalizeAngle(observation.previous_action - observation.turn);
  bearings.motion = toLocalFrame({0.0, 0.0, observation.turn}, observation.motion);
  bearings.goal_direction = {std::cos(bearings.goal), std::sin(bearings.goal)};
  bearings.previous_direction = {std::cos(bearings.previous_action), std::sin(bearings.previous_action)};
  return bearings;
}

void Encoder::turn(const float* ahead, const ViewBearings& bearings, float* inputs, int stride) const {
  for (const Group& group : groups_) {
    float* const row = inputs + group.at[0] * stride;
    switch (group.input->turns) {
      case InputTurns::kNot:
        std::fill_n(row, kDriveViews, ahead[group.at[0]]);
        break;
      case InputTurns::kWithScanner:
        spread(group.at, ahead, bearings.ahead, kSectorsAView, inputs, stride);
        break;
      case InputTurns::kAround:
        spread(group.at, ahead, bearings.ahead, 1, inputs, stride);
        break;
      case InputTurns::kBearing:
        for (int view = 0; view < kDriveViews; ++view) {
          row[(view + bearings.ahead) % kDriveViews] =
              static_cast<float>(group.input->from(bearings, *parameters_, view));
        }
        break;
    }
  }
}

}  // namespace lstm_planner
