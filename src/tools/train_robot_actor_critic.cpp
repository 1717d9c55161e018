#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <stdexcept>

#include "lstm_planner/learning/drive_actor_critic.hpp"
#include "lstm_planner/learning/training_checkpoint.hpp"
#include "tools/actor_critic_options.hpp"
#include "tools/interruption.hpp"
#include "tools/options.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_robot_options.hpp"

namespace lstm_planner {

namespace {

/// Times that the network is judged, and a checkpoint written, in a whole training.
constexpr int kJudgements = 10;

struct ReinforcementOptions : RobotTrainingOptions {
  std::string init;
  RobotNetworkOptions network;
  std::string checkpoint;
  DriveActorCriticParameters learner;
  nlohmann::json settings;
};

/// A model to begin with has its own inputs and shape.
void finishNetwork(const boost::program_options::variables_map& values, ReinforcementOptions* options) {
  if (!options->init.empty()) {
    checkModelDecides(values);
    return;
  }
  finishRobotNetworkOptions(values, &options->network, &options->learner.policy.encoder);
  if (values["sharpness"].defaulted()) options->learner.sharpness = 1.0;  // there is nothing to sharpen yet
}

bool readOptions(const std::vector<std::string>& arguments, ReinforcementOptions* options) {
  namespace po = boost::program_options;
  DriveActorCriticParameters& p = options->learner;
  po::options_description description("the robot, by reinforcement: of a network that drives already, or of a new one");
  addRobotTrainingOptions(options, &description);
  // clang-format off
  description.add_options()
      ("init", po::value(&options->init), "model file to begin with; decides inputs and shape")
      ("checkpoint", po::value(&options->checkpoint), "file to go on from and to write to")
      ("iterations", po::value(&p.iterations)->default_value(p.iterations), "of collecting and learning")
      ("worlds", po::value(&p.worlds)->default_value(p.worlds), "an iteration")
      ("goals", po::value(&p.goals)->default_value(p.goals), "a world")
      ("starts", po::value(&p.starts)->default_value(p.starts), "drives to a goal")
      ("window", po::value(&p.window)->default_value(p.window), "steps that errors go back at most")
      ("passes", po::value(&p.passes)->default_value(p.passes), "over what was collected")
      ("sharpness", po::value(&p.sharpness)->default_value(p.sharpness), "times the first network's preferences")
      ("clip", po::value(&p.clip)->default_value(p.clip), "how far a probability may change at once");
  // clang-format on
  addRobotNetworkOptions(&options->network, &p.policy.encoder, &description);
  addActorCriticOptions("m", &p, &description);
  po::variables_map values;
  if (!parseOptions("train", description, arguments, &values)) return false;
  finishRobotTrainingOptions(arguments, options);
  finishNetwork(values, options);
  p.course = options->course;
  p.max_steps = options->max_steps;
  p.seed = options->seed;
  p.threads = options->threads;
  options->settings = settingsOf(*options);
  options->settings.update({{"method", "actor-critic"},
                            {"init", options->init},
                            {"inputs", p.policy.encoder.input_layout},
                            {"network", options->network.network},
                            {"cells", options->network.shape.cells},
                            {"deep-in", options->network.shape.deep_in},
                            {"deep-out", options->network.shape.deep_out},
                            {"iterations", p.iterations},
                            {"worlds", p.worlds},
                            {"goals", p.goals},
                            {"starts", p.starts},
                            {"window", p.window},
                            {"passes", p.passes},
                            {"sharpness", p.sharpness},
                            {"clip", p.clip}});
  options->settings.update(actorCriticSettings(p));
  // Not told where there is one: checkpoints from before there were views go on.
  if (p.policy.encoder.views != 1) options->settings["views"] = p.policy.encoder.views;
  return true;
}

LayerStack firstLayers(ReinforcementOptions* options) {
  PolicyDescription& policy = options->learner.policy;
  if (!options->init.empty()) {
    Model model = readModelFile(options->init);
    policy = readPolicyDescription(model.metadata);
    return std::move(model.layers);
  }
  const int inputs = static_cast<int>(policy.encoder.input_layout.size());
  LayerStack layers = makeNetwork(inputs, options->network.shape, networkOutputs(policy));
  initialise({}, options->seed, layers);
  return layers;
}

class RobotReinforcement {
 public:
  RobotReinforcement(const ReinforcementOptions& options, LayerStack layers)
      : options_(options), learner_(options.learner, std::move(layers)) {}

