#include "reports/campaign/case_folders.h"

#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <cstdlib>

#include "corpus/digest.h"
#include "corpus/files.h"
#include "properties/worker/worker_process.h"

namespace assay::reports {

Expected<std::filesystem::path> shipped_corpus() {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto is_corpus = [&](const fs::path& folder) {
    return fs::is_directory(folder / "curated", error);
  };
  if (const char* named = std::getenv("ASSAY_CORPUS"); named && *named) {
    if (is_corpus(named)) return fs::path(named);
    return Problem{fmt::format("ASSAY_CORPUS is {}: it holds no curated/", named)};
  }
  const auto programs = properties::program_folder();
  // Installed, then as it was built.
  for (const auto& place : {programs / ".." / "share", programs / "share"}) {
    const auto folder = (place / "assay" / "corpus").lexically_normal();
    if (is_corpus(folder)) return folder;
  }
  return Problem{fmt::format("the shipped corpus is not at {}; ASSAY_CORPUS names its folder",
                             (programs / "../share/assay/corpus").lexically_normal().string())};
}

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
