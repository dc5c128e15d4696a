#include "corpus/json_text.h"

#include <fmt/format.h>

namespace assay::corpus {
namespace {

constexpr int deepest = 64;

template <class Value>
Expected<Value> parse_as(std::string_view text, const std::filesystem::path& file) try {
  // Parsing needs no stack, but printing and copying descend level by level.
  bool too_deep = false;
  const auto keep = [&](int depth, typename Value::parse_event_t, Value&) {
    too_deep = too_deep || depth > deepest;
    return !too_deep;
  };
  Value json = Value::parse(text, keep);
  if (too_deep) return problem_in(file, "JSON nested too deeply");
  return json;
} catch (const typename Value::parse_error& error) {
  return problem_in(file, fmt::format("byte {}: not JSON", error.byte));
} catch (const typename Value::out_of_range&) {
  return problem_in(file, "a number beyond the doubles");
} catch (const typename Value::exception&) {
  return problem_in(file, "not JSON");
}

}  // namespace

Expected<Json> parse_json(std::string_view text, const std::filesystem::path& file) {
  return parse_as<Json>(text, file);
}

Expected<nlohmann::json> parse_sorted_json(std::string_view text,
                                           const std::filesystem::path& file) {
  return parse_as<nlohmann::json>(text, file);
}

std::string json_text(const Json& value, int indent) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string json_text(const nlohmann::json& value, int indent) {
  return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace assay::corpus
