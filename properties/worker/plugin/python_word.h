// A detector in Python is named by `python:MODULE:CLASS` in place of a library. It is served by a
// plug-in that holds an interpreter and is shipped with the Python module (reports/python).
// Nothing here runs Python.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/problem.h"

namespace assay::properties {

// The text between each two separators, empty parts too.
std::vector<std::string> parts_of(const std::string& text, char separator);

struct PythonWord {
  std::string module;  // a module in a package has dots
  std::string name;    // name of the class

  std::string text() const { return module + ":" + name; }
};

inline constexpr std::string_view python_prefix = "python:";

// Whether the word is meant to name a detector in Python, be it well formed or not.
bool names_python(std::string_view word);

// The environment variable in which the plug-in finds the word's text.
inline constexpr const char* python_detector_variable = "ASSAY_PYTHON_DETECTOR";

// The parts of the word; nothing if it is not well formed.
std::optional<PythonWord> python_word_of(std::string_view word);

// The library that is loaded for the word: the shipped plug-in, which lies beside the program
// assay-worker, as it was built or installed. Fails if the word is not well formed, or there
// is no such file.
Expected<std::filesystem::path> python_plugin(std::string_view word,
                                              const std::filesystem::path& worker);

// The file of the module, or of the package of that name, in this folder or in one of PYTHONPATH,
// comes first. Then come the files of the packages around it, and those that these files import by
// name from beside them or from the same folder, and so on. Fails if there is no module.
Expected<std::vector<std::filesystem::path>> python_module_files(std::string_view word);

}  // namespace assay::properties
