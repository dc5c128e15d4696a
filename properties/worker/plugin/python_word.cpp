#include "properties/worker/plugin/python_word.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <vector>

namespace assay::properties {
namespace {

bool is_identifier(std::string_view text) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '_' || c >= 0x80; };
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text.front())) &&
         std::all_of(text.begin(), text.end(), fits);
}

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// The places where the package may be: in the build folder, around the programs (as pip puts it),
// or where CMake installs it.
std::vector<std::filesystem::path> places_beside(const std::filesystem::path& programs) {
  std::vector<std::filesystem::path> places = {programs / "python" / "assay", programs / ".."};
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(programs / ".." / "lib", none)) {
    if (entry.path().filename().string().starts_with("python3"))
      places.push_back(entry.path() / "dist-packages" / "assay");
  }
  return places;
}

Problem not_here(std::string_view word, const std::string& reason) {
  return {ProblemKind::not_found, std::string(word) + ": " + reason};
}

constexpr const char* no_word = "not a detector in Python: python:MODULE:CLASS is wanted";

}  // namespace

bool names_python(std::string_view word) { return word.starts_with(python_prefix); }

std::optional<PythonWord> python_word_of(std::string_view word) {
  if (!names_python(word)) return std::nullopt;
  const auto parts = parts_of(std::string(word.substr(python_prefix.size())), ':');
  if (parts.size() != 2 || !is_identifier(parts[1])) return std::nullopt;
  const auto modules = parts_of(parts[0], '.');
  if (!std::all_of(modules.begin(), modules.end(), is_identifier)) return std::nullopt;
  return PythonWord{parts[0], parts[1]};
}

Expected<std::filesystem::path> python_plugin(std::string_view word,
                                              const std::filesystem::path& worker) {
  if (!python_word_of(word)) return not_here(word, no_word);
  for (const auto& place : places_beside(worker.parent_path())) {
    auto file = place / "python_detector.so";
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  }
  return not_here(word, "the Python module of this build is not beside " + worker.string());
}

Expected<std::filesystem::path> python_module_file(std::string_view word) {
  const auto named = python_word_of(word);
  if (!named) return not_here(word, no_word);
  std::filesystem::path place;
  for (const auto& part : parts_of(named->module, '.')) place /= part;
  std::vector<std::string> folders = {"."};
  if (const char* more = std::getenv("PYTHONPATH")) {
    for (auto& folder : parts_of(more, ':')) folders.push_back(std::move(folder));
  }
  for (const std::filesystem::path folder : folders) {
    for (const auto& file : {folder / (place.string() + ".py"), folder / place / "__init__.py"}) {
      std::error_code ignored;
      if (std::filesystem::is_regular_file(file, ignored)) return file;
    }
  }
  return not_here(word, "no module " + named->module + " in this folder or those of PYTHONPATH");
}

}  // namespace assay::properties
