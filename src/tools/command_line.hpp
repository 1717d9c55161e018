#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/common/range.hpp"

namespace lstm_planner {

// What several commands' options may be. Sizes end where a computer of today does.
constexpr Range kAnyShare{0.0, 1.0};
constexpr Range kAnyLength{0.0, 1e6};  ///< m or cells
constexpr Range kAnyTime{0.001, 1e7};  ///< s
constexpr Range kAnyCount{1, 1e6};     ///< of what is done one after the other: drives, rounds
constexpr Range kAnySteps{1, 1e9};     ///< of drives or of walks on a grid
constexpr Range kAnyThreads{1, 1024};

// Of trainings.
constexpr Range kAnyLayer{1, 4096};  ///< cells or units
constexpr Range kAnyWindow{1, 1e5};  ///< steps that errors go back
constexpr Range kAnyRate{1e-9, 100.0};

/// "[0, 1]"
std::string toText(Range range);

/// As people write it: 0.8, 1000000.
std::string toText(double number);

constexpr std::size_t kTextWidth = 110;  ///< letters of a line, of what the tool explains

/// The text in lines of at most `width` letters, broken at blanks; all lines but the first start with `indent` blanks,
/// of which the first has `used` letters before it already.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent, std::size_t used);

/// Refuses an option that a command does not have. `names` are those that it has, with --; where none of them is near,
/// the sentence ends with `otherwise`.
class UnknownOption : public std::invalid_argument {
 public:
  UnknownOption(std::string name, std::vector<std::string> names, const std::string& otherwise = "");

  const std::string& name() const { return name_; }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::string name_;
  std::vector<std::string> names_;
};

/// An option as a command declares it; made by CommandLine.
struct Option {
  Option& required();
  Option& standsAlone();  ///< its values may stand without its name
  Option& oneAtATime();   ///< of a list: each time that it is named it takes one value
  Option& changesNoResult();
  Option& mayBeReplaced();  ///< of a file that is read: an output may be the same one

  std::string name;        ///< with --
  std::string value_name;  ///< in the help; empty for a flag, which takes no value
  std::string meaning;
  std::string default_text;  ///< empty: none
  std::string section;
  bool takes_several = false;  ///< all values up to the next option
  bool is_required = false;
  bool stands_alone = false;
  bool is_given = false;
  bool changes_result = true;  ///< of a training
  bool may_be_replaced = false;
  /// Checks the values and puts them where they belong.
  std::function<void(const std::vector<std::string>& values)> take;
  std::function<nlohmann::json()> value;  ///< that it has now
};

/// Values by the names that stand for them.
template <typename T>
using Choices = std::vector<std::pair<std::string, T>>;

/// Empty where the value has no name.
template <typename T>
std::string nameOf(const T& value, const Choices<T>& choices) {
  for (const auto& [name, choice] : choices) {
    if (choice == value) return name;
  }
  return "";
}

/// The options of a command: each is bound to the variable that takes its value. What the variable holds when the
/// option is added is the default. `name` is without the two dashes; every number has a range, which the help shows.
class CommandLine {
 public:
  /// `command` is what stands behind "lstm_planner", such as "dataset info".
  CommandLine(std::string command, std::string summary);

  /// The options added next are listed under this title.
  void section(const std::string& title);

