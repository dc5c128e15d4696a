#include "reports/terminal/shell_word.h"

#include "properties/worker/plugin/python_word.h"

namespace assay::reports {

std::string shell_word(const std::string& word) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:,+=@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::string absolute_path(const std::filesystem::path& path) {
  if (path.empty() || properties::names_python(path.string())) return path.string();
  std::error_code error;
  const auto found = std::filesystem::absolute(path, error);
  return error ? path.string() : found.lexically_normal().string();
}

std::string detector_words(const std::string& library, std::uint64_t threads) {
  if (library.empty()) return "";
  const std::string words = " --detector " + shell_word(library);
  return threads == 1 ? words : words + " --threads " + std::to_string(threads);
}

}  // namespace assay::reports
