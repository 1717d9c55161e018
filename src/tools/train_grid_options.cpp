#include "tools/train_grid_options.hpp"

#include <cmath>
#include <stdexcept>

#include "lstm_planner/base/network/model_file.hpp"
#include "tools/output_file.hpp"
#include "tools/train_commands.hpp"

namespace lstm_planner {
namespace {

void checkAtLeastOne(const char* option, int value) {
  if (value >= 1) return;
  throw std::invalid_argument(std::string(option) + " is " + std::to_string(value) + ", expected at least 1");
}

}  // namespace

void addGridMapOptions(GridTrainingOptions* options, boost::program_options::options_description* description) {
  namespace po = boost::program_options;
  GridTrainingOptions& o = *options;
  // clang-format off
  description->add_options()
      ("task", po::value<std::string>(), "grid (this) or robot")
      ("maps", po::value(&o.maps)->multitoken(),
       "folders of the MovingAI benchmark's sets (with Maps and Scenarios in them), each DIR or DIR=WEIGHT; their maps "
       "0-5 (of more than 20 maps the first half) train, the others validate (default: generated caves, mazes and "
       "random fill)")
      ("map-size", po::value(&o.map_size)->default_value(o.map_size), "cells, of generated maps")
      ("min-length", po::value(&o.min_length)->default_value(o.min_length), "cells, of the shortest way")
      ("max-length", po::value(&o.max_length)->default_value(o.max_length), "cells, of the shortest way")
      ("epochs", po::value(&o.epochs)->default_value(o.epochs), "of the training; of each round of dagger")
      ("seed", po::value(&o.seed)->default_value(o.seed), "of everything")
      ("threads", po::value(&o.threads)->default_value(o.threads), "does not change the result");
  // clang-format on
}

void addGridTrainingOptions(GridTrainingOptions* options, boost::program_options::options_description* description) {
  namespace po = boost::program_options;
  GridTrainingOptions& o = *options;
  addGridMapOptions(options, description);
  // clang-format off
  description->add_options()
      ("method", po::value(&o.method)->default_value(o.method), "imitation, dagger, actor-critic or q-learning")
      ("network", po::value(&o.network)->default_value(o.network), "lstm, rnn or mlp")
      ("cells", po::value(&o.shape.cells)->multitoken(),
       "of each recurrent layer, or units of each layer of an mlp (default: 8 8; of an mlp 64 64 64 64)")
      ("deep-in", po::value(&o.shape.deep_in)->multitoken(), "units of each dense layer before the recurrent ones")
      ("deep-out", po::value(&o.shape.deep_out)->multitoken(), "units of each dense layer behind the recurrent ones")
      ("inputs", po::value(&o.inputs)->default_value(o.inputs),
       "thesis (ranges, distance, angle, previous action), trace (and where the agent has been) or map (and where the "
       "walls it remembers leave a way)")
      ("views", po::value(&o.encoder.views)->default_value(o.encoder.views),
       "1, or 8: the same network looks into each direction in turn")
      ("from", po::value(&o.from), "ONNX file to begin with, instead of random weights; has its own shape and inputs")
      ("output", po::value(&o.output)->required(), "ONNX file to write: the best so far on the validation maps")
      ("curve", po::value(&o.curve), "PNG file for the learning curve; a CSV file is written beside it")
      ("checkpoint", po::value(&o.checkpoint), "file to go on from where it exists, and to write for that")
      ("validation", po::value(&o.validation)->default_value(o.validation), "scenarios of each set");
  // clang-format on
}

void checkGridMapOptions(const GridTrainingOptions& options) {
  checkAtLeastOne("--epochs", options.epochs);
  checkAtLeastOne("--threads", options.threads);
  constexpr int kSmallestMap = 16;
  constexpr int kLargestMap = 4096;
  if (options.map_size < kSmallestMap || options.map_size > kLargestMap) {
    throw std::invalid_argument("--map-size is " + std::to_string(options.map_size) + ", expected 16 to 4096");
  }
}

void finishGridTrainingOptions(const boost::program_options::variables_map& values,
                               const std::vector<std::string>& arguments, GridTrainingOptions* options) {
  GridTrainingOptions& o = *options;
  o.command = trainCommandLine(arguments);
  checkGridMapOptions(o);
  checkAtLeastOne("--validation", o.validation);
  o.encoder.inputs = gridInputsNamed(o.inputs);
  const GridEncoder encoder(o.encoder);
  o.shape.kind = networkKindNamed(o.network);
  if (values.count("cells") == 0 && o.shape.kind == NetworkShape::Kind::kMlp) o.shape.cells = {64, 64, 64, 64};
  makeNetwork(encoder.size(), o.shape, encoder.outputs());
  checkWritable(o.output);
  if (!o.curve.empty()) checkWritable(o.curve);
  if (!o.checkpoint.empty()) checkWritable(o.checkpoint);
}

nlohmann::json settingsOf(const GridTrainingOptions& options) {
  return {{"method", options.method},
          {"maps", options.maps},
          {"map-size", options.map_size},
          {"min-length", options.min_length},
          {"max-length", options.max_length},
          {"network", options.network},
          {"cells", options.shape.cells},
          {"deep-in", options.shape.deep_in},
          {"deep-out", options.shape.deep_out},
          {"inputs", options.inputs},
          {"views", options.encoder.views},
          {"from", options.from},
          {"epochs", options.epochs},
          {"validation", options.validation},
          {"seed", options.seed}};
}

LayerStack firstLayers(GridTrainingOptions* options) {
  if (!options->from.empty()) {
    const Model model = readModelFile(options->from);
    try {
      options->encoder = readGridEncoderParameters(model.metadata);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("--from " + options->from + ": " + error.what());
    }
    return model.layers;
  }
  const GridEncoder encoder(options->encoder);
  LayerStack layers = makeNetwork(encoder.size(), options->shape, encoder.outputs());
  initialise({}, options->seed, layers);
  return layers;
}

}  // namespace lstm_planner
