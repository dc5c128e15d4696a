#include "reports/terminal/words.h"

#include <unistd.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <boost/version.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commit.h"
#include "oracle/libraries.h"
#include "properties/worker/plugin/judged_library.h"

namespace assay::reports {

std::string shell_word(const std::string& word) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:,+=@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  return "'" + replace(word, {{'\'', "'\\''"}}) + "'";
}

namespace {

std::string this_program(PastePlace place) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto own = fs::read_symlink("/proc/self/exe", error);
  // Python calls this code from a library of its own.
  if (error || own.filename() != "assay") return "assay";
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (place == PastePlace::any_folder && !folder.starts_with('/')) continue;
    const auto program = fs::path(folder.empty() ? "." : folder) / "assay";
    if (access(program.c_str(), X_OK) != 0 || fs::is_directory(program, error)) continue;
    if (fs::equivalent(program, own, error)) return "assay";
    break;
  }
  const auto here = own.lexically_relative(fs::current_path(error));
  const bool is_below = !error && !here.empty() && *here.begin() != "..";
  if (!is_below || place == PastePlace::any_folder) return shell_word(own.string());
  // A name alone would be looked for on the PATH.
  return shell_word((here.has_parent_path() ? here : "." / here).string());
}

// Python looks for the module of a detector in this folder, then in those of PYTHONPATH.
std::string to_this_folder(const std::string& words) {
  std::error_code error;
  const char* folders = std::getenv("PYTHONPATH");
  const bool are_told = folders && *folders && words.find("python:") != std::string::npos;
  return "cd " + shell_word(std::filesystem::current_path(error).string()) + " && " +
         (are_told ? "PYTHONPATH=" + shell_word(folders) + " " : "");
}

}  // namespace

std::string line_to_paste(const std::string& words, PastePlace place) {
  const bool has_module = words.find(" --detector python:") != std::string::npos;
  return (place == PastePlace::any_folder && has_module ? to_this_folder(words) : "") +
         this_program(place) + " " + words;
}

std::string this_command(PastePlace place) {
  const bool is_elsewhere = place == PastePlace::any_folder;
  std::ifstream typed("/proc/self/cmdline", std::ios::binary);
  std::string word, words;
  std::getline(typed, word, '\0');  // the program
  while (std::getline(typed, word, '\0')) {
    const auto name = word.substr(0, word.find('='));
    if (is_elsewhere && (name == "--keep" || name == "--json" || name == "--junit")) {
      if (name == word) std::getline(typed, word, '\0');
    } else {
      words += (words.empty() ? "" : " ") + shell_word(word);
    }
  }
  return (is_elsewhere ? to_this_folder(words) : "") + this_program(place) + " " + words;
}

std::string absolute_path(const std::filesystem::path& path) {
  if (path.empty() || properties::names_python(path.string())) return path.string();
  std::error_code error;
  const auto absolute = std::filesystem::absolute(path, error);
  return error ? path.string() : absolute.lexically_normal().string();
}

std::string replace(std::string_view text, const std::map<char, std::string_view>& characters) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    const auto place = characters.find(c);
    place == characters.end() ? out += c : out += place->second;
  }
  return out;
}

std::string xml_escaped(const std::string& text) {
  static const std::map<char, std::string_view> replacements = [] {
    std::map<char, std::string_view> all = {
        {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
    for (char control = 0; control < ' '; ++control) {
      if (control != '\n' && control != '\t') all[control] = "?";
    }
    return all;
  }();
  return replace(text, replacements);
}

std::string junit_suite(const std::string& suite, const std::string& class_name,
                        const std::vector<JunitTest>& tests, const std::string& output) {
  if (tests.empty()) return "";
  std::string text;
  std::map<std::string, int> counts;  // by element
  for (const auto& [name, element, why] : tests) {
    ++counts[element];
    text += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", xml_escaped(class_name),
                        xml_escaped(name));
    text += element.empty()
                ? "/>\n"
                : fmt::format(">\n      <{0} message=\"{1}\">{2}</{0}>\n    </testcase>\n", element,
                              xml_escaped(why.substr(0, why.find('\n'))), xml_escaped(why));
  }
  if (!output.empty())
    text += fmt::format("    <system-out>{}</system-out>\n", xml_escaped(output));
  const int errors = counts["error"];
  return fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\"{} skipped=\"{}\">\n{}  "
      "</testsuite>\n",
      xml_escaped(suite), tests.size(), counts["failure"],
      errors == 0 ? "" : fmt::format(" errors=\"{}\"", errors), counts["skipped"], text);
}

std::string commit_text() { return ASSAY_COMMIT; }

std::string version_text() {
  return fmt::format(
      "assay {} ({}, Eigen {}.{}.{}, Boost {}.{}.{}, nlohmann-json {}.{}.{}, fmt {}.{}.{}, CLI11 "
      "{})",
      ASSAY_VERSION, oracle::library_versions(), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
      EIGEN_MINOR_VERSION, BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100,
      NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH,
      FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, CLI11_VERSION);
}

}  // namespace assay::reports
