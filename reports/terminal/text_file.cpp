#include "reports/terminal/text_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <boost/outcome/try.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "corpus/atomic_file.h"

namespace assay::reports {

using Json = nlohmann::ordered_json;

Expected<void> may_write(const std::string& path, const std::vector<std::string>& inputs) {
  namespace fs = std::filesystem;
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
  const fs::path parent = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : ".";
  if (!fs::is_directory(parent, ignored)) return Problem{path + ": its folder does not exist"};
  // A file is opened as a test, because some folders and names take no file whatever their
  // permissions say.
  const std::string probe = path + ".probe";
  const int file = open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return Problem{path + ": cannot be written: " + std::strerror(errno)};
  close(file);
  fs::remove(probe, ignored);
  return outcome::success();
}

Expected<void> write_text_file(const std::string& path, const std::string& text) {
  // If the path is a symbolic link, the file behind it is written.
  std::error_code ignored;
  const auto target = std::filesystem::is_symlink(path, ignored)
                          ? std::filesystem::canonical(path, ignored)
                          : std::filesystem::path(path);
  BOOST_OUTCOME_TRY(corpus::write_file_atomically(target, text));
  return outcome::success();
}

Expected<void> write_json_file(const std::string& path, const Json& json) {
  return write_text_file(path, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace assay::reports
