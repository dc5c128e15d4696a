// Files with cut or changed bytes: a reader returns a value or a problem, never crashes, and never
// asks for more memory than the size of the file justifies. These tests are worth running under
// sanitizers.
#include "corpus/cases/case_file.h"
#include "corpus/formats/mesh_reader.h"
#include "corpus/formats/sequences.h"
#include "corpus/queries/query_csv.h"
#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

class DamagedFile : public Scratch {
 protected:
  // The bytes cut at every place, and each byte flipped in several ways; `read` must return.
  template <class Read>
  static void damage(const std::string& good, Read read) {
    for (std::size_t size = 0; size < good.size(); ++size) read(good.substr(0, size));
    for (std::size_t i = 0; i < good.size(); ++i) {
      for (const int mask : {0x01, 0x10, 0x80, 0xff}) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ mask);
        read(bad);
      }
    }
  }

  template <class T>
  static void check_problem(const Expected<T>& result) {
    if (result) return;
    EXPECT_FALSE(result.error().message.empty());
    EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
  }

  static void check_mesh(const Expected<Mesh>& mesh) {
    check_problem(mesh);
    if (!mesh) return;
    EXPECT_TRUE(mesh.value().positions.allFinite());
    EXPECT_GE(mesh.value().triangles.minCoeff(), 0);
    EXPECT_LT(mesh.value().triangles.maxCoeff(), mesh.value().positions.rows());
  }

  std::string bytes_written(const std::string& name) const {
    const auto mesh = read_mesh(write("good.obj", obj_tetrahedron));
    const auto path = folder() / name;
    EXPECT_TRUE(write_mesh(path, mesh.value().positions, mesh.value().triangles));
    return bytes_in(path);
  }
};

TEST_F(DamagedFile, OfEachFormat) {
  const auto read_file = [&](auto& bytes, auto& name) { return read_mesh(write(name, bytes)); };
  const auto check = [](const std::string& good, const std::string& name, const auto& read) {
    damage(good, [&](const std::string& bytes) { check_mesh(read(bytes, name)); });
  };
  check(std::string(obj_tetrahedron), "a.obj", read_obj);
  check(std::string(off_tetrahedron), "a.off", read_off);
  check(gzip(obj_tetrahedron), "a.obj.gz", read_file);
  const std::string little = bytes_written("good.ply");
  std::string big = little;
  big.replace(big.find("little"), 6, "big");
  for (const std::string& good : {std::string(ply_tetrahedron), little, big})
    check(good, "a.ply", read_ply);
}

TEST_F(DamagedFile, CutPlyIsNamedTruncated) {
  const std::string good = bytes_written("good.ply");
  for (std::size_t size = 4; size < good.size(); ++size) {
    const Problem problem = read_ply(good.substr(0, size), "cut.ply").error();
    const auto says_so = [&](std::string_view words) { return bool(says(problem, words)); };
    EXPECT_TRUE(says_so("no end_header") || says_so("not fit into the rest") ||
                says_so("the file ends, but"))
        << size << ": " << problem.message;
  }
}

TEST_F(DamagedFile, QueryCsv) {
  std::string rows;
  for (int i = 0; i < 8; ++i) rows += "-1,2,3,4,5,8,1\n";
  damage(rows,
         [&](const std::string& bytes) { check_problem(read_queries(write("a-vf.csv", bytes))); });
}

TEST_F(DamagedFile, CaseFile) {
  Case c;
  c.id = "a";
  const auto mesh = read_mesh(write("good.obj", obj_tetrahedron));
  c.triangles = mesh.value().triangles;
  c.frames = {mesh.value().positions, mesh.value().positions};
  c.view = CaseView{{{0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}}, {}};
  c.expected.steps.resize(1);
  damage(case_text(c),
         [](const std::string& bytes) { check_problem(parse_case(bytes, "a.json")); });
}

}  // namespace
}  // namespace assay::corpus
