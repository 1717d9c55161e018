#include "training/checkpoint_json.hpp"

#include <stdexcept>

namespace lstm_planner {

namespace {

using Json = nlohmann::json;

/// Reads JSON without keeping anything of it, and stops where it becomes too deep.
class DepthCheck {
 public:
  bool start_object(std::size_t) { return enter(); }
  bool start_array(std::size_t) { return enter(); }
  bool end_object() { return leave(); }
  bool end_array() { return leave(); }
  bool key(std::string&) { return true; }
  bool null() { return true; }
  bool boolean(bool) { return true; }
  bool number_integer(Json::number_integer_t) { return true; }
  bool number_unsigned(Json::number_unsigned_t) { return true; }
  bool number_float(Json::number_float_t, const std::string&) { return true; }
  bool string(std::string&) { return true; }
  /// A type that older versions of the library do not have.
  template <typename Binary>
  bool binary(Binary&) {
    return true;
  }
  template <typename Exception>
  bool parse_error(std::size_t, const std::string&, const Exception& error) {
    throw std::invalid_argument(error.what());
  }

 private:
  bool enter() {
    constexpr int kDeepest = 16;
    if (++depth_ > kDeepest) throw std::invalid_argument("it has more than 16 levels");
    return true;
  }
  bool leave() {
    --depth_;
    return true;
  }

  int depth_ = 0;
};

}  // namespace

Json checkpointJson(const std::string& text) {
  DepthCheck check;
  Json::sax_parse(text, &check);
  return Json::parse(text);
}

Json checkpointJson(const std::vector<std::uint8_t>& cbor, const std::string& format) {
  DepthCheck check;
  Json::sax_parse(cbor, &check, Json::input_format_t::cbor);
  Json json = Json::from_cbor(cbor);
  if (json.at("format") != format) throw std::invalid_argument("another format");
  return json;
}

std::int64_t wholeNumber(const Json& json, std::int64_t lowest, std::int64_t highest) {
  const bool too_large = json.is_number_unsigned() && json.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX);
  const std::int64_t value = json.is_number_integer() && !too_large ? json.get<std::int64_t>() : 0;
  if (!json.is_number_integer() || too_large || value < lowest || value > highest) {
    const std::string told = json.is_primitive() ? json.dump(-1, ' ', false, Json::error_handler_t::replace) : "a list";
    throw std::invalid_argument("there is " + told + ", expected a whole number from " + std::to_string(lowest) +
                                " to " + std::to_string(highest));
  }
  return value;
}

}  // namespace lstm_planner
