#include "corpus/queries/truth_json.h"

#include <fmt/format.h>

#include <boost/outcome/try.hpp>

#include "corpus/file_bytes.h"
#include "corpus/json_text.h"

namespace assay::corpus {

Expected<std::vector<bool>> read_truths(const std::filesystem::path& path) {
  BOOST_OUTCOME_TRY(bytes, read_bytes(path));
  BOOST_OUTCOME_TRY(json, parse_json(bytes, path));
  if (!json.is_array()) {
    return problem_in(path, "an array of booleans expected");
  }
  std::vector<bool> truths;
  for (const Json& truth : json) {
    if (!truth.is_boolean()) {
      return problem_in(path, fmt::format("item {} is not a boolean", truths.size()));
    }
    truths.push_back(truth.get<bool>());
  }
  return truths;
}

}  // namespace assay::corpus
