// JSON text to values, with the parser's exceptions turned into problems.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "corpus/problem.h"

namespace assay::corpus {

// Keeps the order of an object's keys.
using Json = nlohmann::ordered_json;

// malformed with the byte of the first error; non_finite_coordinate for a number beyond the
// doubles. `file` stands for the text in messages.
Expected<Json> parse_json(std::string_view text, const std::filesystem::path& file);

}  // namespace assay::corpus
