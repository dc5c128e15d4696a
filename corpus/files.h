// Reads and writes whole files. Reading decompresses a gzip stream. Writing replaces a file as a
// whole or leaves it unchanged.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "corpus/problem.h"

namespace assay::corpus {

// The largest accepted size of a file after decompression, in bytes. There is a limit because a few
// hundred bytes of gzip can grow to any size. 2^32 bytes hold a mesh of some 30 million vertices in
// text.
inline constexpr std::size_t largest_file = std::size_t{1} << 32;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

// Reads the whole file. Refuses a path that cannot be opened, a folder, an empty file, a damaged
// gzip stream, and content larger than `limit`. A gzip stream without content counts as an empty
// file.
Expected<std::string> read_bytes(const std::filesystem::path& path,
                                 std::size_t limit = largest_file);

// Reads the first `count` bytes of the content, or all bytes if there are fewer. The cost does not
// depend on the size of the file. Refuses what read_bytes refuses, if the start of the file shows
// the reason. From a gzip stream it reads the first `count` bytes and 256 KiB more. If the stream
// goes on after this part, and the part is damaged or decompresses to fewer than `count` bytes, the
// function returns an empty text.
Expected<std::string> read_start(const std::filesystem::path& path, std::size_t count);

// Writes PATH.part beside `path` and then renames it, so a reader sees the old file or the whole
// new one. Several writers of the same file write one after another. On failure, the problem states
// the system's reason, and PATH.part is removed. If a writer is killed, its PATH.part stays, and
// the next writer uses that file. REQUIRES a file system that locks files (flock).
Expected<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace assay::corpus
