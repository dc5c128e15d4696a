#include "corpus/formats/sequences.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/outcome/try.hpp>
#include <cstdint>
#include <new>

#include "corpus/files.h"

namespace assay::corpus {

namespace {

std::string shown(const detector::Triangles& triangles, Eigen::Index t) {
  return fmt::format("({}, {}, {})", triangles(t, 0), triangles(t, 1), triangles(t, 2));
}

}  // namespace

Problem SequenceReader::other_mesh(std::string_view how) const {
  return problem_in(files_[next_],
                    fmt::format("{}: not the same mesh; two meshes need --body {} --body {}", how,
                                files_[0].string(), files_[next_].string()));
}

Expected<detector::Positions> SequenceReader::next() {
  const std::filesystem::path& file = files_[next_];
  BOOST_OUTCOME_TRY(mesh, read_mesh(file));
  if (next_ == 0) {
    triangles_ = std::move(mesh.triangles);
    vertices_ = mesh.positions.rows();
    remarks_ = std::move(mesh.remarks);
  } else if (mesh.positions.rows() != vertices_) {
    return other_mesh(fmt::format("{} vertices, but {} has {}", mesh.positions.rows(),
                                  files_[0].string(), vertices_));
  } else if (mesh.triangles.rows() != triangles_.rows()) {
    return other_mesh(fmt::format("{} triangles, but {} has {}", mesh.triangles.rows(),
                                  files_[0].string(), triangles_.rows()));
  } else if (mesh.triangles != triangles_) {
    Eigen::Index t = 0;
    while (mesh.triangles.row(t) == triangles_.row(t)) ++t;
    return other_mesh(fmt::format("triangle {} is {}, but {} has {}", t, shown(mesh.triangles, t),
                                  files_[0].string(), shown(triangles_, t)));
  }
  ++next_;
  return std::move(mesh.positions);
}

Expected<void> SequenceReader::look_ahead() const {
  for (std::size_t frame = next_; frame < files_.size(); ++frame) {
    BOOST_OUTCOME_TRYV(look_at_mesh(files_[frame]));
  }
  return boost::outcome_v2::success();
}

Expected<Sequence> read_sequence(std::span<const std::filesystem::path> paths) {
  if (paths.empty()) return problem_in({}, "no mesh file is given");
  auto ordered = in_order_of_numbers({paths.begin(), paths.end()});
  SequenceReader reader(std::move(ordered.files));
  std::vector<detector::Positions> frames;
  while (!reader.at_end()) {
    BOOST_OUTCOME_TRY(frame, reader.next());
    frames.push_back(std::move(frame));
  }
  for (const auto& line : reader.remarks()) ordered.remarks.push_back(line);
  return Sequence{reader.triangles(), std::move(frames), std::move(ordered.remarks)};
}

BodiesReader::BodiesReader(std::vector<std::vector<std::filesystem::path>> bodies) {
  for (auto& files : bodies) {
    first_files_.push_back(files.front());
    readers_.emplace_back(std::move(files));
  }
  now_.resize(readers_.size());
}

std::size_t BodiesReader::frames() const {
  std::size_t most = 0;
  for (const auto& reader : readers_) most = std::max(most, reader.frames());
  return most;
}

Expected<void> BodiesReader::fit() const {
  for (std::size_t b = 0; b < readers_.size(); ++b) {
    const std::size_t count = readers_[b].frames();
    if (count == 1 || count == frames()) continue;
    return problem_in(first_files_[b],
                      fmt::format("{} frames of body {}, but another body has {} frames (a body of "
                                  "one frame stands still)",
                                  count, b, frames()));
  }
  return boost::outcome_v2::success();
}

Expected<detector::Positions> BodiesReader::next() {
  Eigen::Index vertices = 0;
  for (std::size_t b = 0; b < readers_.size(); ++b) {
    if (!readers_[b].at_end()) {
      BOOST_OUTCOME_TRY(x, readers_[b].next());
      now_[b] = std::move(x);
    }
    vertices += now_[b].rows();
  }
  if (read_++ == 0) join_triangles();
  if (now_.size() == 1) return std::move(now_[0]);
  detector::Positions all(vertices, 3);
  Eigen::Index first = 0;
  for (const auto& x : now_) {
    all.middleRows(first, x.rows()) = x;
    first += x.rows();
  }
  return all;
}

void BodiesReader::join_triangles() {
  Eigen::Index count = 0;
  for (const auto& reader : readers_) count += reader.triangles().rows();
  triangles_.resize(count, 3);
  Eigen::Index first = 0;
  std::int32_t vertices = 0;
  for (std::size_t b = 0; b < readers_.size(); ++b) {
    const auto& own = readers_[b].triangles();
    triangles_.middleRows(first, own.rows()) = own.array() + vertices;
    first += own.rows();
    vertices += static_cast<std::int32_t>(now_[b].rows());
  }
}

Expected<void> BodiesReader::look_ahead() const {
  for (const auto& reader : readers_) {
    BOOST_OUTCOME_TRYV(reader.look_ahead());
  }
  return boost::outcome_v2::success();
}

std::vector<std::int32_t> BodiesReader::bodies() const {
  std::vector<std::int32_t> list;
  for (std::size_t b = 0; b < readers_.size(); ++b)
    list.insert(list.end(), readers_[b].vertices(), static_cast<std::int32_t>(b));
  return list;
}

std::vector<std::string> BodiesReader::remarks() const {
  std::vector<std::string> lines;
  for (std::size_t b = 0; b < readers_.size(); ++b) {
    const auto file = readers_.size() > 1 ? first_files_[b] : std::filesystem::path();
    for (const auto& line : readers_[b].remarks()) lines.push_back(problem_in(file, line).message);
  }
  return lines;
}

DoubledCorners::DoubledCorners(const detector::Triangles& triangles,
                               const std::vector<std::int32_t>& body)
    : first_(body.size(), -1) {
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    const auto v = static_cast<std::size_t>(triangles.data()[i]);
    first_[v] = body[v];
  }
}

