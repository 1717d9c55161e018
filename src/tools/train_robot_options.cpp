#include "tools/train_robot_options.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "tools/ranges.hpp"
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

/// One number in place of sine and cosine.
void useAnglesAlone(std::vector<std::string>* layout) {
  for (const std::string angle : {"goal_bearing", "heading"}) {
    std::replace(layout->begin(), layout->end(), angle + "_sin", angle);
    layout->erase(std::remove(layout->begin(), layout->end(), angle + "_cos"), layout->end());
  }
}

}  // namespace

void addRobotNetworkOptions(RobotNetworkOptions* options, EncoderParameters* encoder, CommandLine* line) {
  line->add("inputs", &options->inputs,
            "beside the thesis's: events (a sector below --event-range), events-alone (in place of the ranges), angles "
            "(bearing and heading as one number each, the thesis's twelve, in place of sine and cosine), visits "
            "(how often it was at the places a step away), trace (the same on three scales, how long ago, and its "
            "progress), motion (since the last step)");
  line->add("event-range", &encoder->event_range, {0.0, 1000.0}, "m; nearer is an event");
  line->add("position-cell", &encoder->position_cell, {0.0, 1000.0},
            "m, to which the odometry is rounded; 0: not at all");
  line->add("heading-cell", &encoder->heading_cell, {0.0, M_PI},
            "rad, to which the odometry's heading is rounded; 0: not at all");
  line->add(
      "views", &encoder->views, {1, 8},
      "1: an output an angle; 8: the network looks into each of eight directions, with an output and a memory each "
      "(by reinforcement only)");
  line->add("network", &options->network, "lstm, rnn or mlp");
  line->add("cells", &options->shape.cells, kAnyLayer,
            "of each recurrent layer, or units of each layer of an mlp (of which there are 64 64 by default)");
  line->add("deep-in", &options->shape.deep_in, kAnyLayer, "units of each dense layer before the recurrent ones");
  line->add("deep-out", &options->shape.deep_out, kAnyLayer, "units of each dense layer behind the recurrent ones");
}

void checkModelDecides(const CommandLine& line) {
  for (const char* decided :
       {"inputs", "event-range", "position-cell", "heading-cell", "views", "network", "cells", "deep-in", "deep-out"}) {
    if (line.given(decided))
      throw std::invalid_argument(std::string("--") + decided + " is decided by the model of --init");
  }
}

void finishRobotNetworkOptions(const CommandLine& line, RobotNetworkOptions* options, EncoderParameters* encoder) {
  addInputs(options->inputs, encoder);
  if (encoder->views != 1) fitInputsToViews(encoder);
  options->shape.kind = networkKindNamed(options->network);
  if (!line.given("cells") && options->shape.kind == NetworkShape::Kind::kMlp) options->shape.cells = {64, 64};
  makeNetwork(static_cast<int>(encoder->input_layout.size()), options->shape, 1);  // throws
}

void addRobotTrainingOptions(const std::vector<std::string>& arguments, RobotTrainingOptions* options,
                             CommandLine* line) {
  RobotTrainingOptions& o = *options;
  o.command = trainCommandLine(arguments);
  line->addChoice("task", &o.task, {"robot", "grid"}, "robot (this) or grid");
  line->add("method", &o.method,
            "dagger (default), actor-critic, q-learning or dataset; --method NAME --help explains it");
  line->addOutput("output", &o.output, "ONNX file to write");
  line->add("kinds", &o.kinds, "of generated worlds: mazes offices corridors forest open rooms (default: all)");
  line->add("dead-ends", &o.course.dead_end_share, kAnyShare, "share of the drives that start in a dead end");
  line->add("shortest", &o.course.shortest, {0.01, 1e4}, "m of path from start to goal at the least");
  line->add("max-steps", &o.max_steps, kAnyCount, "of a drive");
  line->add("validation", &o.validation, kAnyCount, "worlds that are never trained on");
  line->addSeed(&o.seed, "of everything");
  line->add("threads", &o.threads, kAnyThreads, "does not change the result");
  line->whenParsed([options] {
    if (!options->kinds.empty()) options->course.worlds.clear();
    for (const std::string& kind : options->kinds) options->course.worlds.push_back(worldKindOf(kind));
    validate(options->course);
  });
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
    } else if (group == "angles") {
      useAnglesAlone(&layout);
    } else if (group == "trace") {
      for (const char* name :
           {"step_visits_", "step_freshness_", "room_visits_", "room_freshness_", "hall_visits_", "hall_freshness_"}) {
        for (int i = 0; i < kPlaceDirections; ++i) layout.push_back(name + std::to_string(i));
      }
      layout.insert(layout.end(), {"room_visits", "behind_best", "steps_since_best"});
    } else if (group == "motion") {
      layout.insert(layout.end(), {"motion_forward", "motion_left", "motion_turn"});
    } else {
      throw std::invalid_argument("--inputs names '" + group +
                                  "', expected some of events, events-alone, angles, visits, trace, motion");
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
