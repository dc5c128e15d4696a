// Turns words into text: replaces characters, joins words to one line, makes commands that can be
// pasted; and names this program's version.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace assay::reports {

// Returns the text with each character that is a key of `characters` replaced by its value, as
// formats demand for characters that have a meaning in them.
std::string replace(std::string_view text, const std::map<char, std::string_view>& characters);

// Returns the text escaped for XML, with characters that XML 1.0 does not allow replaced.
std::string xml_escaped(const std::string& text);

// A test in a JUnit file.
struct JunitTest {
  std::string name;
  std::string element;  // "failure", "error" or "skipped"; empty: it holds
  std::string why;      // not used for a test that holds
};
// Returns the tests as a suite of a JUnit file. Empty if there are none.
std::string junit_suite(const std::string& suite, const std::string& class_name,
                        const std::vector<JunitTest>& tests, const std::string& output = "");

// Returns the items of a list as one line of text, with `between` between them.
template <class List>
std::string join(const List& list, const char* between) {
  std::string text;
  for (const auto& item : list) text += fmt::format("{}{}", text.empty() ? "" : between, item);
  return text;
}

// Returns the word itself, or the word in quotes if a shell would read it otherwise.
std::string shell_word(const std::string& word);

// The folder in which a line is to be pasted.
enum class PastePlace : std::uint8_t { this_folder, any_folder };

// Returns a line that runs this program, to be pasted into a shell: the program, then `words`,
// which must be shell_words, and for any folder must have absolute_paths. The program is written
// "assay" if a shell finds it by that name on the PATH, else as its path, which in this folder is
// "build/release/assay" if it lies below. A line for any folder changes to this folder first if it
// names a detector in Python, which lies here. All lines to paste come from this function or the
// next, except those in a certificate or a page, which begin with "assay" on every machine.
std::string line_to_paste(const std::string& words, PastePlace place = PastePlace::any_folder);

// Returns the whole command as it was typed, with all of its inputs. With PastePlace::any_folder
// the line first changes to this folder, and has no options for output files.
std::string this_command(PastePlace place);

// Returns the absolute path of the file; empty for an empty path. Does not change the word of a
// detector in Python.
std::string absolute_path(const std::filesystem::path& path);

// Returns the commit: 40 hexadecimal digits, followed by "-dirty" if tracked files were changed.
// Empty if the program was built outside of a git repository.
std::string commit_text();

// Returns "assay 0.2.0 (CGAL 5.5.1, GMP ..., ...)": this program, and libraries behind its answers.
std::string version_text();

}  // namespace assay::reports
