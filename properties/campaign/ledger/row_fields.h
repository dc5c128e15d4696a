// The fields of a row as JSON, for what makes rows and reads them.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "corpus/json_fields.h"
#include "properties/campaign/ledger/row.h"

// What may be absent is null in JSON. (nlohmann-json has this from version 3.12 on.)
template <class T>
struct nlohmann::adl_serializer<std::optional<T>> {
  template <class Json>
  static void to_json(Json& j, const std::optional<T>& value) {
    j = value ? Json(*value) : Json(nullptr);
  }
  template <class Json>
  static void from_json(const Json& j, std::optional<T>& value) {
    value = j.is_null() ? std::nullopt : std::optional(j.template get<T>());
  }
};

namespace assay::properties {

// What is thrown if a row is not what a run stores.
[[noreturn]] inline void throw_not_stored(const Row& row, const std::exception& wrong) {
  throw StoreProblem(fmt::format("{}: {}", row_name(row), wrong.what()));
}

// Both throw StoreProblem, which names the row, if its fields are not what a run stores.
inline nlohmann::json fields_of(const Row& row) {
  auto read = corpus::parse_sorted_json(row.fields, "fields");
  if (!read) throw StoreProblem(fmt::format("{}: {}", row_name(row), read.error().message));
  if (!read.value().is_object())
    throw StoreProblem(fmt::format("{}: its fields are no JSON object", row_name(row)));
  return std::move(read.value());
}

template <class T>
T read_fields_of(const Row& row) try {
  return fields_of(row).get<T>();
} catch (const nlohmann::json::exception& wrong) {
  throw_not_stored(row, wrong);
}

// The number that the text is. Throws StoreProblem if it is none.
std::uint64_t number_of_text(const std::string& text);

// Fields that are 0 or empty are left out when a row is written, and may be missing when it is
// read: most numbers of a trial are 0.
template <class T>
void put_unless_empty(nlohmann::json& json, const char* name, const T& value) {
  if (value != T{}) json[name] = value;
}
template <class T>
void get_if_there(const nlohmann::json& json, const char* name, T& value) {
  if (const auto found = json.find(name); found != json.end()) found->get_to(value);
}

}  // namespace assay::properties

#define ASSAY_PUT_FIELD(name) put_unless_empty(json, #name, x.name);
#define ASSAY_GET_FIELD(name) get_if_there(json, #name, x.name);
// Defines to_json and from_json of a type by its members, of which those that are 0 or empty are
// left out.
#define ASSAY_SPARSE_FIELDS(Type, ...)                                      \
  void to_json(nlohmann::json& json, const Type& x) {                       \
    json = nlohmann::json::object();                                        \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(ASSAY_PUT_FIELD, __VA_ARGS__)) \
  }                                                                         \
  void from_json(const nlohmann::json& json, Type& x) {                     \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(ASSAY_GET_FIELD, __VA_ARGS__)) \
  }
