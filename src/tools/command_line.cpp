#include "tools/command_line.hpp"

#include <CLI/CLI11.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <locale>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "lstm_planner/common/nearest_name.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/common/words.hpp"

namespace lstm_planner {
namespace {

constexpr std::size_t kMeaningColumn = 28;

class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::string usage) : usage_(std::move(usage)) {}

  std::string make_usage(const CLI::App*, std::string) const override { return usage_ + "\n"; }
  std::string make_description(const CLI::App*) const override { return ""; }
  std::string make_positionals(const CLI::App*) const override { return ""; }
  std::string make_option(const CLI::Option* option, bool) const override {
    std::string line = "  " + option->get_name(false, true) + option->get_option_text();
    line += line.size() < kMeaningColumn ? std::string(kMeaningColumn - line.size(), ' ')
                                         : "\n" + std::string(kMeaningColumn, ' ');
    return line + wrapped(option->get_description(), kTextWidth, kMeaningColumn, kMeaningColumn) + "\n";
  }

 private:
  std::string usage_;
};

/// The end of a sentence: a hint, or `otherwise`. The two dashes, which all names have, make none of them nearer.
std::string hintAtOption(const std::string& name, const std::vector<std::string>& names, const std::string& otherwise) {
  const auto bare = [](const std::string& option) { return option.substr(std::min<std::size_t>(2, option.size())); };
  std::vector<std::string> bare_names;
  for (const std::string& option : names) bare_names.push_back(bare(option));
  const std::string nearest = nearestName(bare(name), bare_names);
  return nearest.empty() ? otherwise : "; the nearest is --" + nearest;
}

bool looksLikeOption(const std::string& text) { return text.size() > 2 && text.compare(0, 2, "--") == 0; }

/// What is left over where an option has no such name.
void refuseRest(const CLI::App& app) {
  const std::vector<std::string> rest = app.remaining();
  if (rest.empty()) return;
  if (rest.front().empty() || rest.front()[0] != '-') {
    throw std::invalid_argument("'" + rest.front() + "' stands alone, expected it behind the option it belongs to");
  }
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) names.push_back(option->get_name(false, false));
  throw UnknownOption(rest.front().substr(0, rest.front().find('=')), names);
}

/// The next option is not a value.
void refuseMissingValues(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& value : option->results()) {
      if (!looksLikeOption(value)) continue;
      throw std::invalid_argument(option->get_name(false, false) + " needs a value, got " + value);
    }
  }
}

/// Two names of one file, which need not be there yet. A device may be written twice.
bool isSameFile(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  if (fs::exists(a, unknown)) return fs::is_regular_file(a, unknown) && fs::equivalent(a, b, unknown);
  return fs::weakly_canonical(fs::absolute(a, unknown), unknown) ==
         fs::weakly_canonical(fs::absolute(b, unknown), unknown);
}

/// False when the help was asked for.
bool parseWith(CLI::App* app, const std::vector<std::string>& arguments) {
  try {
    app->parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    refuseRest(*app);
    return false;
  } catch (const CLI::ParseError& error) {
    refuseRest(*app);
    const std::string sentence = error.what();  // "--NAME: 1 required ..."
    throw std::invalid_argument(looksLikeOption(sentence) ? sentence.substr(0, sentence.find(':')) + " needs a value"
                                                          : sentence);
  }
  refuseMissingValues(*app);
  refuseRest(*app);
  return true;
}

CLI::Option* declare(const Option& option, CLI::App* app) {
  std::string meaning = option.meaning;
  if (!option.default_text.empty()) meaning += " (default: " + option.default_text + ")";
  if (option.is_required) meaning += " (required)";
  CLI::Option* declared = nullptr;
  if (option.value_name.empty()) {
    declared = app->add_flag(option.name)->description(meaning);
  } else {
    const CLI::callback_t later = [](const CLI::results_t&) { return true; };
    const std::string alone = option.stands_alone ? option.name.substr(2) + "," : "";
    declared = app->add_option(alone + option.name, later, meaning);
    declared->expected(1, -1)->allow_extra_args(option.takes_several)->option_text(" " + option.value_name);
  }
  declared->group(option.section);
  return declared;
}

