// JSON text to values, with the parser's exceptions turned into problems; and values to text.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "corpus/problem.h"

namespace assay::corpus {

// Keeps the order of an object's keys.
using Json = nlohmann::ordered_json;

// Refuses what is not JSON (the message names the byte) and a number beyond the doubles. A value
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

}  // namespace assay::corpus
