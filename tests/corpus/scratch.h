// Files that a test makes and leaves no trace of.
#pragma once

#include <unistd.h>
#include <zlib.h>

#include "corpus/formats/mesh_reader.h"
#include "corpus/problem.h"
#include "tests/meshes.h"
#include "tests/problem_words.h"

namespace assay::corpus {

// A folder of its own for every test.
class Scratch : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("assay_corpus_") + test->test_suite_name() + "_" + test->name() + "_" +
               std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }

  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
  }

  // Returns the result of reading `bytes` as a mesh, which should be a problem.
  Expected<Mesh> mesh_problem(const std::string& name, std::string_view bytes) const {
    return read_mesh(write(name, bytes));
  }

  // Expects a problem of one line that says these words and names the file and the place.
  void expect_mesh_problem(const std::string& name, std::string_view bytes, std::string_view words,
                           std::string_view place) const {
    const auto mesh = mesh_problem(name, bytes);
    ASSERT_FALSE(mesh) << bytes;
    for (const auto said : {words, place, std::string_view(name)})
      EXPECT_TRUE(says(mesh, said)) << bytes;
    EXPECT_FALSE(says(mesh.error(), "\n"));
  }

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

inline std::string bytes_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::string gzip(std::string_view plain) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, plain.size()) + 64, '\0');
  std::string input(plain);
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

// Returns the bytes of a number in a binary PLY file.
template <class T>
std::string bytes_of(T value, bool big_endian) {
  std::string bytes(sizeof(T), '\0');
  static_assert(std::is_trivially_copyable_v<T>);
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian) bytes = std::string(bytes.rbegin(), bytes.rend());
  return bytes;
}

// A tetrahedron in each text format.
inline constexpr std::string_view obj_tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
inline constexpr std::string_view off_tetrahedron =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
inline constexpr std::string_view ply_tetrahedron =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
    "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

// Expects these triangles, written as "0 1 2, 0 2 3".
inline void expect_triangles(const Expected<Mesh>& mesh, const std::string& triangles) {
  EXPECT_EQ(value_of(mesh).triangles, tests::triangles_of(triangles));
}

inline void expect_tetrahedron(const Expected<Mesh>& mesh) {
  expect_triangles(mesh, "0 2 1, 0 1 3, 1 2 3, 2 0 3");
  EXPECT_EQ(value_of(mesh).positions, tests::positions_of("0 0 0, 1 0 0, 0 1 0, 0 0 1"));
}

}  // namespace assay::corpus
