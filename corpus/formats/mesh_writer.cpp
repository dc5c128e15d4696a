#include "corpus/formats/mesh_writer.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <boost/outcome/try.hpp>
#include <new>
#include <string>

#include "corpus/files.h"

namespace assay::corpus {
namespace {

template <class Bits>
void append_little_endian(std::string& bytes, Bits value) {
  for (std::size_t i = 0; i < sizeof(Bits); ++i) {
    bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
  }
}

std::string ply_bytes(const detector::PositionsView& positions,
                      const detector::TrianglesView& triangles,
                      const std::vector<std::uint8_t>* marked) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\n"
      "property double y\nproperty double z\nelement face {}\n"
      "property list uchar int vertex_indices\n{}end_header\n",
      positions.rows(), triangles.rows(),
      marked ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
  constexpr std::size_t vertex_size = 3 * sizeof(double), face_size = 1 + 3 * sizeof(std::int32_t);
  bytes.reserve(bytes.size() + static_cast<std::size_t>(positions.rows()) * vertex_size +
                static_cast<std::size_t>(triangles.rows()) * face_size);
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      append_little_endian(bytes, std::bit_cast<std::uint64_t>(positions(i, k)));
    }
  }
  for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
    bytes.push_back(3);
    for (Eigen::Index k = 0; k < 3; ++k) {
      append_little_endian(bytes, static_cast<std::uint32_t>(triangles(i, k)));
    }
    constexpr std::array<const char*, 3> colours = {"\xc8\xc8\xc8", "\xdc\x28\x28", "\xf0\xb4\x28"};
    if (marked) bytes += colours[(*marked)[static_cast<std::size_t>(i)]];
  }
  return bytes;
}

}  // namespace

Expected<void> write_mesh(const std::filesystem::path& path,
                          const detector::PositionsView& positions,
                          const detector::TrianglesView& triangles,
                          const std::vector<std::uint8_t>* marked) try {
  return write_file_atomically(path, ply_bytes(positions, triangles, marked));
} catch (const std::bad_alloc&) {
  return problem_in(path, "larger than the memory at hand");
}

Expected<std::vector<std::filesystem::path>> write_sequence(const std::filesystem::path& folder,
                                                            const Sequence& sequence) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return problem_in(folder, "cannot be made: " + error.message());
  }
  std::vector<std::filesystem::path> paths;
  for (const detector::Positions& frame : sequence.frames) {
    paths.push_back(folder / fmt::format("frame_{:04}.ply", paths.size()));
    BOOST_OUTCOME_TRY(write_mesh(paths.back(), frame, sequence.triangles));
  }
  return paths;
}

}  // namespace assay::corpus
