// The files of a detector that is judged: its library with the libraries that this library needs,
// or the files of a detector in Python. The files are hashed before the detector's first process
// loads them, after each loading, and at the end. If a file has changed, because it was rebuilt
// meanwhile, the run judged two different detectors. This header also reads the word that names a
// detector in Python.
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
  // Returns the library with this path, or the library that runs the Python detector that `word`
  // names. As long as a caller in this process keeps the object, every call with the same arguments
  // returns the same object.
  static std::shared_ptr<const JudgedLibrary> of(const std::filesystem::path& word,
                                                 const std::filesystem::path& worker);

  // Returns the file that a worker loads.
  const std::filesystem::path& file() const { return files_.front().path; }

  // Returns the SHA-256 of the library's bytes. If the library needs libraries outside of the
  // system's folders (needed_files), or the detector is in Python, returns the SHA-256 of the
  // digests of all its files. Fails if a file cannot be read; the problem states the reason.
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

// Returns the libraries that the system's loader would load together with this library, without
// running the library's code. Libraries in the system's folders (/lib, /usr/lib, ...) are left out.
// Empty if the loader does not accept the file, or does not find all libraries that the file needs.
// Fails if the loader cannot be started, or does not end.
corpus::Expected<std::vector<std::filesystem::path>> needed_files(
    const std::filesystem::path& library);

// A detector in Python is named by `python:MODULE:CLASS` in place of a library. A plug-in with an
// interpreter, which is shipped with the Python module (reports/python), runs the detector. The
// functions below run no Python.

// Returns the parts of the text between separators, empty parts too.
std::vector<std::string> parts_of(const std::string& text, char separator);

struct PythonWord {
  std::string module;  // a module in a package has dots
  std::string name;    // name of the class

  std::string text() const { return module + ":" + name; }
};

inline constexpr std::string_view python_prefix = "python:";

// Returns whether the word begins like the name of a detector in Python. It can still be malformed.
bool names_python(std::string_view word);

// The environment variable in which the plug-in finds PythonWord::text().
inline constexpr const char* python_detector_variable = "ASSAY_PYTHON_DETECTOR";

// Returns the parts of the word; nothing if the word is malformed.
std::optional<PythonWord> python_word_of(std::string_view word);

// Returns the library that is loaded for the word: the shipped plug-in, which lies beside the
// program assay-worker, both in a build folder and where it is installed. Fails if the word is
// malformed, or if that file does not exist.
Expected<std::filesystem::path> python_plugin(std::string_view word,
                                              const std::filesystem::path& worker);

// Returns the files of a Python detector. The first file is that of the module, or of the package
// with the module's name, in the current folder or in a folder of PYTHONPATH. Then come the files
// of the packages around the module, then the files that all of these import by name from their
// folders, and so on. Fails if there is no such module.
Expected<std::vector<std::filesystem::path>> python_module_files(std::string_view word);

}  // namespace assay::properties
