#include "corpus/json_fields.h"

#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <cmath>

namespace assay::corpus {

bool JsonField::has(std::string_view key) const {
  return value_->is_object() && value_->contains(key);
}

Expected<JsonField> JsonField::at(std::string_view key) const {
  if (!value_->is_object()) return problem("an object expected");
  const auto found = value_->find(key);
  const std::string place = place_.empty() ? std::string(key) : fmt::format("{}.{}", place_, key);
  if (found == value_->end()) {
    return problem_in(*file_, fmt::format("{} is missing", place));
  }
  return JsonField(*found, *file_, place);
}

Expected<std::size_t> JsonField::size() const {
  if (!value_->is_array()) return problem("an array expected");
  return value_->size();
}

JsonField JsonField::item(std::size_t i) const {
  return JsonField((*value_)[i], *file_, fmt::format("{}[{}]", place_, i));
}

Expected<std::string> JsonField::text() const {
  if (!value_->is_string()) return problem("a text expected");
  return value_->get<std::string>();
}

Expected<double> JsonField::number() const {
  if (!value_->is_number()) return problem("a number expected");
  const auto value = value_->get<double>();
  if (!std::isfinite(value)) return problem("not finite");
  return value;
}

Expected<std::int32_t> JsonField::integer(std::int64_t least, std::int64_t end) const {
  if (!value_->is_number_integer()) return problem("a whole number expected");
  // An unsigned number beyond the signed ones would wrap round.
  const bool huge = value_->is_number_unsigned() && value_->get<std::uint64_t>() > INT64_MAX;
  const auto value = huge ? INT64_MAX : value_->get<std::int64_t>();
  if (value < least || value >= end) {
    return problem(fmt::format("{} is not in [{}, {})", value, least, end));
  }
  return static_cast<std::int32_t>(value);
}

Problem JsonField::problem(std::string_view detail) const {
  return problem_in(*file_, fmt::format("{}: {}", place_.empty() ? "top level" : place_, detail));
}

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