  int run() {
    const Interruption interruption;
    restore();
    std::cout << "iteration     steps  reward  arrival  entropy  explained | validation drives" << std::endl;
    if (learner_.iterations() == 0) judge();
    const int interval = std::max(1, options_.learner.iterations / kJudgements);
    while (learner_.iterations() < options_.learner.iterations) {
      print(learner_.iterate());
      const int done = learner_.iterations();
      bar_.show(static_cast<double>(done) / options_.learner.iterations);
      const bool stop = interruption.wanted() && done < options_.learner.iterations;
      // A break leaves no trace: it is judged only where nothing else is kept.
      const bool due = done % interval == 0 || done == options_.learner.iterations;
      if (due || (stop && options_.checkpoint.empty())) judge();
      if (due || stop) writeCheckpoint();
      if (stop) {
        std::cout << "interrupted; "
                  << (options_.checkpoint.empty() ? "without --checkpoint the training cannot be gone on with"
                                                  : "the same command goes on from here")
                  << std::endl;
        return interruption.exitStatus();
      }
    }
    std::cout << "wrote " << options_.output << ": efficiency " << best_ << std::endl;
    return 0;
  }

 private:
  static void print(const DriveActorCriticReport& report) {
    std::cout << std::fixed << std::setw(9) << report.iteration << std::setprecision(0) << std::setw(10) << report.steps
              << std::setprecision(3) << std::setw(8) << report.reward << std::setw(9) << report.arrival << std::setw(9)
              << report.entropy << std::setw(11) << report.explained << std::endl;
  }

  /// Keeps the most efficient network.
  void judge() {
    const DriveScore score = judgeDrives(DrivePolicy(options_.learner.policy, learner_.layers()), options_.course,
                                         options_.validation, options_.max_steps, options_.seed, options_.threads);
    const bool best = score.efficiency > best_;
    if (best) {
      best_ = score.efficiency;
      writeRobotModel(options_, options_.learner.policy, learner_.layers(), score);
    }
    std::cout << std::string(58, ' ') << "| " << toText(score) << (best ? " (best)" : "") << std::endl;
  }

  void restore() {
    if (options_.checkpoint.empty()) return;
    const auto checkpoint = readTrainingCheckpoint(options_.checkpoint, options_.settings);
    if (!checkpoint) return;
    learner_.restore(checkpoint->learner);
    const bool kept =
        checkpoint->progress.value("output", "") == options_.output && std::filesystem::exists(options_.output);
    if (kept) best_ = checkpoint->progress.at("best").get<double>();
    std::cout << "going on from " << options_.checkpoint << " after iteration " << learner_.iterations() << std::endl;
  }

  void writeCheckpoint() const {
    if (options_.checkpoint.empty()) return;
    writeTrainingCheckpoint(options_.checkpoint,
                            {options_.settings, {{"best", best_}, {"output", options_.output}}, learner_.checkpoint()});
  }

  const ReinforcementOptions& options_;
  DriveActorCritic learner_;
  Progress bar_;
  double best_ = -1.0;
};

}  // namespace

int trainRobotByActorCritic(const std::vector<std::string>& arguments) {
  ReinforcementOptions options;
  if (!readOptions(arguments, &options)) return 0;
  LayerStack layers = firstLayers(&options);
  checkWritable(options.output);
  return RobotReinforcement(options, std::move(layers)).run();
}

}  // namespace lstm_planner
