// Writes and reads the fields of a row as JSON.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/json_fields.h"
#include "properties/campaign/ledger/database.h"
#include "properties/fields.h"

namespace assay::properties {

// Throws the StoreProblem for a row that no run stores.
[[noreturn]] inline void throw_not_stored(const Row& row, const std::exception& wrong) {
  throw StoreProblem(fmt::format("{}: {}", row_name(row), wrong.what()));
}

// Returns the fields. If the fields are no JSON object, throws a StoreProblem that names the row.
inline nlohmann::json fields_of(const Row& row) {
  auto json = corpus::parse_sorted_json(row.fields, "fields");
  if (!json) throw StoreProblem(fmt::format("{}: {}", row_name(row), json.error().message));
  if (!json.value().is_object())
    throw StoreProblem(fmt::format("{}: its fields are no JSON object", row_name(row)));
  return std::move(json.value());
}

// Sets the members of x that the fields name (fields.h); other members of x do not change.
template <Zeros zeros = Zeros::stay, class T>
void read_fields_of(const Row& row, T& x) try {
  read_fields<nlohmann::json, zeros>(fields_of(row), x);
} catch (const nlohmann::json::exception& wrong) {
  throw_not_stored(row, wrong);
}

// Returns the text that the row holds under this name.
inline std::string text_in(const Row& row, const char* name) try {
  return fields_of(row).at(name).get<std::string>();
} catch (const nlohmann::json::exception& wrong) {
  throw_not_stored(row, wrong);
}

// Returns the number that the text spells. Throws StoreProblem if it spells none.
std::uint64_t number_of_text(const std::string& text);

}  // namespace assay::properties
