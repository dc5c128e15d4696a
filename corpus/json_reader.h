// Reads types that list their fields from the objects of a JSON file. The list is written once, in
// the file that knows the form, and serves who writes the object as well:
//
//   template <class Archive>
//   void fields(Archive& archive, StratumPlan& stratum) {
//     archive.must("family", stratum.family);                // it is refused if it is missing
//     archive.may("bound", stratum.wanted_bound, is_bound);  // it stays as it is if it is missing
//   }
//
// Behind the member stand rules, which say what a value has to be.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "corpus/json_fields.h"
#include "detector/mesh/enum_names.h"

namespace assay::corpus {

// Thrown by a reader; who reads the file catches it.
struct Refused {
  Problem problem;
};

// Returns the value. Throws Refused if there is none.
template <class T>
T want(Expected<T> expected) {
  if (!expected) throw Refused{expected.error()};
  return std::move(expected).value();
}

// Rules: a whole number from 0 on, and an array of so many items, whose own rules may follow.
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

// `Reader` derives from this, and has a function `read` for each further kind of value:
//
//   class PlanReader : public JsonReader<PlanReader> {
//    public:
//     using JsonReader::JsonReader, JsonReader::read;
//     static void read(const JsonField& field, bool& x);
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
