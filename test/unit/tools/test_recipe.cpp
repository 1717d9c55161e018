// Recipes of trainings: models/recipes, and what `lstm_planner train` makes of a recipe.

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/network/model_file.hpp"
#include "support/refusal.hpp"
#include "support/tool_test.hpp"
#include "tools/recipe.hpp"

namespace lstm_planner::test_recipe {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

class Recipe : public test::ToolTest {
 protected:
  std::string recipe(const std::string& text) const {
    std::ofstream(in("recipe.yaml")) << text;
    return in("recipe.yaml");
  }
};

TEST_F(Recipe, GivesAnOptionForEachKey) {
  const std::string file = recipe("task: grid\ncells: [8, 8]\nthesis: true\nrate: 0.01\n");
  EXPECT_EQ(expandRecipe({file}), (Arguments{"--task=grid", "--cells", "8", "8", "--thesis", "--rate=0.01"}));
}

TEST_F(Recipe, SettingsReplaceWhatItSays) {
  const std::string file = recipe("seed: 1\ncells: [8, 8]\nthesis: true\n");
  EXPECT_EQ(expandRecipe({file, "seed=2", "thesis=false", "kinds=[mazes,open]"}),
            (Arguments{"--cells", "8", "8", "--seed=2", "--kinds", "mazes", "open"}));
  EXPECT_EQ(expandRecipe({file, "thesis=false", "--cells", "4", "--seed=3"}), (Arguments{"--cells", "4", "--seed=3"}));
}

TEST_F(Recipe, AnEmptyListLeavesTheDefault) {
  EXPECT_EQ(expandRecipe({recipe("seed: 1\ninputs: [events, trace]\nkinds: []\n"), "inputs=[]"}),
            (Arguments{"--seed=1"}));
}

TEST_F(Recipe, OptionsStayAsTheyAre) {
  const Arguments options{"--maps", "a=0.5", "b", "--seed", "2", "--help"};
  EXPECT_EQ(expandRecipe(options), options);
}

TEST_F(Recipe, WhatCannotBeReadIsRefused) {
  const auto refusal = [](const Arguments& arguments) {
    return test::refusalOf<std::invalid_argument>([&] { expandRecipe(arguments); });
  };
  EXPECT_EQ(refusal({"no_such"}),
            "there is no recipe 'no_such', expected a yaml file, or the NAME of a models/recipes/NAME.yaml");
  EXPECT_NE(refusal({recipe("- 1\n")}).find("expected KEY: VALUE in each line"), std::string::npos);
  EXPECT_NE(refusal({recipe("cells: {a: 1}\n")}).find("cells: expected a number, a text, or a list"),
            std::string::npos);
  EXPECT_NE(refusal({recipe("a: [1\n")}).find("recipe.yaml: "), std::string::npos);
  EXPECT_NE(refusal({recipe("kinds: [open]\nseed: 1\nkinds: [rooms]\n")}).find("recipe.yaml: kinds is given twice"),
            std::string::npos);
  EXPECT_NE(refusal({recipe("seed: 1\n---\nseed: 2\n")}).find("a second document follows behind '---'"),
            std::string::npos);
  EXPECT_NE(refusal({recipe("seed: 1\n? [a]\n: 2\n")}).find("recipe.yaml, line 2: a list"), std::string::npos);
  EXPECT_NE(refusal({LSTM_PLANNER_SOURCE_DIR "/models/create2_lstm.onnx"}).find("expected KEY: VALUE in each line"),
            std::string::npos)
      << "a model is no recipe";
  EXPECT_EQ(refusal({"cells=[1"}), "cells is '[1', expected a list, as in [1, 2]");
}

/// Values by keys. Where it was written, and in how many threads, is not part of a recipe.
using Settings = std::map<std::string, Arguments>;

void leaveOut(Settings* settings) {
  for (const char* key : {"output", "curve", "checkpoint", "threads"}) settings->erase(key);
  const Arguments usual{"1"};
  if (settings->count("seed") > 0 && settings->at("seed") == usual) settings->erase("seed");
  // Models of the grid world name the inputs and the view that all have today.
  if (settings->count("task") > 0) settings->erase("inputs");
  if (settings->count("task") > 0) settings->erase("views");
}

Settings settingsOf(const Arguments& options) {
  Settings settings;
  std::string key;
  for (const std::string& word : options) {
    if (word.compare(0, 2, "--") != 0) {
      settings[key].push_back(word);
      continue;
    }
    const std::size_t equals = word.find('=');
    key = word.substr(2, equals - 2);
    settings[key];
    if (equals != std::string::npos) settings[key].push_back(word.substr(equals + 1));
  }
  leaveOut(&settings);
  return settings;
}

Arguments wordsOf(const std::string& command) {
  std::istringstream words(command);
  Arguments arguments;
  for (std::string word; words >> word;) arguments.push_back(word);
  return {arguments.begin() + 2, arguments.end()};
}

const fs::path kModels = fs::path(LSTM_PLANNER_SOURCE_DIR) / "models";

std::set<std::string> namesIn(const fs::path& folder, const std::string& extension) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) names.insert(entry.path().stem());
  }
  return names;
}

std::string recipeOf(const std::string& name) { return (kModels / "recipes" / (name + ".yaml")).string(); }

TEST_F(Recipe, OfAShippedModelIsTheCommandThatTrainedIt) {
  for (const std::string& name : namesIn(kModels, ".onnx")) {
    const auto metadata = readModelMetadata((kModels / (name + ".onnx")).string());
    EXPECT_EQ(settingsOf(expandRecipe({recipeOf(name)})), settingsOf(wordsOf(metadata.at("training_command")))) << name;
  }
}

TEST_F(Recipe, IsOfAShippedModelOrOfTheOneWithWhichItsTrainingBegins) {
  std::set<std::string> expected = namesIn(kModels, ".onnx");
  for (const std::string& name : namesIn(kModels, ".onnx")) {
    const Settings settings = settingsOf(expandRecipe({recipeOf(name)}));
    if (settings.count("init") > 0) expected.insert(fs::path(settings.at("init").front()).stem());
  }
  EXPECT_EQ(namesIn(kModels / "recipes", ".yaml"), expected);
}

TEST_F(Recipe, ThatIsShippedCanBeReadAndIsNamedByTheHelp) {
  const std::string named = runTool("train --help").output;
  for (const std::string& name : namesIn(kModels / "recipes", ".yaml")) {
    EXPECT_NE(named.find(" " + name), std::string::npos) << name;
    const test::Outcome help = runTool("train " + recipeOf(name) + " --help");
    EXPECT_EQ(help.status, 0) << help.output;
  }
}

TEST_F(Recipe, TrainsANetwork) {
  const std::string file = recipe("method: actor-critic\ncells: 4\nkinds: [open, mazes]\niterations: 1\nworlds: 3\n");
  const test::Outcome outcome =
      runTool("train " + file + " starts=1 max-steps=5 validation=1 output=" + in("own.onnx"));
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_TRUE(fs::exists(in("own.onnx")));
}

TEST_F(Recipe, TheHelpOfTrainingFitsOnAScreen) {
  const test::Outcome help = runTool("train --help");
  EXPECT_EQ(help.status, 0);
  EXPECT_LE(std::count(help.output.begin(), help.output.end(), '\n'), 30);
}

}  // namespace
}  // namespace lstm_planner::test_recipe
