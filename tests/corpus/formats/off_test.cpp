#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

class Off : public Scratch {};

TEST_F(Off, PlainTetrahedronWhateverTheName) {
  expect_tetrahedron(read_mesh(write("a.off", off_tetrahedron)));
  expect_tetrahedron(read_mesh(write("a.mesh", off_tetrahedron)));
}

TEST_F(Off, CommentsBlankLinesCrlfAndCountsBehindTheHeader) {
  expect_tetrahedron(read_mesh(
      write("a.off",
            "# comment\r\nOFF 4 4 6 # counts\r\n\r\n0 0 0\r\n1 0 0\r\n# more\r\n0 1 0\r\n0 0 1\r\n"
            "3 0 2 1\r\n3 0 1 3\r\n3 1 2 3\r\n3 2 0 3\r\n\r\n")));
}

TEST_F(Off, NormalsAndColoursArePassedOver) {
  expect_tetrahedron(read_mesh(
      write("a.off",
            "CNOFF\n4 4\n0 0 0 0 0 1 255 0 0 255\n1 0 0 0 0 1 1 1 1 1\n0 1 0 0 0 1 1 1 1 1\n"
            "0 0 1 0 0 1 1 1 1 1\n3 0 2 1 255 0 0\n3 0 1 3 0.5 0.5 0.5 1\n3 1 2 3\n3 2 0 3 7\n")));
}

TEST_F(Off, PolygonsAreFannedFromTheirFirstVertex) {
  const auto mesh =
      read_mesh(write("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 2 3 0 1\n"));
  ASSERT_TRUE(mesh);
  detector::Triangles fan(2, 3);
  fan << 2, 3, 0, 2, 0, 1;
  EXPECT_EQ(mesh.value().triangles, fan);
}

TEST_F(Off, ProblemsNameTheLine) {
  const auto expect = [&](FileProblem kind, std::string_view line, std::string_view text) {
    const Problem problem = mesh_problem("bad.off", text);
    EXPECT_EQ(problem.kind, kind) << text << "\n" << problem.message;
    EXPECT_NE(problem.message.find(line), std::string::npos) << problem.message;
  };
  using enum FileProblem;
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  expect(truncated, "a face", vertices);
  expect(truncated, "vertex 1", "OFF\n3 1 0\n0 0 0\n");
  expect(truncated, "counts", "OFF\n");
  expect(truncated, "4000000000", "OFF\n4000000000 1 0\n0 0 0\n");
  expect(malformed, "negative", "OFF\n-1 1 0\n");
  expect(malformed, "line 2", "OFF\nx 1 0\n");
  expect(malformed, "line 2", "OFF\n3\n");
  expect(malformed, "binary", "OFF BINARY\n");
  expect(malformed, "three dimensions", "4OFF\n3 1 0\n");
  expect(malformed, "line 6", vertices + "3 0 1\n");
  expect(malformed, "line 6", vertices + "3 0 1 z\n");
  expect(malformed, "line 6", vertices + "-3 0 1 2\n");
  expect(malformed, "line 6", vertices + "2 0 1\n");
  expect(malformed, "line 7", vertices + "3 0 1 2\n3 0 1 2\n");
  expect(malformed, "line 3", "OFF\n3 1 0\n0 0\n");
  expect(malformed, "line 3", "OFF\n3 1 0\n0 0 x\n");
  expect(index_out_of_range, "line 6", vertices + "3 0 1 3\n");
  expect(index_out_of_range, "line 6", vertices + "3 0 1 -1\n");
  expect(repeated_index, "line 6", vertices + "3 0 1 0\n");
  expect(non_finite_coordinate, "line 3", "OFF\n3 1 0\n0 0 1e999\n");
  expect(no_triangles, "bad.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
}

}  // namespace
}  // namespace assay::corpus
