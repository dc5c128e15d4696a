// The files of a detector that is judged: its library and the libraries that this one needs, or the
// files of a detector in Python. Their digests are taken before its first process loads them, after
// each loading, and at the end: if a file has changed, because it was rebuilt meanwhile, the run
// did not judge one detector. Also reads the word that names a detector in Python.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/words.h"

namespace assay::properties {

class JudgedLibrary {
 public:
  // Returns the library of that name, or the library that serves the Python detector of that name.
  // As long as a caller in this process keeps the object, every call returns the same one.
  static std::shared_ptr<const JudgedLibrary> of(const std::filesystem::path& word,
                                                 const std::filesystem::path& worker);

  // Returns the file that a worker loads.
  const std::filesystem::path& file() const { return files_.front().path; }

  // Returns the SHA-256 of the library's bytes; if it needs libraries outside of the system's
  // folders (needed_files), or is a detector in Python, the SHA-256 of the digests of all these
  // files. Fails, with the reason, if a file cannot be read.
  const corpus::Expected<std::string>& digest() const { return digest_; }

  // Fails if one of the files has changed.
  Expected<void> is_as_it_was() const;

 private:
  JudgedLibrary(const std::filesystem::path& word, const std::filesystem::path& worker);
  void take(const std::vector<std::filesystem::path>& files);

  struct File {
    std::filesystem::path path;
    std::string digest;  // empty if it could not be read
  };

  std::vector<File> files_;  // the library comes first
  corpus::Expected<std::string> digest_;
};

// Returns the libraries that the system's loader would load with a library, without running its
// code. Libraries in the system's folders (/lib, /usr/lib, ...) are left out. Empty for a file that
// the loader does not take, and if the loader does not find all that the file needs. A problem if
// the loader cannot be asked, or does not end.
corpus::Expected<std::vector<std::filesystem::path>> needed_files(
    const std::filesystem::path& library);

// A detector in Python is named by `python:MODULE:CLASS` in place of a library. It is served by a
// plug-in that holds an interpreter and is shipped with the Python module (reports/python).
// Nothing here runs Python.

// Returns the parts of the text between separators, empty parts too.
std::vector<std::string> parts_of(const std::string& text, char separator);

struct PythonWord {
  std::string module;  // a module in a package has dots
  std::string name;    // name of the class

  std::string text() const { return module + ":" + name; }
};

inline constexpr std::string_view python_prefix = "python:";

// Returns whether the word is meant to name a detector in Python, well formed or not.
bool names_python(std::string_view word);

// The environment variable in which the plug-in finds the word's text.
inline constexpr const char* python_detector_variable = "ASSAY_PYTHON_DETECTOR";

// Returns the parts of the word; nothing if it is not well formed.
std::optional<PythonWord> python_word_of(std::string_view word);

// Returns the library that is loaded for the word: the shipped plug-in, which lies beside the
// program assay-worker, as it was built or installed. Fails if the word is not well formed, or
// there is no such file.
Expected<std::filesystem::path> python_plugin(std::string_view word,
                                              const std::filesystem::path& worker);

// Returns the files of a Python detector. First comes the file of the module, or of the package of
// that name, in the current folder or in one of PYTHONPATH. The files of the packages around it
// follow, then the files that these import by name from their folders, and so on. Fails if there is
// no module.
Expected<std::vector<std::filesystem::path>> python_module_files(std::string_view word);

}  // namespace assay::properties
