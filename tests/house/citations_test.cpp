// Every file that a comment or a README cites exists.
//
// A citation is a word that looks like a path: it ends like a file of the project (".h", ".md"), or
// its first part is a folder. The test looks for the cited file from the citing file's folder, from
// its room and from the top. In its own room a file may be cited by the end of its path
// ("house_test.cpp" for tests/house/house_test.cpp), and a test may do so in the room that it
// tests. A pattern ("house/*_test.cpp") has to fit some file.
#include <fnmatch.h>

#include <cctype>

#include "tests/house/tree.h"

namespace assay::tests {
namespace {

const std::set<std::string> file_types = {"md",   "h",   "cpp",  "c",     "in",    "ts",
                                          "mjs",  "py",  "sh",   "cmake", "txt",   "fault",
                                          "json", "csv", "html", "svg",   "sha256"};
// What stands for a name that the reader puts in.
const std::set<std::string> placeholders = {"NAME", "ID",   "ROOM",   "INNER", "SUITE", "OUT",
                                            "DIR",  "FILE", "FOLDER", "OTHER", "CASE",  "PLUGIN"};
// What the programs write, and what users and public data bring; "steps/s/core" is a speed.
const std::set<std::string> not_of_the_project = {
    "certificate.json", "campaign.json", "summary.md",
    "result.json",      "mesh.json",     "compile_commands.json",
    "mesh.svg",         "mesh.x.svg",    "hosts.txt",
    "3036vf.csv",       "textbook.py",   "results.json",
    "set.json",         "matrix.html",   "my_ccd.cpp",
    "ccd.py",           "core"};
const std::set<std::string> written_folders = {"build", "certified", "failures"};

// The text with everything but its comments blanked out; lines stay where they are. A README is a
// comment from end to end.
std::string comments_of_code(const std::string& text) {
  std::string out(text.size(), ' ');
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    bool is_comment = false;
    if (text.compare(i, 2, "//") == 0) {
      end = std::min(text.find('\n', i), text.size());
      is_comment = true;
    } else if (text.compare(i, 2, "/*") == 0) {
      end = std::min(text.find("*/", i), text.size());
      is_comment = true;
    } else if (text[i] == '"') {
      while (end < text.size() && text[end] != '"' && text[end] != '\n') {
        end += text[end] == '\\' ? 2 : 1;
      }
      end = std::min(end + 1, text.size());
    }
    for (; i < end; ++i) {
      if (is_comment || text[i] == '\n') out[i] = text[i];
    }
  }
  return out;
}

std::string comments_of_script(const std::string& text) {
  std::string out(text.size(), ' ');
  bool is_comment = false, line_is_blank = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') is_comment = false, line_is_blank = true;
    if (line_is_blank && text[i] == '#') is_comment = true;
    if (!std::isspace(static_cast<unsigned char>(text[i]))) line_is_blank = false;
    if (is_comment || text[i] == '\n') out[i] = text[i];
  }
  return out;
}

// "" of a file in which nothing is looked for.
std::string comments_of(const std::string& path) {
  const auto type = path.substr(path.rfind('.') + 1);
  const std::string text = text_of(path);
  if (type == "md") return text;
  if (std::set<std::string>{"h", "cpp", "c", "in", "ts", "mjs"}.contains(type)) {
    return comments_of_code(text);
  }
  const bool is_script = std::set<std::string>{"sh", "py", "cmake", "fault"}.contains(type) ||
                         path.ends_with("CMakeLists.txt") || text.starts_with("#!");
  return is_script ? comments_of_script(text) : "";
}

struct Citation {
  std::string path;
  long line = 0;
};

bool contains(std::string_view characters, char c) {
  return characters.find(c) != std::string_view::npos;
}

bool is_part_of_path(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || contains("_.*/-", c);
}

