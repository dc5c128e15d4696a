#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

class Obj : public Scratch {};

TEST_F(Obj, PlainTetrahedron) {
  expect_tetrahedron(read_mesh(write("a.obj", obj_tetrahedron)));
  expect_tetrahedron(read_mesh(write("A.OBJ", obj_tetrahedron)));
}

TEST_F(Obj, CornerForms) {
  expect_tetrahedron(read_mesh(write("a.obj",
                                     "vt 0 0\nvn 0 0 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                     "f 1/1 3/1 2/1\nf 1//1 2//1 4//1\nf 2/1/1 3/1/1 4/1/1\n"
                                     "f 3/ 1/ 4/\n")));
}

TEST_F(Obj, NegativeIndicesCountFromTheLastVertexSoFar) {
  expect_tetrahedron(read_mesh(
      write("a.obj",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -1 -2\nv 0 0 1\nf -4 2 -1\nf -3 -2 4\nf 3 -4 -1\n")));
}

TEST_F(Obj, CommentsContinuationsCrlfAndStatementsPassedOver) {
  expect_tetrahedron(
      read_mesh(write("a.obj",
                      "# a tetrahedron\r\nmtllib x.mtl\r\no part\r\ng a b\r\ns off\r\n"
                      "  v 0 0 0 # origin\r\nv 1 \\\r\n 0 0\r\nv\t0\t1\t0\r\n\r\n"
                      "v 0 0 1 0.5 0.5 0.5\r\nusemtl m\r\nf 1 3 \\\r\n2\r\nf 1 2 4\r\n"
                      "f 2 3 4\r\nl 1 2\r\nf 3 1 4")));
}

TEST_F(Obj, FacesMayComeBeforeTheirVertices) {
  const auto mesh = read_mesh(write("a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"));
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh.value().triangles.rows(), 1);
}

TEST_F(Obj, PolygonsAreFannedFromTheirFirstVertex) {
  const auto mesh =
      read_mesh(write("a.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 2 3 4 5 1\n"));
  ASSERT_TRUE(mesh);
  detector::Triangles fan(3, 3);
  fan << 1, 2, 3, 1, 3, 4, 1, 4, 0;
  EXPECT_EQ(mesh.value().triangles, fan);
}

TEST_F(Obj, DuplicateTrianglesAndUnusedVerticesStay) {
  const auto mesh =
      read_mesh(write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\nf 2 3 1\n"));
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh.value().positions.rows(), 4);
  EXPECT_EQ(mesh.value().triangles.rows(), 2);
}

TEST_F(Obj, ProblemsNameFileAndLine) {
  const auto expect = [&](std::string_view words, std::string_view line, std::string_view text) {
    const Problem problem = mesh_problem("bad.obj", text);
    EXPECT_TRUE(says(problem, words)) << text;
    EXPECT_NE(problem.message.find("bad.obj"), std::string::npos);
    EXPECT_TRUE(says(problem, line));
    EXPECT_EQ(problem.message.find('\n'), std::string::npos);
  };
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect("but there are 3 vertices", "line 4", vertices + "f 1 2 4\n");
  expect("but there are 3 vertices", "line 5", vertices + "f 1 2 3\nf 7 2 3\nf 1 3 2\n");
  expect("index 0 is out of range", "line 4", vertices + "f 0 1 2\n");
  expect("index -4 is out of range", "line 4", vertices + "f -4 1 2\n");
  expect("is out of range", "line 4", vertices + "f 1 2 9000000000\n");
  expect("names a vertex twice", "line 4", vertices + "f 1 2 2\n");
  expect("names a vertex twice", "line 4", vertices + "f 1 2 3 1\n");
  expect("a face of 2 vertices", "line 4", vertices + "f 1 2\n");
  expect("\"x\" is no corner", "line 4", vertices + "f 1 2 x\n");
  expect("\"3/1/1/1\" is no corner", "line 4", vertices + "f 1 2 3/1/1/1\n");
  expect("is no corner", "line 4", vertices + "f 1 2 99999999999999999999\n");
  expect("fewer than 3 coordinates", "line 1", "v 0 0\n");
  expect("\"1,5\" is no number", "line 1", "v 0 0 1,5\n");
  expect("\"+-1\" is no number", "line 1", "v 0 0 +-1\n");
  expect("\"nonsense\" is no statement", "line 2", "\nnonsense 1 2\n");
  expect("is not finite", "line 1", "v nan 0 0\n");
  expect("is not finite", "line 1", "v 0 -inf 0\n");
  expect("is not finite", "line 1", "v 0 0 1e999\n");
  expect("no triangle", "3 vertices", vertices);
  expect("no triangle", "0 vertices", "# nothing\n");
}

TEST_F(Obj, NoiseIsMalformed) {
  std::string noise(4000, '\0');
  std::uint32_t state = 1;
  for (char& c : noise) c = static_cast<char>((state = state * 1664525 + 1013904223) >> 24);
  EXPECT_TRUE(says(mesh_problem("noise.obj", noise), "is no statement of an OBJ file"));
  EXPECT_TRUE(says(mesh_problem("noise.bin", noise), "neither PLY nor OFF"));
}

}  // namespace
}  // namespace assay::corpus