  /// `Number`: int, long, std::size_t or double.
  template <typename Number>
  Option& add(const std::string& name, Number* value, Range range, const std::string& meaning);
  template <typename Number>
  Option& add(const std::string& name, std::optional<Number>* value, Range range, const std::string& meaning);
  Option& add(const std::string& name, std::vector<int>* values, Range range, const std::string& meaning);
  /// Each number that is visited, see parameter_visitors.hpp, under its own name, with dashes: detour-share for
  /// detour/share. With onlyNamed() some of them.
  auto everyParameter() {
    return [this](std::string name, auto& value, [[maybe_unused]] Range range, const char* unit,
                  [[maybe_unused]] const char* meaning) {
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == '_' || c == '/'; }, '-');
      using Value = std::decay_t<decltype(value)>;
      Option* option = nullptr;
      if constexpr (std::is_same_v<Value, bool>) {
        option = &add(name, &value, meaning);
      } else if constexpr (kIsNumber<Value> || std::is_same_v<Value, std::vector<int>>) {
        option = &add(name, &value, range, meaning);
      }
      if (option != nullptr && *unit != '\0') option->meaning += std::string(" ") + unit;
    };
  }
  /// Likewise those that are named, under other names: pairs of the parameter's and the option's.
  auto renamedParameters(const std::vector<std::pair<std::string, std::string>>& names) {
    return [this, names](const std::string& name, auto& value, Range range, const char* unit, const char* meaning) {
      for (const auto& [parameter, option] : names) {
        if (parameter == name) everyParameter()(option, value, range, unit, meaning);
      }
    };
  }
  Option& add(const std::string& name, std::string* value, const std::string& meaning);
  Option& add(const std::string& name, std::vector<std::string>* values, const std::string& meaning);
  /// 0 or 1.
  Option& add(const std::string& name, bool* value, const std::string& meaning);
  /// Any whole number that 64 bits hold.
  Option& addSeed(std::uint64_t* seed, const std::string& meaning);
  /// One of the names.
  Option& addChoice(const std::string& name, std::string* value, const std::vector<std::string>& names,
                    const std::string& meaning);
  /// What one of the names stands for.
  template <typename T>
  Option& addChoice(const std::string& name, T* value, const Choices<T>& choices, const std::string& meaning);
  /// Any number of them, as often as they are named.
  template <typename T>
  Option& addChoices(const std::string& name, std::vector<T>* values, const Choices<T>& choices,
                     const std::string& meaning);
  /// Whatever `take` makes of the text; it throws std::invalid_argument with a sentence.
  Option& addText(const std::string& name, const std::string& default_text,
                  const std::function<void(const std::string&)>& take, const std::string& meaning);
  Option& addFile(const std::string& name, std::string* path, const std::string& meaning);
  Option& addFiles(const std::string& name, std::vector<std::string>* paths, const std::string& meaning);
  Option& addFolder(const std::string& name, std::string* path, const std::string& meaning);
  /// A file that will be written: it must be possible, which is checked before anything else is done.
  Option& addOutput(const std::string& name, std::string* path, const std::string& meaning);
  /// Likewise, and there must be none of that name.
  Option& addNewFile(const std::string& name, std::string* path, const std::string& meaning);
  /// Sets `value` to `meant` when it is given.
  template <typename T>
  Option& addFlag(const std::string& name, T* value, T meant, const std::string& meaning) {
    Option& option = add(name, "", meaning, [=](const std::vector<std::string>&) { *value = meant; });
    option.value = [=] { return *value == meant; };
    return option;
  }

  /// What is left to be done with the values, or to be checked, when all options have theirs; in the order of the
  /// calls. Whether files can be written is checked last.
  void whenParsed(std::function<void()> finish);

  /// Puts the arguments into the variables, in the order in which the options were added. False when it has printed the
  /// help, which was asked for. Throws std::invalid_argument with a sentence that names the option, its value and what
  /// was expected; an option that there is none of, with the nearest one.
  bool parse(const std::vector<std::string>& arguments);

  /// Whether the user named the option; after parse().
  bool given(const std::string& name) const;

  /// Refuses those of the options that the user named, as they have no effect `why`: "without --film"; after parse().
  void refuseIdle(const std::vector<std::string>& names, const std::string& why) const;

  /// What a training depends on, for its checkpoint: the values of all options, but for files that are written and
  /// options that change no result; after parse().
  nlohmann::json settings() const;

  /// The value of an option that decides which others there are, or their defaults; empty where it is not given.
  static std::string peek(const std::string& name, const std::vector<std::string>& arguments);

 private:
  Option& add(const std::string& name, const std::string& value_name, const std::string& meaning,
              std::function<void(const std::vector<std::string>&)> take);
  /// It may be given once, with one value.
  Option& addSingle(const std::string& name, const std::string& value_name, const std::string& meaning,
                    const std::function<void(const std::string&)>& take);
  std::string usage() const;
  void checkOutputs() const;

  std::string command_;
  std::string summary_;
  std::string section_ = "options";
  std::deque<Option> options_;  // which stay where they are
  std::vector<std::function<void()>> finishes_;
  /// Throws as parse() where the value is none of the names; the number of the name otherwise.
  static std::size_t choose(const std::string& name, const std::string& value, const std::vector<std::string>& names);

  struct Output {
    std::string name;
    const std::string* path;
    bool is_new;
  };
  void checkNotUsed(const Output& output) const;
  std::vector<Output> outputs_;
};

template <typename T>
std::vector<std::string> namesOf(const Choices<T>& choices) {
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  return names;
}

template <typename T>
Option& CommandLine::addChoice(const std::string& name, T* value, const Choices<T>& choices,
                               const std::string& meaning) {
  Option& option = addSingle(name, "NAME", meaning, [=](const std::string& text) {
    *value = choices[choose(name, text, namesOf(choices))].second;
  });
  option.default_text = nameOf(*value, choices);
  option.value = [=] { return nameOf(*value, choices); };
  return option;
}

template <typename T>
Option& CommandLine::addChoices(const std::string& name, std::vector<T>* values, const Choices<T>& choices,
                                const std::string& meaning) {
  Option& option = add(name, "NAME...", meaning, [=](const std::vector<std::string>& texts) {
    values->clear();
    for (const std::string& text : texts) values->push_back(choices[choose(name, text, namesOf(choices))].second);
  });
  option.takes_several = true;
  option.value = [=] {
    nlohmann::json names = nlohmann::json::array();
    for (const T& value : *values) names.push_back(nameOf(value, choices));
    return names;
  };
  return option;
}

}  // namespace lstm_planner
