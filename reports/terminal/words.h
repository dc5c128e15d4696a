// Words as text: with characters replaced, joined to one line, or as a command that can be pasted;
// and which program this is.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace assay::reports {

// Writes characters that have a meaning in a format in the way in which that format wants them: the
// text in which each character that is a key of `characters` is replaced by its value.
std::string replace(std::string_view text, const std::map<char, std::string_view>& characters);

// The text escaped for XML, with characters that XML 1.0 does not take replaced.
std::string xml_escaped(const std::string& text);

// The items of a list as one line of text, with `between` between them.
template <class List>
std::string join(const List& list, const char* between) {
  std::string text;
  for (const auto& item : list) text += fmt::format("{}{}", text.empty() ? "" : between, item);
  return text;
}

// The word itself, or the word in quotes if a shell would read it as something else.
std::string shell_word(const std::string& word);

// Where a line is to be pasted.
enum class PastePlace : std::uint8_t { this_folder, any_folder };

// A line that runs this program, to be pasted into a shell: the program, then `words`, which are
// shell_words, and for any folder with absolute_paths. The program is "assay" if that is what a
// shell finds on the PATH, else its path: in this folder "build/release/assay" if it lies below. A
// line for any folder goes to this one first if it names a detector in Python, which lies here.
// Every line to paste is made here or is the next, but for those that a certificate or a page
// holds: they begin with "assay" on every machine.
std::string line_to_paste(const std::string& words, PastePlace place = PastePlace::any_folder);

// The whole command as it was typed, with all of its inputs. For any folder it goes to this one
// first, and leaves out the options that say what is written where.
std::string this_command(PastePlace place);

// The path of the same file that can be used from any folder; empty for none. The word of a
// detector in Python stays as it is.
std::string absolute_path(const std::filesystem::path& path);

// The commit: 40 hexadecimal digits, followed by "-dirty" if tracked files were changed. Empty if
// the program was built outside of a git repository.
std::string commit_text();

// "assay 0.2.0 (CGAL 5.5.1, GMP ..., ...)": this program and the libraries that its answers rest
// on.
std::string version_text();

}  // namespace assay::reports