std::vector<Citation> words_like_paths(const std::string& text) {
  std::vector<Citation> words;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_part_of_path(text[i])) continue;
    const std::size_t begin = i;
    while (i < text.size() && is_part_of_path(text[i])) ++i;
    std::string word = text.substr(begin, i - begin);
    while (word.ends_with(".") || word.ends_with("/")) word.pop_back();
    if (word.starts_with("./")) word.erase(0, 2);
    // The rest of an address, of a variable's path, of an option; a header of a system.
    const char before = begin > 0 ? text[begin - 1] : ' ';
    const bool is_rest = word.empty() || contains("./-", word.front());
    if (is_rest || before == '<' || before == '}') continue;
    if (i < text.size() && text[i] == '(') continue;  // a member, as in formulas
    words.push_back(
        {word, 1 + std::count(text.begin(), text.begin() + static_cast<long>(begin), '\n')});
  }
  return words;
}

bool has_placeholder(const std::string& path) {
  std::string word;
  for (const char c : path + "/") {
    if (std::isalpha(static_cast<unsigned char>(c))) {
      word += c;
    } else {
      if (placeholders.contains(word)) return true;
      word.clear();
    }
  }
  return false;
}

class Tree {
 public:
  Tree() : files_(files_below("")), folders_(folders_of(files_)) {
    there_.insert(files_.begin(), files_.end());
    there_.insert(folders_.begin(), folders_.end());
    for (const auto& file : files_) {
      if (is_source(file)) there_.insert(file.substr(0, file.rfind('.')));
    }
  }

  const std::vector<std::string>& files() const { return files_; }

  bool is_citation(const std::string& path, const std::string& citing) const {
    const auto name = path.substr(path.rfind('/') + 1);
    const auto first = room_of_file(path);
    if (has_placeholder(path) || not_of_the_project.contains(name) ||
        written_folders.contains(first)) {
      return false;
    }
    const auto dot = name.rfind('.');
    if (dot != std::string::npos && dot > 0 && file_types.contains(name.substr(dot + 1))) {
      return true;
    }
    if (first.empty() || dot != std::string::npos) return false;
    const auto bases = bases_of(citing);
    return std::any_of(bases.begin(), bases.end(),
                       [&](const auto& base) { return folders_.contains(joined(base, first)); });
  }

  bool finds(const std::string& path, const std::string& citing) const {
    for (const auto& base : bases_of(citing)) {
      if (there_.contains(joined(base, path))) return true;
      const bool is_pattern = path.find('*') != std::string::npos;
      const bool is_room = !base.empty() && base.find('/') == std::string::npos;
      const auto ends_so = [&](const std::string& file) {
        return (is_pattern && fits(joined(base, path), file)) ||
               (is_room && file.starts_with(base + "/") && fits("*/" + path, file));
      };
      if (std::any_of(files_.begin(), files_.end(), ends_so)) return true;
    }
    return false;
  }

 private:
  // A star of "*/contact.h" goes over folders, so that it stands for any beginning of a path.
  static bool fits(const std::string& pattern, const std::string& file) {
    return fnmatch(pattern.c_str(), file.c_str(), 0) == 0;
  }

  static std::string joined(const std::string& base, const std::string& path) {
    return (std::filesystem::path(base) / path).lexically_normal().generic_string();
  }

  // Folder, room and top; of a test, the room that it tests.
  static std::vector<std::string> bases_of(const std::string& citing) {
    std::vector<std::string> bases = {folder_of(citing), room_of_file(citing), ""};
    if (bases[1] == "tests") bases.push_back(room_of_file(citing.substr(bases[1].size() + 1)));
    return bases;
  }

  std::vector<std::string> files_;
  std::set<std::string> folders_;
  std::set<std::string> there_;  // files, sources without their ending, folders
};

TEST(Citations, AreOfFilesThatAreThere) {
  const Tree tree;
  std::size_t citations = 0;
  for (const auto& file : tree.files()) {
    for (const auto& [path, line] : words_like_paths(comments_of(file))) {
      if (!tree.is_citation(path, file)) continue;
      ++citations;
      EXPECT_TRUE(tree.finds(path, file)) << file << ":" << line << " cites " << path;
    }
  }
  std::printf("%zu citations of files\n", citations);
  EXPECT_GT(citations, 300u);
}

}  // namespace
}  // namespace assay::tests
