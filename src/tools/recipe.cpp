#include "tools/recipe.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "tools/shared_file.hpp"

namespace lstm_planner {
namespace {

using Values = std::vector<std::string>;
using Recipe = std::vector<std::pair<std::string, Values>>;

bool isOption(const std::string& argument) { return argument.compare(0, 2, "--") == 0; }

bool isSetting(const std::string& argument) {
  return !isOption(argument) && argument.find('=') != std::string::npos && argument.front() != '=';
}

Values valuesOf(const YAML::Node& node, const std::string& place) {
  if (node.IsScalar()) return {node.Scalar()};
  const auto isScalar = [](const YAML::Node& value) { return value.IsScalar(); };
  if (!node.IsSequence() || !std::all_of(node.begin(), node.end(), isScalar))
    throw std::invalid_argument(place + ": expected a number, a text, or a list of these");
  Values values;
  for (const auto& value : node) values.push_back(value.Scalar());
  return values;
}

Recipe readRecipe(const std::string& name) {
  const auto [path, root] = readShippedYaml("recipe", "models/recipes", name, "KEY: VALUE in each line");
  Recipe recipe;
  for (const auto& entry : root) {
    const std::string key = keyOf(path, entry.first);
    const auto has_key = [&](const auto& before) { return before.first == key; };
    if (std::any_of(recipe.begin(), recipe.end(), has_key)) {
      throw std::invalid_argument(path + ": " + key + " is given twice");
    }
    recipe.emplace_back(key, valuesOf(entry.second, path + ": " + key));
  }
  return recipe;
}

std::pair<std::string, Values> readSetting(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  const std::string key = argument.substr(0, equals);
  const std::string value = argument.substr(equals + 1);
  if (value.empty() || value.front() != '[') return {key, {value}};
  try {
    return {key, valuesOf(YAML::Load(value), key)};
  } catch (const YAML::Exception&) {
    throw std::invalid_argument(key + " is '" + value + "', expected a list, as in [1, 2]");
  }
}

void remove(const std::string& key, Recipe* recipe) {
  recipe->erase(std::remove_if(recipe->begin(), recipe->end(), [&](const auto& entry) { return entry.first == key; }),
                recipe->end());
}

/// An empty list leaves the option out.
void append(const std::string& key, const Values& values, std::vector<std::string>* options) {
  if (values.empty()) return;
  if (values.size() == 1) {
    if (values.front() != "false")
      options->push_back("--" + key + (values.front() == "true" ? "" : "=" + values.front()));
    return;
  }
  options->push_back("--" + key);
  options->insert(options->end(), values.begin(), values.end());
}

}  // namespace

std::vector<std::string> expandRecipe(const std::vector<std::string>& arguments) {
  Recipe recipe;
  std::vector<std::string> options;
  auto argument = arguments.begin();
  const bool has_recipe =
      argument != arguments.end() && !isOption(*argument) && *argument != "-h" && !isSetting(*argument);
  if (has_recipe) recipe = readRecipe(*argument++);
  for (; argument != arguments.end() && isSetting(*argument); ++argument) {
    const auto [key, values] = readSetting(*argument);
    remove(key, &recipe);
    recipe.emplace_back(key, values);
  }
  for (auto option = argument; option != arguments.end(); ++option) {
    if (isOption(*option)) remove(option->substr(2, option->find('=') - 2), &recipe);
  }
  for (const auto& [key, values] : recipe) append(key, values, &options);
  options.insert(options.end(), argument, arguments.end());
  return options;
}

}  // namespace lstm_planner
