#include "tools/train_robot_options.hpp"

#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "tools/train_commands.hpp"

namespace lstm_planner {

void addRobotTrainingOptions(RobotTrainingOptions* options, boost::program_options::options_description* description) {
  namespace po = boost::program_options;
  RobotTrainingOptions& o = *options;
  // clang-format off
  description->add_options()
      ("task", po::value<std::string>()->default_value("robot"), "robot (this) or grid")
      ("method", po::value<std::string>(), "dagger (default), actor-critic or dataset; --method NAME --help explains it")
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
    if (group == "route") {
      layout.insert(layout.end(), {"route_bearing_sin", "route_bearing_cos", "route_detour"});
    } else if (group == "visits") {
      for (int i = 0; i < kPlaceDirections; ++i) layout.push_back("visits_" + std::to_string(i));
    } else if (group == "events") {
      for (int i = 0; i < kSectorCount; ++i) layout.push_back("event_" + std::to_string(i));
    } else {
      throw std::invalid_argument("--inputs names '" + group + "', expected some of events, visits, route");
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