void DoubledCorners::add(const detector::Positions& x) {
  // A table of places, open addressing, at most half full.
  const std::size_t size = std::bit_ceil(2 * first_.size() + 1);
  std::vector<std::int32_t> table(size, -1), next(first_.size(), -1);
  for (std::size_t v = 0; v < first_.size(); ++v) {
    if (first_[v] < 0) continue;
    const auto place = x.row(static_cast<Eigen::Index>(v));
    auto hash = static_cast<std::uint64_t>(first_[v]);
    for (const double c : {place[0], place[1], place[2]}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9E3779B97F4A7C15;  // -0 becomes 0
      hash ^= hash >> 32;
    }
    for (std::size_t slot = hash & (size - 1);; slot = (slot + 1) & (size - 1)) {
      auto& u = table[slot];
      if (u < 0) u = static_cast<std::int32_t>(v);
      if (first_[static_cast<std::size_t>(u)] != first_[v] || x.row(u) != place) continue;
      next[v] = u;
      break;
    }
  }
  first_ = std::move(next);
}

std::string DoubledCorners::remark(bool is_welded) const {
  std::vector<std::uint8_t> is_shared(first_.size(), 0);
  std::size_t vertices = 0;
  for (std::size_t v = 0; v < first_.size(); ++v) {
    if (first_[v] < 0 || first_[v] == static_cast<std::int32_t>(v)) continue;
    is_shared[static_cast<std::size_t>(first_[v])] = 1;
    ++vertices;
  }
  const auto places = static_cast<std::size_t>(std::ranges::count(is_shared, 1));
  if (places == 0) return "";
  const auto counts = fmt::format("{} vertices are at {} place{}", vertices + places, places,
                                  places == 1 ? "" : "s");
  return is_welded ? fmt::format(
                         "welded: {} and count as {} vertices; where sheets rest on each other, "
                         "their vertices are welded, too",
                         counts, places)
                   : counts +
                         ": neighbouring triangles share none, so they touch; --weld "
                         "makes one vertex of all vertices at a place";
}

detector::Triangles DoubledCorners::welded(detector::Triangles triangles) const {
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    auto& v = triangles.data()[i];
    v = first_[static_cast<std::size_t>(v)];
  }
  return triangles;
}

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
