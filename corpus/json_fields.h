// Turns JSON text into values, and values into text. Returns the parser's exceptions as problems.
// Gives typed access to the fields of a value; each problem names the file and the field. Reads
// types that list their fields.
#pragma once

#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/problem.h"
#include "detector/mesh/enum_names.h"

namespace assay::corpus {

// Keeps the order of an object's keys.
using Json = nlohmann::ordered_json;

// Parses JSON text. Refuses text that is not JSON (the message names the byte), a number that is
// too large for a double, and an object that has a key twice, because the parser would silently use
// the last value. Also refuses a value nested more than 64 levels deep, because code that prints or
// copies a value calls itself for each level, and the stack is finite. Messages begin with `file`.
Expected<Json> parse_json(std::string_view text, const std::filesystem::path& file);
// Does the same, and returns a value that sorts its keys by name.
Expected<nlohmann::json> parse_sorted_json(std::string_view text,
                                           const std::filesystem::path& file);

// Returns the text of a value, in one line or with each level indented by `indent` spaces. Never
// fails: bytes that are not UTF-8, which file names and texts of a plug-in can hold, become U+FFFD.
std::string json_text(const Json& value, int indent = -1);
std::string json_text(const nlohmann::json& value, int indent = -1);

// A JSON value and its place in the file (`expected.steps[0].pairs`). It refers to the value and to
// the file's path, and both must outlive it.
class JsonField {
 public:
  JsonField(const Json& value, const std::filesystem::path& file, std::string place = "")
      : value_(&value), file_(&file), place_(std::move(place)) {}

  bool has(std::string_view key) const;

  // Returns the field `key`. Fails if the field is missing, and if this value is no object.
  Expected<JsonField> at(std::string_view key) const;
  // Returns the number of items. Fails if this value is no array.
  Expected<std::size_t> size() const;
  // Returns item i. REQUIRES an array with more than `i` items.
  JsonField item(std::size_t i) const;

  Expected<std::string> text() const;
  Expected<double> number() const;                                             // finite
  Expected<std::int32_t> integer(std::int64_t least, std::int64_t end) const;  // in [least, end)

  // Returns a problem whose message names this field.
  Problem problem(std::string_view detail) const;

  const Json& json() const { return *value_; }

 private:
  const Json* value_;
  const std::filesystem::path* file_;
  std::string place_;
};

// The rest of this file reads objects of a JSON file into types that list their fields. The list is
// written once, in the source file of the format, and the code that writes the object uses it too:
//
//   template <class Archive>
//   void fields(Archive& archive, Case& c) {
//     archive.must("id", c.id);                        // fails if the key is missing
//     archive.may("script", c.script, Below{frames});  // no change if the key is missing
//   }
//
// Rules, such as Below, may follow the member; they say which values are allowed.

// A reader throws this; the function that reads the file catches it.
struct Refused {
  Problem problem;
};

// Returns the value. Throws Refused if `expected` holds a problem.
template <class T>
T want(Expected<T> expected) {
  if (!expected) throw Refused{expected.error()};
  return std::move(expected).value();
}

// Two rules. `Below` demands a whole number >= 0 and < `end`. `Items` demands an array of `count`
// items; rules for the items may follow it.
struct Below {
  std::int64_t end;
};
struct Items {
  std::size_t count;
};

inline void expect_size(const JsonField& field, std::size_t count) {
  const auto size = want(field.size());
  if (size != count)
    throw Refused{field.problem(fmt::format("{} items expected, not {}", count, size))};
}

// `Reader` derives from JsonReader, and has a function `read` for each further type of value:
//
//   class CaseReader : public JsonReader<CaseReader> {
//    public:
//     using JsonReader::JsonReader, JsonReader::read;
//     static void read(const JsonField& field, Point& x);
//   };
template <class Reader>
class JsonReader {
 public:
  static constexpr bool reads = true;
  explicit JsonReader(JsonField object) : object_(std::move(object)) {}

  template <class T, class... Rules>
  void must(const char* key, T&& x, const Rules&... rules) {
    Reader::read(want(object_.at(key)), x, rules...);
  }
  template <class T, class... Rules>
  void may(const char* key, T&& x, const Rules&... rules) {
    if (object_.has(key)) must(key, x, rules...);
  }
  [[noreturn]] void refuse(const char* key, std::string_view detail) const {
    throw Refused{want(object_.at(key)).problem(detail)};
  }
  const JsonField& object() const { return object_; }

  static void read(const JsonField& field, std::string& x) { x = want(field.text()); }
  static void read(const JsonField& field, double& x) { x = want(field.number()); }
  template <std::integral Integer>
  static void read(const JsonField& field, Integer& x, const Below& below) {
    x = static_cast<Integer>(want(field.integer(0, below.end)));
  }
  template <Listed Enum>
  static void read(const JsonField& field, Enum& x) {
    const auto value = from_name<Enum>(want(field.text()));
    auto names = all_names<Enum>();
    if (!value)
      throw Refused{field.problem(names.replace(names.rfind(","), 1, " or") + " expected")};
    x = *value;
  }
  template <class T, class... Rules>
  static void read(const JsonField& field, std::optional<T>& x, const Rules&... rules) {
    Reader::read(field, x.emplace(), rules...);
  }
  template <class T, class... Rules>
  static void read(const JsonField& field, std::vector<T>& list, const Rules&... rules) {
    const auto size = want(field.size());
    list.clear();
    for (std::size_t i = 0; i < size; ++i)
      Reader::read(field.item(i), list.emplace_back(), rules...);
  }
  template <class T, class... Rules>
  static void read(const JsonField& field, std::vector<T>& list, const Items& items,
                   const Rules&... rules) {
    expect_size(field, items.count);
    read(field, list, rules...);
  }

 private:
  JsonField object_;
};

}  // namespace assay::corpus
