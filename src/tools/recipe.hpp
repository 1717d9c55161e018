#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

/// The arguments of a training as its options. `RECIPE`, the first argument if it is no option, is a yaml file, or the
/// NAME of a models/recipes/NAME.yaml: its keys are options, their values numbers, texts, lists, or true for an option
/// that takes no value. `KEY=VALUE` replaces a value of the recipe, or adds one; false takes an option away. Options
/// (--KEY VALUE...) stay as they are, and replace what the recipe says, too.
/// Throws std::invalid_argument with a sentence for a recipe that cannot be read.
std::vector<std::string> expandRecipe(const std::vector<std::string>& arguments);

}  // namespace lstm_planner
