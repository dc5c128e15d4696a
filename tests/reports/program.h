// Runs the program as a user does and keeps what it prints.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "tests/reports/json_schema.h"
#include "tests/test.h"

namespace assay::tests {

// A folder of its own for each test process, removed at the end.
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

// A folder in memory if there is one: hundreds of stores need not wait for a disk. A plug-in under
// isolation sees nothing of it.
inline std::filesystem::path folder_in_memory() {
  const std::filesystem::path shared = "/dev/shm";
  return access(shared.c_str(), W_OK) == 0 ? shared : std::filesystem::temp_directory_path();
}

// The file of a case of corpus/curated.
inline std::string curated(const std::string& name) {
  return std::string(ASSAY_SOURCE_DIR) + "/corpus/curated/" + name + ".json";
}

inline std::string read_text(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

// What a test lets the program write with --json is held to its schema, whatever the test is about.
inline void expect_json_of_schema(const std::string& arguments) {
  std::smatch match;
  if (!std::regex_search(arguments, match, std::regex("--json[ =]'?([^ ']+)"))) return;
  const auto json = SchemaJson::parse(read_text(match[1]), nullptr, false);
  // The program refuses some files that tests name.
  if (!json.is_object()) return;
  const auto schema = json.value("schema", std::string("assay-none/0"));
  const auto name = schema.substr(schema.find('-') + 1);
  expect_schema(name.substr(0, name.find('/')), json);
}

// `prefix`: a command that runs the program, such as one that gives up rights.
inline Outcome run_assay(const std::string& arguments, const std::string& prefix = "") {
  const Scratch scratch;
  const std::string command = prefix + ASSAY_PROGRAM + " " + arguments + " >" + (scratch / "out") +
                              " 2>" + (scratch / "err") + " </dev/null";
  const int status = std::system(command.c_str());
  expect_json_of_schema(arguments);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(scratch / "out"),
          read_text(scratch / "err")};
}

}  // namespace assay::tests
