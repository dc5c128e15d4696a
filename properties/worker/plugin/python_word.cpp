#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>

#include "properties/worker/plugin/judged_library.h"

namespace assay::properties {

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

namespace {

namespace fs = std::filesystem;

bool is_identifier(std::string_view text) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '_' || c >= 0x80; };
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text.front())) &&
         std::ranges::all_of(text, fits);
}

// Returns the places where the package may be: in the build folder, around the programs (as pip
// puts it), or where CMake installs it: the worker is then in libexec/assay.
std::vector<std::filesystem::path> places_beside(const std::filesystem::path& programs) {
  std::vector<std::filesystem::path> places = {programs / "python" / "assay", programs / ".."};
  std::error_code none;
  const auto libraries = programs / ".." / ".." / "lib";
  for (const auto& entry : std::filesystem::directory_iterator(libraries, none)) {
    if (entry.path().filename().string().starts_with("python3"))
      places.push_back(entry.path() / "dist-packages" / "assay");
  }
  return places;
}

// Adds the file of a module or package, if it exists and is not in the list yet.
void add_module(const fs::path& place, std::vector<fs::path>& files) {
  for (const auto& file : {fs::path(place.string() + ".py"), place / "__init__.py"}) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) continue;
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
    return;
  }
}

// Returns the words of those lines of a file that import something. Some of the words are names of
// modules.
std::vector<std::string> imported_names(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> names;
  for (std::string line; std::getline(in, line);) {
    line.erase(0, std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with("import ") && !line.starts_with("from ")) continue;
    std::ranges::replace_if(
        line,
        [](char c) {
          return !is_identifier({&c, 1}) && !std::isdigit(static_cast<unsigned char>(c));
        },
        ' ');
    for (auto& name : parts_of(line, ' ')) {
      if (is_identifier(name)) names.push_back(std::move(name));
    }
  }
  return names;
}

Problem not_here(std::string_view word, const std::string& reason) {
  return {std::string(word) + ": " + reason};
}

constexpr const char* no_word = "not a detector in Python: write python:MODULE:CLASS";

}  // namespace

bool names_python(std::string_view word) { return word.starts_with(python_prefix); }

std::optional<PythonWord> python_word_of(std::string_view word) {
  if (!names_python(word)) return std::nullopt;
  const auto parts = parts_of(std::string(word.substr(python_prefix.size())), ':');
  if (parts.size() != 2 || !is_identifier(parts[1])) return std::nullopt;
  const auto modules = parts_of(parts[0], '.');
  if (!std::ranges::all_of(modules, is_identifier)) return std::nullopt;
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

Expected<std::vector<fs::path>> python_module_files(std::string_view word) {
  const auto python = python_word_of(word);
  if (!python) return not_here(word, no_word);
  const auto packages = parts_of(python->module, '.');
  std::vector<std::string> folders = {"."};
  if (const char* more = std::getenv("PYTHONPATH")) {
    for (auto& folder : parts_of(more, ':')) folders.push_back(std::move(folder));
  }
  for (const fs::path folder : folders) {
    fs::path place = folder;
    for (const auto& part : packages) place /= part;
    std::vector<fs::path> files;
    add_module(place, files);
    if (files.empty()) continue;
    for (place = place.parent_path(); place != folder && !place.empty();
         place = place.parent_path())
      add_module(place, files);
    for (std::size_t i = 0; i < files.size(); ++i) {
      const auto file = files[i];
      for (const auto& name : imported_names(file)) {
        add_module(file.parent_path() / name, files);
        add_module(folder / name, files);
      }
    }
    return files;
  }
  return not_here(word, "no module " + python->module + " here or in a folder of PYTHONPATH");
}

}  // namespace assay::properties
