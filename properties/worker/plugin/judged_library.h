// The files of a detector that is judged: its library and the libraries that this one needs, or the
// files of a detector in Python. Their digests are taken before the first of its processes loads
// them and after each loading, and at the end: if one of them has changed, because it was built
// anew meanwhile, what was judged is not one detector. And the word that names a detector in
// Python.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/problem.h"
#include "properties/problem.h"

namespace assay::properties {

class JudgedLibrary {
 public:
  // The library of that name, or the one that serves the detector in Python of that name. As long
  // as somebody in this process keeps it, everybody gets the same.
  static std::shared_ptr<const JudgedLibrary> of(const std::filesystem::path& word,
                                                 const std::filesystem::path& worker);

  // What a worker loads.
  const std::filesystem::path& file() const { return files_.front().path; }

  // SHA-256 of the library's bytes. If it needs libraries outside of the system's folders
  // (needed_files), or is a detector in Python, SHA-256 of the digests of all of these files.
  // Fails, with the reason, if one of them cannot be read.
  const corpus::Expected<std::string>& digest() const { return digest_; }

  // Fails if one of the files is not what it was.
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

// The libraries that a library names as needed, as its file says; none of its code runs. They are
// those that are found by its own paths (RPATH, RUNPATH, $ORIGIN) or by LD_LIBRARY_PATH, those that
// these need in the same way, and so on. Libraries in the system's folders (/lib, /usr/lib, ...)
// are left out. Nothing for a file that is no library of this machine.
std::vector<std::filesystem::path> needed_files(const std::filesystem::path& library);

// A detector in Python is named by `python:MODULE:CLASS` in place of a library. It is served by a
// plug-in that holds an interpreter and is shipped with the Python module (reports/python).
// Nothing here runs Python.

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
