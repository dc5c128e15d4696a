#include "reports/campaign/own_cases.h"

#include <fmt/format.h>

#include <boost/outcome/try.hpp>

#include "corpus/digest.h"
#include "corpus/files.h"

namespace assay::reports {

corpus::Expected<std::vector<corpus::Case>> read_cases(
    const std::vector<std::filesystem::path>& files) {
  std::vector<corpus::Case> cases;
  for (const auto& file : files) {
    BOOST_OUTCOME_TRY(c, corpus::read_case(file));
    cases.push_back(std::move(c));
  }
  return cases;
}

std::string digest_of_files(const std::vector<std::filesystem::path>& files) {
  std::string lines;
  for (const auto& file : files) {
    const auto digest = corpus::sha256_of_file(file);
    lines += fmt::format("{} {}\n", file.filename().string(), digest ? digest.value() : "");
  }
  return corpus::sha256_of(lines);
}

Expected<properties::OwnCases> read_own_cases(const std::filesystem::path& folder) {
  // A folder is named before the first case is put there.
  std::error_code ignored;
  if (!std::filesystem::exists(folder, ignored))
    return properties::OwnCases{{}, digest_of_files({})};
  BOOST_OUTCOME_TRY(files, corpus::case_files(folder));
  BOOST_OUTCOME_TRY(cases, read_cases(files));
  return properties::OwnCases{std::move(cases), digest_of_files(files)};
}

}  // namespace assay::reports
