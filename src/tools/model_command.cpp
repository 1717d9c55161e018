#include <array>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/shared_file.hpp"

namespace lstm_planner {
namespace {

/// Which of the two worlds a model says that it was made for.
bool isForGrid(const Model& model) { return model.metadata.count("grid_inputs") > 0; }

/// What is wrong with the metadata, in addition to a graph that cannot be read; empty when nothing is.
std::string faultsOfMetadata(const std::string& file) {
  try {
    const Model model{{}, readModelMetadata(file)};
    if (!isForGrid(model)) readPolicyDescription(model.metadata);
  } catch (const ModelFileError&) {
    return "";  // no more can be said of such a file
  } catch (const std::invalid_argument& error) {
    return std::string("; ") + error.what();
  }
  return "";
}

Model readToCheck(const std::string& file) {
  try {
    return readModelFile(file);
  } catch (const ModelFileError& error) {
    throw ModelFileError(error.what() + faultsOfMetadata(file));
  }
}

/// Throws ModelFileError with all that is missing or does not fit.
void checkModel(const std::string& file, const Model& model) {
  try {
    if (isForGrid(model)) {
      NetworkGridAgent(model, {});
    } else {
      DrivePolicy(readPolicyDescription(model.metadata), model.layers);
    }
  } catch (const std::invalid_argument& error) {
    throw ModelFileError(file + ": " + error.what());
  }
}

const char* toString(Activation activation) {
  constexpr std::array<const char*, 4> kNames = {"", ", tanh", ", sigmoid", ", relu"};
  return kNames.at(static_cast<std::size_t>(activation));
}

/// "LSTM 14 -> 32".
std::string textOf(const Layer& layer) {
  std::ostringstream text;
  if (const auto* lstm = std::get_if<LstmLayer>(&layer)) {
    text << "LSTM " << lstm->input.cols() << " -> " << lstm->recurrent.cols()
         << (lstm->candidate == Activation::kTanh ? "" : ", candidate sigmoid");
  } else if (const auto* recurrent = std::get_if<RecurrentLayer>(&layer)) {
    text << "RNN " << recurrent->input.cols() << " -> " << recurrent->recurrent.cols();
  } else if (const auto* dense = std::get_if<DenseLayer>(&layer)) {
    text << "dense " << dense->weights.cols() << " -> " << dense->weights.rows() << toString(dense->activation);
  } else {
    text << "softmax";
  }
  return text.str();
}

void printModel(const Model& model) {
  std::cout << "layers   ";
  for (std::size_t i = 0; i < model.layers.size(); ++i) std::cout << (i > 0 ? "; " : "") << textOf(model.layers[i]);
  std::cout << "\nweights  " << countWeights(model.layers) << "\ninputs   " << inputSize(model.layers) << "\noutputs  "
            << outputSize(model.layers) << "\nfor      "
            << (isForGrid(model)         ? "the grid world"
                : model.metadata.empty() ? "nothing yet: it has no metadata"
                                         : "the robot")
            << "\n";
  if (!model.metadata.empty()) std::cout << "metadata\n";
  for (const auto& [key, value] : model.metadata) std::cout << "  " << leftText(key, 17) << value << "\n";
}

/// The file that is the only argument of info and check.
std::string fileOf(const std::string& action, const std::string& summary, const std::vector<std::string>& arguments) {
  std::string file;
  CommandLine line("model " + action, summary);
  line.addFile("file", &file, "the ONNX file").required().standsAlone();
  return line.parse(arguments) ? findSharedFile(file) : "";
}

int modelInfo(const std::vector<std::string>& arguments) {
  const std::string file = fileOf("info", "prints what a model file contains", arguments);
  if (!file.empty()) printModel(readModelFile(file));
  return 0;
}

int modelCheck(const std::vector<std::string>& arguments) {
  const std::string file = fileOf(
      "check", "checks whether a model can be used; if not, prints everything that is missing or wrong", arguments);
  if (file.empty()) return 0;
  const Model model = readToCheck(file);
  checkModel(file, model);
  std::cout << file << ": a model for " << (isForGrid(model) ? "the grid world" : "the robot") << " that can be used\n";
  return 0;
}

struct Conversion {
  std::string file;
  Model model;
  std::string output;
  std::string task = "robot";
  std::vector<std::string> layout;
  std::vector<int> angles;  ///< degrees
  PolicyDescription policy;
  std::optional<int> views;
  std::string made_by;
};

/// What a model for the robot says already stays, unless an option behind this one says otherwise.
void readModel(const std::string& file, Conversion* conversion) {
  conversion->file = file;
  conversion->model = readModelFile(file);
  if (conversion->model.metadata.count("input_layout") == 0) return;
  try {
    conversion->policy = readPolicyDescription(conversion->model.metadata);
  } catch (const std::invalid_argument&) {
    // The options say all of it.
  }
}

void addRobotOptions(Conversion* conversion, CommandLine* line) {
  EncoderParameters& encoder = conversion->policy.encoder;
  line->section("inputs and outputs of the robot's network; see models/onnx.md");
  line->add("layout", &conversion->layout, "names of the inputs, in their order (default: the thesis's fourteen)");
  line->add("range-cap", &encoder.range_cap, {0.001, 1e6}, "m; the input of a sector is range / range-cap");
  line->add("distance-scale", &encoder.distance_scale, {0.001, 1e6},
            "m; the input of the goal's distance d is d / (d + distance-scale)");
  line->add("angle-scale", &encoder.angle_scale, {0.001, 1e6}, "rad; goal_bearing and heading are divided by it");
  line->add("action-scale", &encoder.action_scale, {0.001, 1e6}, "rad; previous_action is divided by it");
  line->add("position-cell", &encoder.position_cell, {0.0, 1e6},
            "m; the position is rounded to multiples of this; 0: it is not rounded");
  line->add("heading-cell", &encoder.heading_cell, {0.0, M_PI},
            "rad; the heading is rounded to multiples of this; 0: it is not rounded");
  line->add("event-range", &encoder.event_range, {0.001, 1e6}, "m; a sector with a smaller mean range is an event");
  line->add("actions", &conversion->angles, {-180.0, 180.0},
            "degrees; steering angle of each output, from right to left (default: -90 -45 0 45 90)");
  line->add("step-length", &conversion->policy.step_length, {0.001, 1000.0}, "m from decision to decision");
  line->add("robot-radius", &conversion->policy.footprint_radius, {0.001, 1000.0},
            "m; radius of the robot that the network was trained with");
  line->add("smallest-robot", &conversion->policy.smallest_radius, {0.0, 1000.0},
            "m; smallest radius of a robot that the network was tried with; 0: not known");
  line->add("largest-robot", &conversion->policy.largest_radius, {0.0, 1000.0},
            "m; largest radius of a robot that the network was tried with; 0: not known");
}

bool readConversion(const std::vector<std::string>& arguments, Conversion* conversion) {
  CommandLine line("model convert", "adds the metadata to a network that was exported elsewhere");
  // Read when it is taken: the options behind it change what the model says.
  const auto read = [conversion](const std::string& file) { readModel(file, conversion); };
  line.addText("file", "", read, "the ONNX file").required().standsAlone().mayBeReplaced().value_name = "FILE";
  line.addOutput("output", &conversion->output, "ONNX file to write").required();
  line.addChoice("task", &conversion->task, {"robot", "grid"}, "what the network was made for: robot or grid");
  line.add("views", &conversion->views, {1, 8},
           "1: one output per action; 8: one output, evaluated for each of eight directions")
      .default_text = "1";
  line.add("made-by", &conversion->made_by, "how the network was trained; is stored in the file as training_command");
  addRobotOptions(conversion, &line);
  line.whenParsed([conversion, &line] {
    Conversion& c = *conversion;
    if (c.task == "grid") {
      line.refuseIdle(
          {"views", "layout", "range-cap", "distance-scale", "angle-scale", "action-scale", "position-cell",
           "heading-cell", "event-range", "actions", "step-length", "robot-radius", "smallest-robot", "largest-robot"},
          "with --task grid");
    }
    if (!c.layout.empty()) c.policy.encoder.input_layout = c.layout;
    if (c.views) c.policy.encoder.views = *c.views;
    if (!c.angles.empty()) {
      std::vector<double> angles;
      for (const int degrees : c.angles) angles.push_back(degrees * M_PI / 180.0);
      c.policy.actions = ActionSet(angles);
    }
  });
  return line.parse(arguments);
}

int modelConvert(const std::vector<std::string>& arguments) {
  Conversion conversion;
  if (!readConversion(arguments, &conversion)) return 0;
  Model& model = conversion.model;
  if (conversion.task == "grid") {
    writeGridMetadata(&model.metadata);
  } else {
    writeMetadata(conversion.policy, &model.metadata);
  }
  if (!conversion.made_by.empty()) model.metadata["training_command"] = conversion.made_by;
  checkModel(conversion.file, model);
  writeModelFile(conversion.output, model);
  printModel(model);
  return 0;
}

}  // namespace

int runModel(const std::vector<std::string>& arguments) {
  static const std::vector<Command> actions = {
      {"info", "print what a model file contains", modelInfo},
      {"check", "check whether a model can be used", modelCheck},
      {"convert", "add the metadata to a network that was exported elsewhere", modelConvert},
  };
  return runAction("model", actions, arguments);
}

}  // namespace lstm_planner
