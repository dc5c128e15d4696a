#include "properties/worker/plugin/judged_library.h"

#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>

#include "corpus/digest.h"
#include "properties/worker/child_process.h"
#include "properties/worker/isolation.h"

namespace assay::properties {

namespace {

namespace fs = std::filesystem;

}  // namespace

std::shared_ptr<const JudgedLibrary> JudgedLibrary::of(const fs::path& word,
                                                       const fs::path& worker) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const JudgedLibrary>> libraries;
  std::error_code ignored;
  const bool is_word = names_python(word.string());
  const std::lock_guard lock(mutex);
  auto& entry = libraries[is_word ? word.string() : fs::absolute(word, ignored).string()];
  auto library = entry.lock();
  if (!library) {
    library.reset(new JudgedLibrary(word, worker));
    entry = library;
  }
  return library;
}

JudgedLibrary::JudgedLibrary(const fs::path& word, const fs::path& worker)
    : files_{{word, {}}}, digest_(Problem{""}) {
  std::error_code error;
  const bool is_python = names_python(word.string());
  // Reading a pipe would wait for its writer.
  if (!is_python && !fs::is_regular_file(word, error)) {
    digest_ = Problem{fs::exists(word, error) ? "not a file" : "no such file"};
    return;
  }
  const auto library = is_python ? python_plugin(word.string(), worker) : Expected<fs::path>(word);
  auto files = is_python ? python_module_files(word.string()) : needed_files(word);
  if (library) files_.front().path = library.value();
  if (library && files) {
    files.value().insert(files.value().begin(), library.value());
    take(files.value());
  } else {
    digest_ = library ? files.error() : library.error();
  }
}

void JudgedLibrary::take(const std::vector<fs::path>& files) {
  std::error_code error;
  files_.clear();
  std::string digests;
  for (const auto& file : files) {
    const auto digest = corpus::sha256_of_file(file);
    files_.push_back({fs::absolute(file, error), digest ? digest.value() : ""});
    if (!digest) {
      digest_ = digest.error();
      continue;
    }
    digests += digest.value();
    digest_ = files.size() == 1 ? digests : corpus::sha256_of(digests);
  }
}

Expected<void> JudgedLibrary::is_as_it_was() const {
  for (const auto& file : files_) {
    const auto now = corpus::sha256_of_file(file.path);
    if (file.digest.empty() || (now && now.value() == file.digest)) continue;
    return Problem{fmt::format("{}: it changed while it was judged; start again in another folder",
                               file.path.string())};
  }
  return boost::outcome_v2::success();
}

namespace {

// Returns the file of the system's loader, which loaded this program and its libraries.
fs::path loader() {
  for (const auto* object = ::_r_debug.r_map; object; object = object->l_next) {
    if (object->l_addr == ::_r_debug.r_ldbase) return object->l_name;
  }
  return "";
}

bool is_of_the_system(const fs::path& file) {
  constexpr const char* folders[] = {"/lib/", "/lib32/", "/lib64/", "/usr/lib"};
  return std::ranges::any_of(folders,
                             [&](const char* folder) { return file.string().starts_with(folder); });
}

}  // namespace

Expected<std::vector<fs::path>> needed_files(const fs::path& library) {
  std::vector<fs::path> files;
  const auto problem = [](const std::string& reason) {
    return Problem{"the libraries that it needs cannot be listed: " + reason};
  };
  const auto output = PrintedFile::make();
  if (!output) return problem(std::strerror(errno));
  std::error_code ignored;
  auto listing = ChildProcess::start(
      loader(), {"--list", fs::absolute(library, ignored).string()},
      {{output->descriptor(), STDOUT_FILENO}, {output->descriptor(), STDERR_FILENO}});
  if (!listing) return problem(listing.error().message);
  constexpr std::chrono::seconds most{60};
  if (listing.value().finish(most).by_host)
    return problem(fmt::format("the loader took more than {} s", most.count()));
  // A line is "\tbeside.so => /home/me/beside.so (0x00007f2d12929000)", without "=>" for a library
  // that is needed by its path.
  std::ifstream lines(fmt::format("/proc/self/fd/{}", output->descriptor()));
  for (std::string line; std::getline(lines, line);) {
    const auto end = line.rfind(" (0x"), arrow = line.find(" => ");
    if (end == std::string::npos) continue;
    const auto begin = arrow == std::string::npos ? 1 : arrow + 4;
    const fs::path file = line.substr(begin, end - begin);
    if (file.has_parent_path() && fs::is_regular_file(file, ignored) &&
        !is_of_the_system(fs::canonical(file, ignored)))
      files.push_back(file);
  }
  return files;
}

}  // namespace assay::properties
