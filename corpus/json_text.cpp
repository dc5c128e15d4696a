#include "corpus/json_text.h"

#include <fmt/format.h>

namespace assay::corpus {
namespace {

constexpr int deepest = 64;

}  // namespace

Expected<Json> parse_json(std::string_view text, const std::filesystem::path& file) try {
  // Parsing needs no stack, but printing and copying descend level by level.
  bool too_deep = false;
  const auto keep = [&](int depth, Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > deepest;
    return !too_deep;
  };
  Json json = Json::parse(text, keep);
  if (too_deep) return problem_in(FileProblem::malformed, file, "JSON nested too deeply");
  return json;
} catch (const Json::parse_error& error) {
  const FileProblem what =
      error.byte > text.size() ? FileProblem::truncated : FileProblem::malformed;
  return problem_in(what, file, fmt::format("byte {}: not JSON", error.byte));
} catch (const Json::out_of_range&) {
  return problem_in(FileProblem::non_finite_coordinate, file, "a number beyond the doubles");
} catch (const Json::exception&) {
  return problem_in(FileProblem::malformed, file, "not JSON");
}

}  // namespace assay::corpus
