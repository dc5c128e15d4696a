// Cuts and flips: whatever the bytes, a reader answers; it never crashes and never asks for memory
// that the file's size does not warrant. Worth running under sanitizers.
#include <vector>

#include "corpus/case_file.h"
#include "corpus/mesh_writer.h"
#include "corpus/query_csv.h"
#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

class DamagedFile : public Scratch {
 protected:
  // The file cut at every byte, and each byte flipped in several ways; `read` must return.
  template <class Read>
  void damage(const std::string& name, const std::string& good, Read read) const {
    for (std::size_t size = 0; size < good.size(); ++size) read(write(name, good.substr(0, size)));
    for (std::size_t i = 0; i < good.size(); ++i) {
      for (const int mask : {0x01, 0x10, 0x80, 0xff}) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ mask);
        read(write(name, bad));
      }
    }
  }

  static void check_mesh(const std::filesystem::path& path) {
    const auto mesh = read_mesh(path);
    if (!mesh) {
      EXPECT_FALSE(mesh.error().message.empty());
      EXPECT_EQ(mesh.error().message.find('\n'), std::string::npos);
      return;
    }
    EXPECT_TRUE(mesh.value().positions.allFinite());
    EXPECT_GE(mesh.value().triangles.minCoeff(), 0);
    EXPECT_LT(mesh.value().triangles.maxCoeff(), mesh.value().positions.rows());
  }

  std::string bytes_written(const std::string& name) const {
    const auto mesh = read_mesh(write("good.obj", obj_tetrahedron));
    const auto path = folder() / name;
    EXPECT_TRUE(write_mesh(path, mesh.value().positions, mesh.value().triangles));
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

TEST_F(DamagedFile, Obj) { damage("a.obj", std::string(obj_tetrahedron), check_mesh); }
TEST_F(DamagedFile, Off) { damage("a.off", std::string(off_tetrahedron), check_mesh); }
TEST_F(DamagedFile, AsciiPly) { damage("a.ply", std::string(ply_tetrahedron), check_mesh); }
TEST_F(DamagedFile, BinaryPly) { damage("b.ply", bytes_written("good.ply"), check_mesh); }
TEST_F(DamagedFile, Compressed) { damage("a.obj.gz", gzip(obj_tetrahedron), check_mesh); }

TEST_F(DamagedFile, BigEndianPly) {
  std::string text = bytes_written("good.ply");
  text.replace(text.find("little"), 6, "big");
  damage("c.ply", text, check_mesh);
}

TEST_F(DamagedFile, CutPlyIsNamedTruncated) {
  const std::string good = bytes_written("good.ply");
  for (std::size_t size = 4; size < good.size(); ++size) {
    EXPECT_EQ(mesh_problem("cut.ply", good.substr(0, size)).what, FileProblem::truncated) << size;
  }
}

TEST_F(DamagedFile, QueryCsv) {
  std::string rows;
  for (int i = 0; i < 8; ++i) rows += "-1,2,3,4,5,8,1\n";
  damage("a-vf.csv", rows, [](const std::filesystem::path& path) {
    const auto queries = read_queries(path);
    if (!queries) {
      EXPECT_FALSE(queries.error().message.empty());
    }
  });
}

TEST_F(DamagedFile, CaseFile) {
  Case c;
  c.id = "a";
  const auto mesh = read_mesh(write("good.obj", obj_tetrahedron));
  c.triangles = mesh.value().triangles;
  c.frames = {mesh.value().positions, mesh.value().positions};
  c.view = CaseView{{{0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}}, {}};
  c.expected.steps.resize(1);
  damage("a.json", case_text(c), [](const std::filesystem::path& path) {
    const auto read = read_case(path);
    if (!read) {
      EXPECT_FALSE(read.error().message.empty());
    }
  });
}

}  // namespace
}  // namespace assay::corpus
