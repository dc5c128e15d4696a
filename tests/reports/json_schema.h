// The part of JSON Schema (2020-12) that this project's schema files use.
#pragma once

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/test.h"

namespace assay::tests {

using SchemaJson = nlohmann::ordered_json;

inline bool is_of_type(const SchemaJson& value, const std::string& type) {
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  return type == "null" && value.is_null();
}

inline SchemaJson schema_named(const std::string& name) {
  std::ifstream file(ASSAY_SOURCE_DIR "/reports/schemas/" + name + ".schema.json");
  return SchemaJson::parse(file);
}

// Fails with one line for each place where `value` does not satisfy `schema`. References are looked
// up in `whole`, which contains `schema`, or in the schema of certificates, whose id has no number:
// "urn:assay:certificate#/...".
inline void check_schema(const SchemaJson& whole, const SchemaJson& schema, const SchemaJson& value,
                         const std::string& place, std::vector<std::string>& wrong) {
  static const std::set<std::string> known = {
      "$schema",    "$id",   "$defs",    "$ref",     "title",    "const",
      "enum",       "anyOf", "type",     "pattern",  "minimum",  "maximum",
      "properties", "items", "minItems", "maxItems", "required", "additionalProperties",
      "description"};
  const auto fail = [&](const std::string& why) { wrong.push_back(place + ": " + why); };
  for (const auto& [key, unused] : schema.items()) {
    if (!known.contains(key)) fail("keyword " + key + " is checked by nobody");
  }
  if (schema.contains("$ref")) {
    const auto named = schema["$ref"].get<std::string>();
    const auto hash = named.find('#');
    const SchemaJson::json_pointer part(named.substr(hash + 1));
    if (hash == 0) return check_schema(whole, whole.at(part), value, place, wrong);
    const auto other = schema_named("certificate");
    if (other["$id"] != named.substr(0, hash)) return fail("no schema " + named);
    return check_schema(other, other.at(part), value, place, wrong);
  }
  if (schema.contains("anyOf") &&
      std::none_of(schema["anyOf"].begin(), schema["anyOf"].end(), [&](const SchemaJson& one) {
        std::vector<std::string> against;
        check_schema(whole, one, value, place, against);
        return against.empty();
      }))
    fail("none of what it may be: " + value.dump());
  if (schema.contains("const") && value != schema["const"]) fail("another constant");
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    fail("none of the words");
  if (schema.contains("type")) {
    const auto types =
        schema["type"].is_array() ? schema["type"] : SchemaJson::array({schema["type"]});
    if (std::none_of(types.begin(), types.end(),
                     [&](const SchemaJson& t) { return is_of_type(value, t); }))
      return fail("of another type: " + value.dump());
  }
  if (value.is_string() && schema.contains("pattern") &&
      !std::regex_search(value.get<std::string>(), std::regex(schema["pattern"])))
    fail("of another form");
  if (value.is_number() && schema.contains("minimum") && value < schema["minimum"])
    fail("too small");
  if (value.is_number() && schema.contains("maximum") && value > schema["maximum"])
    fail("too large");
  if (value.is_array() && value.size() < schema.value("minItems", std::size_t{0})) fail("too few");
  if (value.is_array() && schema.contains("maxItems") &&
      value.size() > schema["maxItems"].get<std::size_t>())
    fail("too many");
  if (value.is_array() && schema.contains("items")) {
    for (std::size_t i = 0; i < value.size(); ++i)
      check_schema(whole, schema["items"], value[i], place + "/" + std::to_string(i), wrong);
  }
  if (!value.is_object()) return;
  for (const auto& key : schema.value("required", SchemaJson::array())) {
    if (!value.contains(key.get<std::string>())) fail("no field " + key.get<std::string>());
  }
  const auto properties = schema.value("properties", SchemaJson::object());
  const auto others = schema.value("additionalProperties", SchemaJson(true));
  for (const auto& [key, field] : value.items()) {
    if (properties.contains(key)) {
      check_schema(whole, properties[key], field, place + "/" + key, wrong);
    } else if (others.is_object()) {
      check_schema(whole, others, field, place + "/" + key, wrong);
    } else if (!others.get<bool>()) {
      fail("field " + key + " is not in the schema");
    }
  }
}

// Expects that a value satisfies the schema of this name.
inline void expect_schema(const std::string& name, const SchemaJson& value) {
  const auto schema = schema_named(name);
  std::vector<std::string> wrong;
  check_schema(schema, schema, value, "", wrong);
  for (const auto& line : wrong) ADD_FAILURE() << name << line;
}

inline void expect_certificate_schema(const SchemaJson& statement) {
  expect_schema("certificate", statement);
}

}  // namespace assay::tests
