// Runs the program as a user does, and returns its output.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include "tests/problem_words.h"
#include "tests/reports/json_schema.h"

namespace assay::tests {

// A temporary folder, which is removed at the end of its scope.
class Scratch {
 public:
  Scratch() : Scratch(std::filesystem::temp_directory_path()) {}
  explicit Scratch(const std::filesystem::path& where) {
    std::string name = (where / "assay-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::string operator/(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return *this / name;
  }

 private:
  std::filesystem::path folder_;
};

// Returns a folder in memory if there is one, so that tests with hundreds of stores need not wait
// for a disk. An isolated plug-in does not see this folder.
inline std::filesystem::path folder_in_memory() {
  const std::filesystem::path shared = "/dev/shm";
  return access(shared.c_str(), W_OK) == 0 ? shared : std::filesystem::temp_directory_path();
}

inline std::string plugin(const std::string& name) {
  return std::string(ASSAY_PLUGIN_DIR) + "/plugin_" + name + ".so";
}

// Returns the path of a case of corpus/curated.
inline std::string curated(const std::string& name) {
  return std::string(ASSAY_SOURCE_DIR) + "/corpus/curated/" + name + ".json";
}

inline std::string example_queries() { return ASSAY_SOURCE_DIR "/corpus/queries/example_vf.csv"; }

inline bool contains(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

inline std::string read_text(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline nlohmann::ordered_json read_json(const std::string& path) {
  return nlohmann::ordered_json::parse(read_text(path));
}

// Returns how often a word occurs in a text.
inline std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

// Runs a command in a shell, and returns its exit code; -1 if a signal ended it.
inline int exit_code_of(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Returns a prefix for commands by which another user runs a command if this user is root. Root has
// all rights, and the system does not count its threads.
inline std::string not_by_root() {
  return geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
}

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

// Expects that the file of --json satisfies its schema. Every test checks this for each command
// that it runs.
inline void expect_json_of_schema(const std::string& arguments) {
  std::smatch match;
  if (!std::regex_search(arguments, match, std::regex("--json[ =]'?([^ ']+)"))) return;
  const auto json = SchemaJson::parse(read_text(match[1]), nullptr, false);
  // The file can hold something else if the program refused to write it.
  if (!json.is_object()) return;
  const auto schema = json.value("schema", std::string("assay-none/0"));
  const auto name = schema.substr(schema.find('-') + 1);
  expect_schema(name.substr(0, name.find('/')), json);
}

// Runs the program. `prefix` is a command that runs another command, for example with fewer rights.
inline Outcome run_assay(const std::string& arguments, const std::string& prefix = "") {
  const Scratch scratch;
  const std::string command = prefix + ASSAY_PROGRAM + " " + arguments + " >" + (scratch / "out") +
                              " 2>" + (scratch / "err") + " </dev/null";
  const int code = exit_code_of(command);
  expect_json_of_schema(arguments);
  return {code, read_text(scratch / "out"), read_text(scratch / "err")};
}

// Expects each of these words in a text. A failure names the line of the caller.
inline void expect_says(const std::string& text, const std::vector<std::string>& words,
                        const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  const testing::ScopedTrace trace(file, line, "");
  for (const auto& word : words) EXPECT_TRUE(says(text, word));
}

// Expects this exit code, and each of these words in the output.
inline Outcome expect_ended(const Outcome& outcome, int code,
                            const std::vector<std::string>& said = {},
                            const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  const testing::ScopedTrace trace(file, line, "");
  EXPECT_EQ(outcome.exit_code, code) << outcome.out << outcome.err;
  for (const auto& words : said) EXPECT_TRUE(says(outcome.out, words)) << outcome.err;
  return outcome;
}
inline Outcome expect_ended(const std::string& arguments, int code,
                            const std::vector<std::string>& said = {},
                            const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  return expect_ended(run_assay(arguments), code, said, file, line);
}

// Makes a scene in a folder of its name, and returns its frames as an argument of `check`.
inline std::string make_scene(const Scratch& scratch, const std::string& name, int size,
                              int frames) {
  expect_ended("scene " + name + " --size " + std::to_string(size) + " --frames " +
                   std::to_string(frames) + " --out " + (scratch / name),
               0);
  return (scratch / name) + "/frame_*.ply";
}

// Expects this exit code, and a word on stderr.
inline void expect_problem(const Outcome& outcome, const std::string& word, int code = 2,
                           const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  expect_ended(outcome, code, {}, file, line);
  const testing::ScopedTrace trace(file, line, "");
  EXPECT_TRUE(says(outcome.err, word));
}

// Expects one line on stderr that contains the word.
inline void expect_one_line(const Outcome& outcome, const std::string& word = "", int code = 2,
                            const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  expect_problem(outcome, word, code, file, line);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

// Expects one line on stderr that contains the word, and nothing on stdout.
inline void expect_refused(const Outcome& outcome, const std::string& word) {
  expect_one_line(outcome, word);
  EXPECT_EQ(outcome.out, "");
}
inline void expect_refused(const std::string& arguments, const std::string& word) {
  SCOPED_TRACE(arguments);
  expect_refused(run_assay(arguments), word);
}

}  // namespace assay::tests