void take(const CLI::Option& parsed, Option* option) {
  option->is_given = parsed.count() > 0;
  if (option->is_required && !option->is_given) throw std::invalid_argument(option->name + " is required");
  for (const std::string& value : parsed.results()) {
    if (option->value_name.empty() && value != "true") throw std::invalid_argument(option->name + " takes no value");
  }
  // As of a variable of the shell that is not set.
  const bool is_file = option->value_name.compare(0, 4, "FILE") == 0;
  if ((is_file || option->value_name == "FOLDER") && contains(parsed.results(), "")) {
    throw std::invalid_argument(option->name + " is '', expected the name of a " + (is_file ? "file" : "folder"));
  }
  if (option->is_given) option->take(parsed.results());
}

template <typename Number>
Number numberOf(const std::string& name, const std::string& text, Range range) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  Number number{};
  stream >> std::noskipws >> number;
  const bool is_number = !stream.fail() && stream.peek() == std::istringstream::traits_type::eof();
  // A stream takes -1 for the greatest of all numbers without a sign.
  const bool is_wrapped = std::is_unsigned_v<Number> && text.find('-') != std::string::npos;
  if (is_number && !is_wrapped && range.contains(static_cast<double>(number))) return number;
  const bool quoted = text.find_first_not_of("+-.0123456789e") != std::string::npos || text.empty();
  throw std::invalid_argument("--" + name + " is " + (quoted ? "'" + text + "'" : text) + ", expected a " +
                              (std::is_integral_v<Number> ? "whole " : "") + "number in " + toText(range));
}

}  // namespace

std::string toText(double number) {
  constexpr double kReadable = 1e12;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  if (std::abs(number) <= kReadable && number == std::round(number)) {
    text << static_cast<long long>(number);
  } else {
    text << number;
  }
  return text.str();
}

std::string toText(Range range) { return "[" + toText(range.least) + ", " + toText(range.most) + "]"; }

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent, std::size_t used) {
  std::istringstream words(text);
  std::string result;
  std::string word;
  bool is_first = true;  // of its line
  while (words >> word) {
    if (!is_first && used + 1 + word.size() > width) {
      result += "\n" + std::string(indent, ' ');
      used = indent;
      is_first = true;
    }
    result += (is_first ? "" : " ") + word;
    used += (is_first ? 0 : 1) + word.size();
    is_first = false;
  }
  return result;
}

UnknownOption::UnknownOption(std::string name, std::vector<std::string> names, const std::string& otherwise)
    : std::invalid_argument("there is no option " + name + hintAtOption(name, names, otherwise)),
      name_(std::move(name)),
      names_(std::move(names)) {}

Option& Option::required() {
  is_required = true;
  return *this;
}

Option& Option::standsAlone() {
  stands_alone = true;
  return *this;
}

Option& Option::oneAtATime() {
  takes_several = false;
  return *this;
}

Option& Option::changesNoResult() {
  changes_result = false;
  return *this;
}

Option& Option::mayBeReplaced() {
  may_be_replaced = true;
  return *this;
}

CommandLine::CommandLine(std::string command, std::string summary)
    : command_(std::move(command)), summary_(std::move(summary)) {}

void CommandLine::section(const std::string& title) { section_ = title; }

Option& CommandLine::add(const std::string& name, const std::string& value_name, const std::string& meaning,
                         std::function<void(const std::vector<std::string>&)> take) {
  Option option;
  option.name = "--" + name;
  option.value_name = value_name;
  option.meaning = meaning;
  option.section = section_;
  option.take = std::move(take);
  options_.push_back(std::move(option));
  return options_.back();
}

Option& CommandLine::addSingle(const std::string& name, const std::string& value_name, const std::string& meaning,
                               const std::function<void(const std::string&)>& take) {
  return add(name, value_name, meaning, [=](const std::vector<std::string>& values) {
    if (values.size() != 1) {
      throw std::invalid_argument("--" + name + " is given " + std::to_string(values.size()) + " times, expected once");
    }
    take(values.front());
  });
}

template <typename Number>
Option& CommandLine::add(const std::string& name, Number* value, Range range, const std::string& meaning) {
  Option& option = addSingle(name, "N", meaning + "; in " + toText(range),
                             [=](const std::string& text) { *value = numberOf<Number>(name, text, range); });
  if (range.contains(static_cast<double>(*value))) option.default_text = toText(static_cast<double>(*value));
  option.value = [=] { return *value; };
  return option;
}

