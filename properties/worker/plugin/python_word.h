// A detector in Python, named by `python:MODULE:CLASS` where a library is named otherwise: it is
// served by a plug-in that holds an interpreter and is shipped with the Python module
// (reports/python). Nothing here runs Python.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "properties/problem.h"

namespace assay::properties {

struct PythonWord {
  std::string module;  // with dots, of a module in a package
  std::string name;    // of the class

  std::string text() const { return module + ":" + name; }
};

inline constexpr std::string_view python_prefix = "python:";

// Whether the word names a detector in Python, well or not.
bool names_python(std::string_view word);

// The variable of the environment in which the plug-in finds the word's text.
inline constexpr const char* python_detector_variable = "ASSAY_PYTHON_DETECTOR";

// The same in parts; nothing for a word that is none.
std::optional<PythonWord> python_word_of(std::string_view word);

// What is loaded for the word: the shipped plug-in, which lies beside the program assay-worker,
// as it was built or installed. not_found: a word that is none, or no such file.
Expected<std::filesystem::path> python_plugin(std::string_view word,
                                              const std::filesystem::path& worker);

// The file of the module, or of the package of that name, in this folder or one of
// PYTHONPATH. not_found.
Expected<std::filesystem::path> python_module_file(std::string_view word);

}  // namespace assay::properties
