#include "reports/campaign/own_cases.h"

#include <fmt/format.h>

#include "corpus/digest.h"

namespace assay::reports {
namespace {

constexpr const char* waivers_of_owner = "known.json";

}  // namespace

corpus::Expected<std::vector<corpus::Case>> read_cases(
    const std::vector<std::filesystem::path>& files) {
  std::vector<corpus::Case> cases;
  for (const auto& file : files) {
    auto c = corpus::read_case(file);
    if (!c) return c.error();
    cases.push_back(std::move(c.value()));
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
  auto files = corpus::case_files(folder);
  if (!files) return files.error();
  std::erase_if(files.value(),
                [](const auto& file) { return file.filename() == waivers_of_owner; });
  if (files.value().empty())
    return Problem{fmt::format("{}: there is no case file in it", folder.string())};
  auto cases = read_cases(files.value());
  if (!cases) return cases.error();
  return properties::OwnCases{std::move(cases.value()), digest_of_files(files.value())};
}

std::optional<std::filesystem::path> owner_waivers(const std::filesystem::path& folder) {
  std::error_code ignored;
  const auto file = folder / waivers_of_owner;
  return std::filesystem::exists(file, ignored) ? std::optional(file) : std::nullopt;
}

}  // namespace assay::reports
