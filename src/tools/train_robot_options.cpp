#include "tools/train_robot_options.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "tools/train_commands.hpp"

namespace lstm_planner {

namespace {

/// A view may look away from where the robot went, and from where the scanner looks.
void fitInputsToViews(EncoderParameters* encoder) {
  std::vector<std::string>& layout = encoder->input_layout;
  const auto previous = std::find(layout.begin(), layout.end(), "previous_action");
  if (previous != layout.end()) {
    *previous = "previous_action_sin";
    layout.insert(previous + 1, "previous_action_cos");
  }
  for (int i = 0; i < kSectorCount; ++i) layout.push_back("seen_" + std::to_string(i));
  validate(*encoder);
}

}  // namespace

void addRobotNetworkOptions(RobotNetworkOptions* options, EncoderParameters* encoder,
                            boost::program_options::options_description* description) {
  namespace po = boost::program_options;
  // clang-format off
  description->add_options()
      ("inputs", po::value(&options->inputs)->multitoken(),
       "beside the thesis's: events (a sector below --event-range), events-alone (in place of the ranges), visits (how often it was at the places a step "
       "away), trace (the same on three scales, how long ago, and its progress), motion (since the last step)")
      ("event-range", po::value(&encoder->event_range)->default_value(encoder->event_range), "m; nearer is an event")
      ("position-cell", po::value(&encoder->position_cell)->default_value(encoder->position_cell),
       "m, to which the odometry is rounded; 0: not at all")
      ("views", po::value(&encoder->views)->default_value(encoder->views),
       "1: an output an angle; 8: the network looks into each of eight directions, with an output and a memory each "
       "(by reinforcement only)")
      ("network", po::value(&options->network)->default_value(options->network), "lstm, rnn or mlp")
      ("cells", po::value(&options->shape.cells)->multitoken(),
       "of each recurrent layer, or units of each layer of an mlp (default: 8 8; of an mlp 64 64)")
      ("deep-in", po::value(&options->shape.deep_in)->multitoken(),
       "units of each dense layer before the recurrent ones")
      ("deep-out", po::value(&options->shape.deep_out)->multitoken(),
       "units of each dense layer behind the recurrent ones");
  // clang-format on
}

void checkModelDecides(const boost::program_options::variables_map& values) {
  for (const char* decided : {"inputs", "event-range", "position-cell", "views", "network", "cells", "deep-in",
                              "deep-out"}) {
    if (values.count(decided) == 0 || values[decided].defaulted()) continue;
    throw std::invalid_argument(std::string("--") + decided + " is decided by the model of --init");
  }
}

void finishRobotNetworkOptions(const boost::program_options::variables_map& values, RobotNetworkOptions* options,
                               EncoderParameters* encoder) {
  addInputs(options->inputs, encoder);
  if (encoder->views != 1) fitInputsToViews(encoder);
  options->shape.kind = networkKindNamed(options->network);
  if (values.count("cells") == 0 && options->shape.kind == NetworkShape::Kind::kMlp) options->shape.cells = {64, 64};
  makeNetwork(static_cast<int>(encoder->input_layout.size()), options->shape, 1);  // throws
}

void addRobotTrainingOptions(RobotTrainingOptions* options, boost::program_options::options_description* description) {
  namespace po = boost::program_options;
  RobotTrainingOptions& o = *options;
  // clang-format off
  description->add_options()
      ("task", po::value<std::string>()->default_value("robot"), "robot (this) or grid")
      ("method", po::value<std::string>(),
       "dagger (default), actor-critic, q-learning or dataset; --method NAME --help explains it")
      ("output", po::value(&o.output)->default_value(o.output), "ONNX file to write")
      ("kinds", po::value(&o.kinds)->multitoken(),
       "of generated worlds: mazes offices corridors forest open rooms (default: all)")
      ("dead-ends", po::value(&o.course.dead_end_share)->default_value(o.course.dead_end_share),
       "share of the drives that start in a dead end")
      ("shortest", po::value(&o.course.shortest)->default_value(o.course.shortest),
       "m of way from start to goal at the least")
      ("max-steps", po::value(&o.max_steps)->default_value(o.max_steps), "of a drive")
      ("validation", po::value(&o.validation)->default_value(o.validation), "worlds that are never trained on")
      ("seed", po::value(&o.seed)->default_value(o.seed), "of everything")
      ("threads", po::value(&o.threads)->default_value(o.threads), "does not change the result");
  // clang-format on
}

void finishRobotTrainingOptions(const std::vector<std::string>& arguments, RobotTrainingOptions* options) {
  options->command = trainCommandLine(arguments);
  if (!options->kinds.empty()) {
    options->course.worlds.clear();
    for (const std::string& kind : options->kinds) options->course.worlds.push_back(worldKindOf(kind));
  }
  if (options->validation < 1 || options->max_steps < 1 || options->threads < 1) {
    throw std::invalid_argument("--validation, --max-steps and --threads must be at least 1");
  }
  validate(options->course);
}

nlohmann::json settingsOf(const RobotTrainingOptions& options) {
  std::vector<std::string> kinds;
  for (const WorldKind kind : options.course.worlds) kinds.emplace_back(toString(kind));
  return {{"task", "robot"},
          {"kinds", kinds},
          {"dead-ends", options.course.dead_end_share},
          {"shortest", options.course.shortest},
          {"max-steps", options.max_steps},
          {"validation", options.validation},
          {"seed", options.seed}};
}

void addInputs(const std::vector<std::string>& groups, EncoderParameters* encoder) {
  std::vector<std::string>& layout = encoder->input_layout;
  for (const std::string& group : groups) {
    if (group == "visits") {
      for (int i = 0; i < kPlaceDirections; ++i) layout.push_back("visits_" + std::to_string(i));
    } else if (group == "events") {
      for (int i = 0; i < kSectorCount; ++i) layout.push_back("event_" + std::to_string(i));
    } else if (group == "events-alone") {
      for (std::string& name : layout) {
        if (name.rfind("sector_", 0) == 0) name.replace(0, 7, "event_");
      }
    } else if (group == "trace") {
      for (const char* name : {"step_visits_", "step_freshness_", "room_visits_", "room_freshness_", "hall_visits_",
                               "hall_freshness_"}) {
        for (int i = 0; i < kPlaceDirections; ++i) layout.push_back(name + std::to_string(i));
      }
      layout.insert(layout.end(), {"room_visits", "behind_best", "steps_since_best"});
    } else if (group == "motion") {
      layout.insert(layout.end(), {"motion_forward", "motion_left", "motion_turn"});
    } else {
      throw std::invalid_argument("--inputs names '" + group +
                                  "', expected some of events, events-alone, visits, trace, motion");
    }
  }
  validate(*encoder);
}

void writeRobotModel(const RobotTrainingOptions& options, const PolicyDescription& policy, const LayerStack& layers,
                     const DriveScore& score) {
  Model model;
  model.layers = layers;
  writeMetadata(policy, &model.metadata);
  model.metadata["training_command"] = options.command;
  model.metadata["score"] =
      std::to_string(score.drives) + " validation drives by the network and the shield: " + toText(score);
  writeModelFile(options.output, model);
}

std::string toText(const DriveScore& score) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << "arrival " << score.arrival << ", efficiency " << score.efficiency;
  return text.str();
}

}  // namespace lstm_planner
