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

// Returns the text with each character that is a key of `characters` replaced by its value. Formats
// demand this for characters with a special meaning.
std::string replace(std::string_view text, const std::map<char, std::string_view>& characters);

// Returns the text escaped for XML. Characters that XML 1.0 does not allow are replaced.
std::string xml_escaped(const std::string& text);

// A test in a JUnit file.
struct JunitTest {
  std::string name;
  std::string element;  // "failure", "error" or "skipped"; empty: the test holds
  std::string why;      // not used for a test that holds
};
// Returns the tests as a suite of a JUnit file. Empty if there are no tests.
std::string junit_suite(const std::string& suite, const std::string& class_name,
                        const std::vector<JunitTest>& tests, const std::string& output = "");

// Returns the items of a list as one line of text, with `between` between them.
template <class List>
std::string join(const List& list, const char* between) {
  std::string text;
  for (const auto& item : list) text += fmt::format("{}{}", text.empty() ? "" : between, item);
  return text;
}

// Returns the word itself, or the word in quotes if a shell would change the bare word.
std::string shell_word(const std::string& word);

// The folder in which a line is to be pasted.
enum class PastePlace : std::uint8_t { this_folder, any_folder };

// Returns a line to be pasted into a shell: this program, then `words`. The program is written
// "assay" if a shell finds it on the PATH by that name, and otherwise as its path; in a line for
// this folder the path is relative, such as "build/release/assay", if the program lies below this
// folder. A line for any folder first changes to this folder if it names a detector in Python,
// and sets PYTHONPATH as it is here, because Python looks for the module in these folders. REQUIRES
// that each word is a shell_word, and for PastePlace::any_folder that each path is an
// absolute_path. All lines to paste come from this function or from this_command, except the lines
// in a certificate or a page, which begin with "assay" on every machine.
std::string line_to_paste(const std::string& words, PastePlace place = PastePlace::any_folder);

// Returns the whole command as it was typed, with all of its inputs. With PastePlace::any_folder
// the line first changes to this folder, and has no options for output files.
std::string this_command(PastePlace place);

// Returns the absolute path of the file; empty for an empty path. The word of a detector in Python
// is returned as it is.
std::string absolute_path(const std::filesystem::path& path);

// Returns the commit: 40 hexadecimal digits, followed by "-dirty" if tracked files were changed.
// Empty if the program was built outside of a git repository.
std::string commit_text();

// Returns "assay 0.2.0 (CGAL 5.5.1, GMP ..., ...)": this program, and libraries behind its answers.
std::string version_text();

}  // namespace assay::reports
