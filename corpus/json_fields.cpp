#include "corpus/json_fields.h"

#include <cmath>
#include <set>

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
  if (!std::isfinite(value)) return problem("a finite number expected");
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

// Looks at a text while it is parsed, for a fault that the value does not show afterwards: a key
// that occurs twice (the parser uses the last value).
template <class Value>
class Watch {
 public:
  using Event = typename Value::parse_event_t;

  // Looks at an event. Returns whether to go on.
  bool see(int depth, Event event, const Value& value) {
    // Parsing needs no stack, but printing and copying descend level by level.
    if (depth > deepest) problem_ = "the JSON is nested too deeply";
    if (!problem_.empty()) return false;
    if (event == Event::object_start || event == Event::array_start) {
      levels_.push_back({event == Event::array_start});
    } else if (event == Event::key) {
      auto& level = levels_.back();
      level.key = value.template get_ref<const std::string&>();
      if (!level.keys.insert(level.key).second) problem_ = place() + " occurs twice";
    } else {
      if (event != Event::value) levels_.pop_back();
      if (!levels_.empty()) ++levels_.back().items;
    }
    return problem_.empty();
  }
  const std::string& problem() const { return problem_; }

 private:
  struct Level {
    bool is_array;
    std::set<std::string> keys = {};
    std::string key = {};   // the last one
    std::size_t items = 0;  // that are read
  };

  // Returns the place in the text: "expected.steps[0].pairs".
  std::string place() const {
    std::string text;
    for (const auto& level : levels_) {
      text +=
          level.is_array ? fmt::format("[{}]", level.items) : (text.empty() ? "" : ".") + level.key;
    }
    return text;
  }

  std::vector<Level> levels_;
  std::string problem_;
};

template <class Value>
Expected<Value> parse_as(std::string_view text, const std::filesystem::path& file) try {
  Watch<Value> watch;
  Value json =
      Value::parse(text, [&](int depth, typename Value::parse_event_t event, const Value& value) {
        return watch.see(depth, event, value);
      });
  if (!watch.problem().empty()) return problem_in(file, watch.problem());
  return json;
} catch (const typename Value::parse_error& error) {
  return problem_in(file, fmt::format("byte {}: not JSON", error.byte));
} catch (const typename Value::out_of_range&) {
  return problem_in(file, "a number is too large for a double");
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
