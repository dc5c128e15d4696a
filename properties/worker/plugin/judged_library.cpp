#include "properties/worker/plugin/judged_library.h"

#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>

#include "corpus/digest.h"

namespace assay::properties {

namespace {

namespace fs = std::filesystem;

corpus::Problem no_file(const std::string& reason) { return {reason}; }

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
    : files_{{word, {}}}, digest_(no_file("")) {
  std::error_code error;
  if (!names_python(word.string())) {
    // Reading a pipe would wait for its writer.
    if (!fs::is_regular_file(word, error)) {
      digest_ = no_file(fs::exists(word, error) ? "not a file" : "no such file");
      return;
    }
    std::vector<fs::path> files = {word};
    const auto dependencies = needed_files(word);
    files.insert(files.end(), dependencies.begin(), dependencies.end());
    take(files);
    return;
  }
  const auto serving = python_plugin(word.string(), worker);
  const auto module = python_module_files(word.string());
  if (serving && module) {
    std::vector<fs::path> files = {serving.value()};
    files.insert(files.end(), module.value().begin(), module.value().end());
    take(files);
    return;
  }
  if (serving) files_.front().path = serving.value();
  digest_ = no_file((serving ? module.error() : serving.error()).message);
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

using Strings = std::vector<std::string>;

// The bytes of a file that may be no library, so every place in it is checked.
class Image {
 public:
  explicit Image(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
  }
  template <class T>
  std::optional<T> at(std::uint64_t offset) const {
    T item;
    if (offset > bytes_.size() || sizeof item > bytes_.size() - offset) return std::nullopt;
    std::memcpy(&item, bytes_.data() + offset, sizeof item);
    return item;
  }
  std::string text_at(std::uint64_t offset) const {
    const auto end = offset < bytes_.size() ? bytes_.find('\0', offset) : std::string::npos;
    return end == std::string::npos ? "" : bytes_.substr(offset, end - offset);
  }

 private:
  std::string bytes_;
};

struct Needs {
  Strings names, rpath, runpath;
};

// Splits at colons, and puts the folder in the place of $ORIGIN.
Strings folders_of(const std::string& text, const std::string& origin) {
  Strings folders = parts_of(text, ':');
  for (auto& folder : folders) {
    for (const std::string word : {"${ORIGIN}", "$ORIGIN"}) {
      for (auto at = folder.find(word); at != std::string::npos; at = folder.find(word))
        folder.replace(at, word.size(), origin);
    }
  }
  std::erase(folders, "");
  return folders;
}

Needs needs_of(const fs::path& file) {
  Needs needs;
  const Image image(file);
  const auto head = image.at<ElfW(Ehdr)>(0);
  constexpr unsigned char own_class = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (!head || std::memcmp(head->e_ident, ELFMAG, SELFMAG) != 0 ||
      head->e_ident[EI_CLASS] != own_class)
    return needs;
  std::vector<ElfW(Phdr)> parts;
  for (std::uint64_t i = 0; i < head->e_phnum; ++i) {
    if (const auto part = image.at<ElfW(Phdr)>(head->e_phoff + i * sizeof(ElfW(Phdr))))
      parts.push_back(*part);
  }
  std::vector<ElfW(Dyn)> entries;
  for (const auto& part : parts) {
    for (std::uint64_t at = 0; part.p_type == PT_DYNAMIC && at < part.p_filesz;
         at += sizeof(ElfW(Dyn))) {
      if (const auto entry = image.at<ElfW(Dyn)>(part.p_offset + at)) entries.push_back(*entry);
    }
  }
  // The table of texts is given by its address in memory.
  std::uint64_t texts = 0;
  for (const auto& entry : entries) {
    for (const auto& part : parts) {
      const auto address = entry.d_un.d_ptr;
      if (entry.d_tag == DT_STRTAB && part.p_type == PT_LOAD && part.p_vaddr <= address &&
          address - part.p_vaddr < part.p_filesz)
        texts = part.p_offset + (address - part.p_vaddr);
    }
  }
  const std::string origin = file.parent_path().string();
  for (const auto& entry : entries) {
    const auto text = image.text_at(texts + entry.d_un.d_val);
    if (entry.d_tag == DT_NEEDED) needs.names.push_back(text);
    if (entry.d_tag == DT_RPATH) needs.rpath = folders_of(text, origin);
    if (entry.d_tag == DT_RUNPATH) needs.runpath = folders_of(text, origin);
  }
  return needs;
}

bool is_of_the_system(const fs::path& file) {
  constexpr const char* folders[] = {"/lib/", "/lib32/", "/lib64/", "/usr/lib"};
  return std::ranges::any_of(folders,
                             [&](const char* folder) { return file.string().starts_with(folder); });
}

// Finds a library in the order of the loader.
std::optional<fs::path> find(const std::string& name, const Needs& needs,
                             const Strings& inherited) {
  Strings folders;
  const auto append = [&](const Strings& more) {
    folders.insert(folders.end(), more.begin(), more.end());
  };
  if (needs.runpath.empty()) append(needs.rpath), append(inherited);
  if (const char* more = std::getenv("LD_LIBRARY_PATH")) append(folders_of(more, ""));
  append(needs.runpath);
  std::error_code ignored;
  if (name.find('/') != std::string::npos) folders = {"."};  // a path, and no search
  for (const auto& folder : folders) {
    auto file = fs::path(folder) / name;
    if (fs::is_regular_file(file, ignored)) return file;
  }
  return std::nullopt;
}

void add_needed(const fs::path& file, const Strings& inherited, std::vector<fs::path>& files) {
  const Needs needs = needs_of(file);
  Strings handed_on = inherited;
  if (needs.runpath.empty())
    handed_on.insert(handed_on.begin(), needs.rpath.begin(), needs.rpath.end());
  for (const auto& name : needs.names) {
    const auto dependency = find(name, needs, inherited);
    std::error_code ignored;
    if (!dependency || is_of_the_system(fs::canonical(*dependency, ignored)) ||
        std::ranges::find(files, *dependency) != files.end())
      continue;
    files.push_back(*dependency);
    add_needed(*dependency, handed_on, files);
  }
}

}  // namespace

std::vector<fs::path> needed_files(const fs::path& library) {
  std::vector<fs::path> files;
  add_needed(library, {}, files);
  return files;
}

}  // namespace assay::properties
