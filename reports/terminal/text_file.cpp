#include "reports/terminal/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/files.h"

namespace assay::reports {

using Json = nlohmann::ordered_json;

namespace fs = std::filesystem;

namespace {

// If the path is a symbolic link, the file behind it is written.
fs::path target_of(const std::string& path) {
  std::error_code error;
  const auto target = fs::weakly_canonical(path, error);
  return fs::is_symlink(path, error) && !target.empty() ? target : fs::path(path);
}

// Makes a file of a new name as a test, because some folders and names take no file whatever their
// permissions say.
Expected<void> make_probe(const std::string& path, std::string probe) {
  const int file = mkostemp(probe.data(), O_CLOEXEC);
  if (file < 0) return Problem{path + ": cannot be written: " + std::strerror(errno)};
  close(file);
  unlink(probe.c_str());
  return outcome::success();
}

Expected<void> may_write_one(const std::string& path, const std::vector<std::string>& inputs) {
  if (path.empty()) return outcome::success();
  // Elsewhere it stands for standard output, where this would be mixed with the text.
  if (path == "-") return Problem{"-: name a file; standard output is for the text"};
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return Problem{path + ": is a directory"};
  if (fs::exists(path, ignored)) {
    if (!fs::is_regular_file(path, ignored)) return Problem{path + ": is not a regular file"};
    for (const auto& input : inputs) {
      if (fs::equivalent(path, input, ignored)) return Problem{path + ": is an input too"};
    }
    if (access(path.c_str(), W_OK) != 0) return Problem{path + ": no permission to write it"};
  }
  const auto target = target_of(path);
  const auto parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(parent, ignored)) return Problem{path + ": its folder does not exist"};
  return make_probe(path, target.string() + ".XXXXXX");
}

}  // namespace

Expected<void> may_write(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& inputs) {
  std::set<fs::path> files;
  for (const auto& output : outputs) {
    BOOST_OUTCOME_TRY(may_write_one(output, inputs));
    std::error_code ignored;
    if (!output.empty() && !files.insert(fs::weakly_canonical(output, ignored)).second)
      return Problem{output + ": two outputs are this one file"};
  }
  return outcome::success();
}

Expected<void> may_fill(const std::string& folder, const std::vector<std::string>& files) {
  if (folder.empty()) return outcome::success();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Problem{fmt::format("{}: cannot be made: {}", folder, error.message())};
  BOOST_OUTCOME_TRY(make_probe(folder, fs::path(folder) / "probe-XXXXXX"));
  for (const auto& file : files) {
    BOOST_OUTCOME_TRY(may_write({fs::path(folder) / file}));
  }
  return outcome::success();
}

Expected<void> write_text_file(const std::string& path, const std::string& text) {
  BOOST_OUTCOME_TRY(corpus::write_file_atomically(target_of(path), text));
  return outcome::success();
}

Expected<void> write_json_file(const std::string& path, const Json& json) {
  return write_text_file(path, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace assay::reports
