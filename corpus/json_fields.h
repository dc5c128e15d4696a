// Typed access to the fields of a JSON value; each error names the file and the field.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "corpus/json_text.h"
#include "corpus/problem.h"

namespace assay::corpus {

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
