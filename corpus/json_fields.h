// JSON text to values, with the parser's exceptions turned into problems, and values to text; and
// typed access to the fields of a value, in which each error names the file and the field.
#pragma once

#include <boost/outcome/try.hpp>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/problem.h"

namespace assay::corpus {

// Keeps the order of an object's keys.
using Json = nlohmann::ordered_json;

// Refuses what is not JSON (the message names the byte), a number beyond the doubles, and an object
// in which a key stands twice, because the parser would take the last one without a word. A value
// nested more than 64 levels deep is refused too, because what prints or copies it descends level
// by level, and a stack ends somewhere. `file` stands for the text in messages.
Expected<Json> parse_json(std::string_view text, const std::filesystem::path& file);
// The same, for values that sort their keys by name.
Expected<nlohmann::json> parse_sorted_json(std::string_view text,
                                           const std::filesystem::path& file);

// The text of a value, in one line or with each level indented by so many spaces. Never fails:
// bytes that are no UTF-8, as file names and the words of a plug-in may hold, become U+FFFD.
std::string json_text(const Json& value, int indent = -1);
std::string json_text(const nlohmann::json& value, int indent = -1);

// A JSON value and where it stands (`expected.steps[0].pairs`). It refers to the value and to the
// file path, which both must outlive it.
class JsonField {
 public:
  JsonField(const Json& value, const std::filesystem::path& file, std::string place = "")
      : value_(&value), file_(&file), place_(std::move(place)) {}

  bool has(std::string_view key) const;

  // The field `key`. Fails when it is missing, and when this is no object.
  Expected<JsonField> at(std::string_view key) const;
  // The number of items. Fails when this is no array.
  Expected<std::size_t> size() const;
  // REQUIRES: an array with more than `i` items.
  JsonField item(std::size_t i) const;

  Expected<std::string> text() const;
  Expected<double> number() const;                                             // finite
  Expected<std::int32_t> integer(std::int64_t least, std::int64_t end) const;  // in [least, end)

  // A problem whose message names this field.
  Problem problem(std::string_view detail) const;

  const Json& json() const { return *value_; }

 private:
  const Json* value_;
  const std::filesystem::path* file_;
  std::string place_;
};

}  // namespace assay::corpus
