// The project's files, as the tests of the house read them. Paths are relative to the top.
#pragma once

#include "tests/test.h"

namespace assay::tests {

inline const std::filesystem::path root = ASSAY_SOURCE_DIR;

inline constexpr const char* rooms[] = {"detector",   "oracle",  "corpus",
                                        "properties", "reports", "tests"};

// Returns whether a build, an install or a tool left this file beside the sources.
inline bool is_left_behind(const std::string& name) {
  return name.front() == '.' || name == "build" || name == "node_modules" || name == "__pycache__";
}

// Returns the files in ascending order. An empty `folder` is the top.
inline std::vector<std::string> files_below(const std::string& folder) {
  std::vector<std::string> files;
  const std::filesystem::recursive_directory_iterator end;
  for (std::filesystem::recursive_directory_iterator at(root / folder); at != end; ++at) {
    if (is_left_behind(at->path().filename().string())) {
      at.disable_recursion_pending();
    } else if (at->is_regular_file()) {
      files.push_back(at->path().lexically_relative(root).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Returns the folder of a file; "" if the file is at the top.
inline std::string folder_of(const std::string& path) {
  return std::filesystem::path(path).parent_path().generic_string();
}

// Returns all folders that hold files, or folders with files, except the top.
inline std::set<std::string> folders_of(const std::vector<std::string>& files) {
  std::set<std::string> folders;
  for (const auto& file : files) {
    for (auto f = folder_of(file); !f.empty() && folders.insert(f).second;) f = folder_of(f);
  }
  return folders;
}

// Returns the first part of a path; "" if the file is at the top.
inline std::string room_of_file(const std::string& path) {
  const auto end = path.find('/');
  return end == std::string::npos ? "" : path.substr(0, end);
}

inline bool is_source(const std::string& path) {
  return path.ends_with(".h") || path.ends_with(".hpp") || path.ends_with(".cpp");
}

inline std::vector<std::string> sources_below(const std::string& folder) {
  auto files = files_below(folder);
  std::erase_if(files, [](const std::string& file) { return !is_source(file); });
  EXPECT_FALSE(files.empty()) << folder;
  return files;
}

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(root / path);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::istringstream in(text_of(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace assay::tests
