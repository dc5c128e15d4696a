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
  const auto expect = [&](std::string_view words, std::string_view line, std::string_view text) {
    const Problem problem = mesh_problem("bad.off", text);
    EXPECT_TRUE(says(problem, words)) << text;
    EXPECT_TRUE(says(problem, line));
  };
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  expect("the file ends where", "a face", vertices);
  expect("the file ends where", "vertex 1", "OFF\n3 1 0\n0 0 0\n");
  expect("the file ends where", "counts", "OFF\n");
  expect("in a file of 25 bytes", "4000000000", "OFF\n4000000000 1 0\n0 0 0\n");
  expect("a negative count", "negative", "OFF\n-1 1 0\n");
  expect("the number of vertices expected", "line 2", "OFF\nx 1 0\n");
  expect("the number of faces expected", "line 2", "OFF\n3\n");
  expect("binary OFF files are not read", "binary", "OFF BINARY\n");
  expect("are not read", "three dimensions", "4OFF\n3 1 0\n");
  expect("a face of 3 corners lists 2", "line 6", vertices + "3 0 1\n");
  expect("a vertex index expected", "line 6", vertices + "3 0 1 z\n");
  expect("a face of -3 corners", "line 6", vertices + "-3 0 1 2\n");
  expect("a face of 2 vertices", "line 6", vertices + "2 0 1\n");
  expect("text after the last face", "line 7", vertices + "3 0 1 2\n3 0 1 2\n");
  expect("fewer than 3 coordinates", "line 3", "OFF\n3 1 0\n0 0\n");
  expect("\"x\" is no number", "line 3", "OFF\n3 1 0\n0 0 x\n");
  expect("but there are 3 vertices", "line 6", vertices + "3 0 1 3\n");
  expect("is out of range", "line 6", vertices + "3 0 1 -1\n");
  expect("names a vertex twice", "line 6", vertices + "3 0 1 0\n");
  expect("is not finite", "line 3", "OFF\n3 1 0\n0 0 1e999\n");
  expect("no triangle", "bad.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
}

}  // namespace
}  // namespace assay::corpus