template <typename Number>
Option& CommandLine::add(const std::string& name, std::optional<Number>* value, Range range,
                         const std::string& meaning) {
  Option& option = addSingle(name, "N", meaning + "; in " + toText(range),
                             [=](const std::string& text) { *value = numberOf<Number>(name, text, range); });
  option.value = [=] { return *value ? nlohmann::json(**value) : nlohmann::json(); };
  return option;
}

template Option& CommandLine::add(const std::string&, int*, Range, const std::string&);
template Option& CommandLine::add(const std::string&, long*, Range, const std::string&);
template Option& CommandLine::add(const std::string&, std::size_t*, Range, const std::string&);
template Option& CommandLine::add(const std::string&, double*, Range, const std::string&);
template Option& CommandLine::add(const std::string&, std::optional<int>*, Range, const std::string&);
template Option& CommandLine::add(const std::string&, std::optional<double>*, Range, const std::string&);

Option& CommandLine::add(const std::string& name, std::vector<int>* values, Range range, const std::string& meaning) {
  const auto take = [=](const std::vector<std::string>& texts) {
    values->clear();
    for (const std::string& text : texts) values->push_back(numberOf<int>(name, text, range));
  };
  Option& option = add(name, "N...", meaning + "; in " + toText(range), take);
  option.takes_several = true;
  for (const int value : *values)
    option.default_text += (option.default_text.empty() ? "" : " ") + std::to_string(value);
  option.value = [=] { return *values; };
  return option;
}

Option& CommandLine::add(const std::string& name, std::string* value, const std::string& meaning) {
  Option& option = addSingle(name, "TEXT", meaning, [=](const std::string& text) { *value = text; });
  option.default_text = *value;
  option.value = [=] { return *value; };
  return option;
}

Option& CommandLine::add(const std::string& name, std::vector<std::string>* values, const std::string& meaning) {
  Option& option = add(name, "TEXT...", meaning, [=](const std::vector<std::string>& texts) { *values = texts; });
  option.takes_several = true;
  option.default_text = joined(*values, " ");
  option.value = [=] { return *values; };
  return option;
}

Option& CommandLine::add(const std::string& name, bool* value, const std::string& meaning) {
  Option& option = addSingle(name, "N", meaning, [=](const std::string& text) {
    *value = numberOf<int>(name, text, {0, 1}) == 1;
  });
  option.default_text = *value ? "1" : "0";
  option.value = [=] { return *value; };
  return option;
}

Option& CommandLine::addSeed(std::uint64_t* seed, const std::string& meaning) {
  Option& option = addSingle("seed", "N", meaning, [=](const std::string& text) {
    *seed = numberOf<std::uint64_t>("seed", text, {0.0, 18446744073709551615.0});
  });
  option.default_text = std::to_string(*seed);
  option.value = [=] { return *seed; };
  return option;
}

Option& CommandLine::addChoice(const std::string& name, std::string* value, const std::vector<std::string>& names,
                               const std::string& meaning) {
  Choices<std::string> choices;
  for (const std::string& itself : names) choices.emplace_back(itself, itself);
  return addChoice(name, value, choices, meaning);
}

std::size_t CommandLine::choose(const std::string& name, const std::string& value,
                                const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), value);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw std::invalid_argument("--" + name + " is '" + value + "', expected " + joinedByOr(names));
}

Option& CommandLine::addText(const std::string& name, const std::string& default_text,
                             const std::function<void(const std::string&)>& take, const std::string& meaning) {
  const auto given = std::make_shared<std::string>(default_text);
  Option& option = addSingle(name, "TEXT", meaning, [=](const std::string& text) {
    *given = text;
    take(text);
  });
  option.default_text = default_text;
  option.value = [=] { return *given; };
  return option;
}

Option& CommandLine::addFile(const std::string& name, std::string* path, const std::string& meaning) {
  Option& option = add(name, path, meaning);
  option.value_name = "FILE";
  return option;
}

Option& CommandLine::addFolder(const std::string& name, std::string* path, const std::string& meaning) {
  Option& option = add(name, path, meaning);
  option.value_name = "FOLDER";
  return option;
}

