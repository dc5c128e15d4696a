// Reads and writes whole files. A gzip stream is decompressed when it is read; a file is written
// whole or not at all.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "corpus/problem.h"

namespace assay::corpus {

// A file that is larger than this, or becomes larger when it is decompressed, is refused, because
// a few hundred bytes of gzip can ask for any amount of memory. Bytes; 2^32 holds a mesh of some
// 30 million vertices in text.
inline constexpr std::size_t largest_file = std::size_t{1} << 32;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

// Reads the whole file. Refuses a path that cannot be opened, a folder, an empty file, a damaged
// gzip stream, and content larger than `limit`. A gzip stream of nothing is an empty file too.
Expected<std::string> read_bytes(const std::filesystem::path& path,
                                 std::size_t limit = largest_file);

// Reads the first `count` bytes of the content, or all if there are fewer, at the same cost for a
// file of any size. Refuses what read_bytes refuses, as far as the start of the file shows it.
// Of a gzip stream it reads `count` + 256 KiB. If these are damaged, or give fewer than `count`
// bytes although more follow, it returns an empty text.
Expected<std::string> read_start(const std::filesystem::path& path, std::size_t count);

// Writes PATH.part beside `path` and then renames it, so a reader sees the old file or the whole
// new one. Several writers of the same file write one after another. If any of this fails, the
// problem states the system's reason, and nothing is left behind. The next writer takes up the file
// that a killed writer leaves beside `path`. REQUIRES a file system that locks files (flock).
Expected<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace assay::corpus
