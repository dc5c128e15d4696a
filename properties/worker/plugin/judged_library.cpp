#include "properties/worker/plugin/judged_library.h"

#include <fmt/format.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "corpus/digest.h"
#include "properties/worker/plugin/needed_files.h"
#include "properties/worker/plugin/python_word.h"

namespace assay::properties {
namespace {

namespace fs = std::filesystem;

// Some systems run nothing from their folder of temporary files.
bool may_hold_programs(const fs::path& folder) {
  struct statvfs seen;
  return ::statvfs(folder.c_str(), &seen) == 0 && (seen.f_flag & ST_NOEXEC) == 0;
}

corpus::Problem no_file(const std::string& reason) { return {reason}; }

}  // namespace

std::shared_ptr<const JudgedLibrary> JudgedLibrary::of(const fs::path& named,
                                                       const fs::path& worker) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const JudgedLibrary>> kept;
  std::error_code ignored;
  const bool is_word = names_python(named.string());
  const std::lock_guard lock(mutex);
  auto& known = kept[is_word ? named.string() : fs::absolute(named, ignored).string()];
  auto library = known.lock();
  if (!library) {
    library.reset(new JudgedLibrary(named, worker));
    known = library;
  }
  return library;
}

JudgedLibrary::JudgedLibrary(const fs::path& named, const fs::path& worker)
    : files_{{named, {}, {}}}, digest_(no_file("")) {
  std::error_code error;
  if (!names_python(named.string())) {
    // Reading a pipe would wait for its writer.
    if (!fs::is_regular_file(named, error)) {
      digest_ = no_file(fs::exists(named, error) ? "not a file" : "no such file");
      return;
    }
    std::vector<fs::path> files = {named};
    const auto needed = needed_files(named);
    files.insert(files.end(), needed.begin(), needed.end());
    take(files);
    return;
  }
  const auto serving = python_plugin(named.string(), worker);
  const auto module = python_module_files(named.string());
  if (serving && module) {
    std::vector<fs::path> files = {serving.value()};
    files.insert(files.end(), module.value().begin(), module.value().end());
    take(files);
    return;
  }
  if (serving) files_.front().original = serving.value();
  digest_ = no_file((serving ? module.error() : serving.error()).message);
}

void JudgedLibrary::take(const std::vector<fs::path>& files) {
  std::error_code error;
  const bool are_files = std::all_of(files.begin(), files.end(), [&](const fs::path& file) {
    return fs::is_regular_file(file, error);
  });
  if (auto made = ScratchFolder::make();
      are_files && made && may_hold_programs(made.value().path()))
    folder_ = std::move(made.value());
  files_.clear();
  std::string digests;
  for (const auto& original : files) {
    File file{fs::absolute(original, error), {}, {}};
    if (folder_) {
      const auto copy = folder_->path() / std::to_string(files_.size());
      if (fs::copy_file(original, copy, error)) file.copy = copy;
    }
    const auto digest = corpus::sha256_of_file(file.copy.empty() ? original : file.copy);
    files_.push_back(std::move(file));
    if (!digest) {
      digest_ = digest.error();
      continue;
    }
    files_.back().digest = digest.value();
    digests += digest.value();
    digest_ = files.size() == 1 ? digests : corpus::sha256_of(digests);
  }
}

Expected<void> JudgedLibrary::is_as_it_was() const {
  if (!is_loaded_in_place_) return boost::outcome_v2::success();
  for (const auto& file : files_) {
    const auto now = corpus::sha256_of_file(file.original);
    if (file.digest.empty() || (now && now.value() == file.digest)) continue;
    return Problem{fmt::format("{}: it changed while it was judged; start again in another folder",
                               file.original.string())};
  }
  return boost::outcome_v2::success();
}

}  // namespace assay::properties