Option& CommandLine::addFiles(const std::string& name, std::vector<std::string>* paths, const std::string& meaning) {
  Option& option = add(name, paths, meaning);
  option.value_name = "FILE...";
  return option;
}

Option& CommandLine::addOutput(const std::string& name, std::string* path, const std::string& meaning) {
  outputs_.push_back({name, path, false});
  return addFile(name, path, meaning).changesNoResult();
}

Option& CommandLine::addNewFile(const std::string& name, std::string* path, const std::string& meaning) {
  outputs_.push_back({name, path, true});
  return addFile(name, path, meaning).changesNoResult();
}

void CommandLine::whenParsed(std::function<void()> finish) { finishes_.push_back(std::move(finish)); }

std::string CommandLine::usage() const {
  std::string text = "usage: lstm_planner " + command_;
  for (const Option& option : options_) {
    if (!option.is_required) continue;
    text += " " + (option.stands_alone ? "" : option.name + " ") + option.value_name;
  }
  constexpr std::size_t kIndent = 7;
  return wrapped(text + " [OPTION]...", kTextWidth, kIndent, 0) + "\n\n" + wrapped(summary_, kTextWidth, 0, 0);
}

bool CommandLine::parse(const std::vector<std::string>& arguments) {
  CLI::App app;
  app.formatter(std::make_shared<HelpFormatter>(usage()));
  app.set_help_flag();
  app.allow_extras();  // which parseWith() refuses, with the name that was meant
  std::vector<CLI::Option*> parsed;
  for (const Option& option : options_) parsed.push_back(declare(option, &app));
  app.set_help_flag("--help,-h", "show this")->group(section_);
  if (!parseWith(&app, arguments)) {
    std::cout << CLI::detail::find_and_replace(app.help(), "\n\n\n", "\n\n");
    return false;
  }
  for (std::size_t i = 0; i < parsed.size(); ++i) take(*parsed[i], &options_[i]);
  for (const auto& finish : finishes_) finish();
  checkOutputs();
  return true;
}

void CommandLine::checkOutputs() const {
  for (const Output& output : outputs_) {
    if (output.path->empty()) continue;
    if (output.is_new && std::filesystem::exists(*output.path)) {
      throw std::invalid_argument("--" + output.name + " is '" + *output.path + "': there is such a file already");
    }
    checkNotUsed(output);
    checkWritable(*output.path);
  }
}

/// What is written is not to destroy what is read, such as a recording, nor what is written beside it.
void CommandLine::checkNotUsed(const Output& output) const {
  for (const Option& option : options_) {
    const std::string name = "--" + output.name;
    if (option.name == name || option.may_be_replaced || option.value_name.compare(0, 4, "FILE") != 0) continue;
    const nlohmann::json value = option.value();
    const std::vector<std::string> paths =
        value.is_array() ? value.get<std::vector<std::string>>() : std::vector<std::string>{value.get<std::string>()};
    for (const std::string& path : paths) {
      if (path.empty() || !isSameFile(*output.path, path)) continue;
      throw std::invalid_argument(name + " is '" + *output.path + "', which is also the file of " + option.name +
                                  ", expected another file");
    }
  }
}

bool CommandLine::given(const std::string& name) const {
  return std::any_of(options_.begin(), options_.end(),
                     [&](const Option& option) { return option.name == "--" + name && option.is_given; });
}

void CommandLine::refuseIdle(const std::vector<std::string>& names, const std::string& why) const {
  for (const std::string& name : names) {
    if (given(name)) throw std::invalid_argument("--" + name + " has no effect " + why);
  }
}

nlohmann::json CommandLine::settings() const {
  nlohmann::json settings = nlohmann::json::object();
  for (const Option& option : options_) {
    if (option.changes_result) settings[option.name.substr(2)] = option.value();
  }
  return settings;
}

std::string CommandLine::peek(const std::string& name, const std::vector<std::string>& arguments) {
  const std::string option = "--" + name;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i].compare(0, option.size() + 1, option + "=") == 0) return arguments[i].substr(option.size() + 1);
    if (arguments[i] == option && i + 1 < arguments.size()) return arguments[i + 1];
  }
  return "";
}

}  // namespace lstm_planner
