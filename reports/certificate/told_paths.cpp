#include "reports/certificate/told_paths.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

}  // namespace

ToldPaths::ToldPaths(const properties::RunFindings& findings) {
  const auto& stored = findings.evidence.paths;
  const auto folder = stored ? stored->out : findings.folder.string();
  const std::filesystem::path whole = absolute_path(std::filesystem::path(folder) / "");
  if (!folder.empty() && whole != whole.root_path()) folder_ = whole.string();
  for (const auto& path : {findings.library, stored ? stored->detector : "",
                           stored ? stored->own_cases : "", stored ? stored->data : ""}) {
    if (std::filesystem::path(path).is_absolute()) others_.insert({path, absolute_path(path)});
  }
}

std::string ToldPaths::told(const std::string& path) const {
  const std::filesystem::path whole = absolute_path(path);
  if (whole.is_relative() || folder_.empty()) return path;
  const auto from = std::filesystem::path(folder_).parent_path();
  const auto common = std::mismatch(whole.begin(), whole.end(), from.begin(), from.end()).first;
  constexpr std::ptrdiff_t root_alone = 1;
  return std::distance(whole.begin(), common) > root_alone ? whole.lexically_relative(from).string()
                                                           : whole.filename().string();
}

void ToldPaths::tell_in(nlohmann::ordered_json& json) const {
  if (json.is_structured()) {
    for (auto& part : json) tell_in(part);
  } else if (json.is_string()) {
    tell_in(json.get_ref<std::string&>());
  }
}

void ToldPaths::tell_in(std::string& text) const {
  for (const auto& path : others_) {
    replace_all(text, shell_word(path), shell_word(told(path)));
    replace_all(text, path, told(path));
  }
  if (!folder_.empty()) replace_all(text, folder_, "");
}

}  // namespace assay::reports
