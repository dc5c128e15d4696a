// Meshes in each format: what is read, and which files are refused, with which words.
#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

// A tetrahedron, in the forms that its format knows.
class Tetrahedron : public Scratch {
 protected:
  void read(const std::string& name, std::string_view bytes) const {
    SCOPED_TRACE(name);
    expect_tetrahedron(read_mesh(write(name, bytes)));
  }
};

using Obj = Tetrahedron;

TEST_F(Obj, FormsOfAFile) {
  read("plain.obj", obj_tetrahedron);
  read("CAPITAL.OBJ", obj_tetrahedron);
  read("corners.obj",
       "vt 0 0\nvn 0 0 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1/1 3/1 2/1\nf 1//1 2//1 4//1\n"
       "f 2/1/1 3/1/1 4/1/1\nf 3/ 1/ 4/\n");
  // Negative indices count from the last vertex so far.
  read("negative.obj",
       "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -1 -2\nv 0 0 1\nf -4 2 -1\nf -3 -2 4\nf 3 -4 -1\n");
  read("comments_continuations_and_crlf.obj",
       "# a tetrahedron\r\nmtllib x.mtl\r\no part\r\ng a b\r\ns off\r\n  v 0 0 0 # origin\r\n"
       "v 1 \\\r\n 0 0\r\nv\t0\t1\t0\r\n\r\nv 0 0 1 0.5 0.5 0.5\r\nusemtl m\r\nf 1 3 \\\r\n2\r\n"
       "f 1 2 4\r\nf 2 3 4\r\nl 1 2\r\nf 3 1 4");
}

TEST_F(Obj, FacesMayComeBeforeTheirVertices) {
  expect_triangles(read_mesh(write("a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n")), "0 1 2");
}

TEST_F(Obj, PolygonsAreFannedFromTheirFirstVertex) {
  const auto mesh =
      read_mesh(write("a.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 2 3 4 5 1\n"));
  expect_triangles(mesh, "1 2 3, 1 3 4, 1 4 0");
}

TEST_F(Obj, DuplicateTrianglesAndUnusedVerticesStay) {
  const auto mesh =
      value_of(read_mesh(write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\nf 2 3 1\n")));
  EXPECT_EQ(mesh.positions.rows(), 4);
  EXPECT_EQ(mesh.triangles.rows(), 2);
}

TEST_F(Obj, ProblemsNameFileAndLine) {
  const auto expect = [&](std::string_view words, std::string_view line, std::string_view text) {
    expect_mesh_problem("bad.obj", text, words, line);
  };
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect("index 4 (counted from 1) is too large for 3 vertices", "line 4", vertices + "f 1 2 4\n");
  expect("too large for 3 vertices", "line 5", vertices + "f 1 2 3\nf 7 2 3\nf 1 3 2\n");
  expect("index 0 is out of range", "line 4", vertices + "f 0 1 2\n");
  expect("index -4 is out of range", "line 4", vertices + "f -4 1 2\n");
  expect("is out of range", "line 4", vertices + "f 1 2 9000000000\n");
  expect("names a vertex twice", "line 4", vertices + "f 1 2 2\n");
  expect("names a vertex twice", "line 4", vertices + "f 1 2 3 1\n");
  expect("a face has only 2 vertices", "line 4", vertices + "f 1 2\n");
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

using Off = Tetrahedron;

TEST_F(Off, FormsOfAFile) {
  read("plain.off", off_tetrahedron);
  read("told_from_its_content.mesh", off_tetrahedron);
  read("comments_and_crlf.off",
       "# comment\r\nOFF 4 4 6 # counts\r\n\r\n0 0 0\r\n1 0 0\r\n# more\r\n0 1 0\r\n0 0 1\r\n"
       "3 0 2 1\r\n3 0 1 3\r\n3 1 2 3\r\n3 2 0 3\r\n\r\n");
  read("normals_and_colours.off",
       "CNOFF\n4 4\n0 0 0 0 0 1 255 0 0 255\n1 0 0 0 0 1 1 1 1 1\n0 1 0 0 0 1 1 1 1 1\n"
       "0 0 1 0 0 1 1 1 1 1\n3 0 2 1 255 0 0\n3 0 1 3 0.5 0.5 0.5 1\n3 1 2 3\n3 2 0 3 7\n");
}

TEST_F(Off, PolygonsAreFannedFromTheirFirstVertex) {
  const auto mesh =
      read_mesh(write("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 2 3 0 1\n"));
  expect_triangles(mesh, "2 3 0, 2 0 1");
}

TEST_F(Off, ProblemsNameTheLine) {
  const auto expect = [&](std::string_view words, std::string_view line, std::string_view text) {
    expect_mesh_problem("bad.off", text, words, line);
  };
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  expect("the file ends where", "a face", vertices);
  expect("the file ends where", "vertex 1", "OFF\n3 1 0\n0 0 0\n");
  expect("the file ends where", "counts", "OFF\n");
  expect("do not fit into 25 bytes", "4000000000", "OFF\n4000000000 1 0\n0 0 0\n");
  expect("a negative count", "negative", "OFF\n-1 1 0\n");
  expect("the number of vertices expected", "line 2", "OFF\nx 1 0\n");
  expect("the number of faces expected", "line 2", "OFF\n3\n");
  expect("binary OFF files are not read", "binary", "OFF BINARY\n");
  expect("are not read", "three dimensions", "4OFF\n3 1 0\n");
  expect("a face of 3 corners lists 2 vertices", "line 6", vertices + "3 0 1\n");
  expect("a vertex index expected", "line 6", vertices + "3 0 1 z\n");
  expect("a face of -3 corners", "line 6", vertices + "-3 0 1 2\n");
  expect("no triangle", "1 face of fewer than 3 corners", vertices + "2 0 1\n");
  expect("text after the last face", "line 7", vertices + "3 0 1 2\n3 0 1 2\n");
  expect("fewer than 3 coordinates", "line 3", "OFF\n3 1 0\n0 0\n");
  expect("\"x\" is no number", "line 3", "OFF\n3 1 0\n0 0 x\n");
  expect("too large for 3 vertices", "line 6", vertices + "3 0 1 3\n");
  expect("is out of range", "line 6", vertices + "3 0 1 -1\n");
  expect("names a vertex twice", "line 6", vertices + "3 0 1 0\n");
  expect("is not finite", "line 3", "OFF\n3 1 0\n0 0 1e999\n");
  expect("no triangle", "bad.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
}

using Ply = Tetrahedron;

// The tetrahedron with properties and elements around it that mean nothing here.
std::string binary_tetrahedron(bool big) {
  std::string text = "ply\nformat binary_";
  text += big ? "big" : "little";
  text +=
      "_endian 1.0\ncomment c\nobj_info i\nelement vertex 4\nproperty uchar red\n"
      "property float x\nproperty double y\nproperty list uchar short tags\nproperty short z\n"
      "element edge 2\nproperty int a\nproperty int b\nelement face 4\nproperty ushort flags\n"
      "property list ushort uint vertex_index\nelement empty 0\nproperty int n\nend_header\n";
  const int points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& p : points)
    text += '\xff' + bytes_of(static_cast<float>(p[0]), big) +
            bytes_of(static_cast<double>(p[1]), big) + '\x01' + bytes_of(std::int16_t{7}, big) +
            bytes_of(static_cast<std::int16_t>(p[2]), big);
  for (int i = 0; i < 4; ++i) text += bytes_of(i, big);
  const std::uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  for (const auto& face : faces) {
    text += bytes_of(std::uint16_t{9}, big) + bytes_of(std::uint16_t{3}, big);
    for (const std::uint32_t v : face) text += bytes_of(v, big);
  }
  return text;
}

TEST_F(Ply, FormsOfAFile) {
  read("plain.ply", ply_tetrahedron);
  read("crlf_and_extra_properties_and_elements.ply",
       "ply\r\nformat ascii 1.0\r\nelement material 1\r\nproperty list int float k\r\n"
       "element vertex 4\r\nproperty float nx\r\nproperty float32 z\r\nproperty int y\r\n"
       "property double x\r\nelement face 4\r\nproperty list uchar int32 vertex_index\r\n"
       "property uint8 red\r\nend_header\r\n2 0.5 0.25\r\n9 0 0 0\r\n9 0 0 1\r\n9 0 1 0\r\n"
       "9 1 0 0\r\n3 0 2 1 255\r\n3 0 1 3 255\r\n3 1 2 3 255\r\n3 2 0 3 255\r\n");
  read("little.ply", binary_tetrahedron(false));
  read("big.ply", binary_tetrahedron(true));
  std::string text = binary_tetrahedron(false);
  const std::size_t body = text.find("end_header\n") + 11;
  std::string header;
  for (const char c : text.substr(0, body)) header += c == '\n' ? "\r\n" : std::string(1, c);
  read("binary_after_a_crlf_header.ply", header + text.substr(body));
}

TEST_F(Ply, Float32ConvertsExactlyAndAsciiKeepsItsDigits) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const float values[3] = {0.1F, std::numeric_limits<float>::denorm_min(), -3.4e38F};
  for (int i = 0; i < 3; ++i) {
    for (const float value : values) text += bytes_of(value, false);
  }
  text += '\x03' + bytes_of(0, false) + bytes_of(1, false) + bytes_of(2, false);
  const auto binary = value_of(read_mesh(write("a.ply", text)));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(binary.positions(0, k), static_cast<double>(values[k]));
  const auto ascii = value_of(read_mesh(
      write("b.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0.1 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")));
  EXPECT_EQ(ascii.positions(0, 0), 0.1);
}

TEST_F(Ply, PolygonsAreFannedFromTheirFirstVertex) {
  const auto mesh = read_mesh(
      write("a.ply",
            "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
            "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
            "4 3 0 1 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"));
  expect_triangles(mesh, "3 0 1, 3 1 2");
}

TEST_F(Ply, Problems) {
  const auto expect = [&](std::string_view words, std::string_view from, std::string_view to) {
    std::string text(ply_tetrahedron);
    const std::size_t place = text.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
    expect_mesh_problem("bad.ply", text, words, "");
  };
  expect("unknown PLY format", "format ascii", "format utf8");
  expect("unknown PLY format", "ascii 1.0", "ascii 2.0");
  expect("the header names no format", "format ascii 1.0\n", "");
  expect("\"element NAME COUNT\" expected", "element vertex 4", "element vertex four");
  expect("\"element NAME COUNT\" expected", "element vertex 4", "element vertex -4");
  expect("\"element NAME COUNT\" expected", "element vertex 4", "element vertex");
  expect("a property stands before the first element", "element vertex 4\n", "");
  expect("element \"vertex\" is declared twice", "element face 4", "element vertex 4");
  expect("property \"y\" is declared twice", "property double x", "property double y");
  expect("\"complex\" is no PLY type", "property double x", "property complex x");
  expect("\"property TYPE NAME\" expected", "property double x", "property double");
  expect("lacks a property x, y or z", "property double x\n", "");
  expect("\"remark\" is no statement", "property double x", "remark double x");
  expect("\"float\" is no integer type", "list uchar int", "list float int");
  expect("no list of integers named vertex_indices", "list uchar int", "list uchar float");
  expect("no list of integers named vertex_indices", "vertex_indices", "corners");
  expect("\"0\" is no statement", "end_header\n", "");
  expect("the file ends, but its header states more values", "element face 4", "element face 5");
  expect("do not fit into the rest", "element face 4", "element face 40");
  // A vertex too many swallows the first face's line, and what follows no longer fits.
  expect("a face has only 1 vertices", "element vertex 4", "element vertex 5");
  expect("do not fit into the rest", "element vertex 4", "element vertex 4000000000000");
  expect("the file ends, but its header states more values", "3 2 0 3\n", "");
  expect("the file ends, but its header states more values", "3 2 0 3", "3 2 0");
  expect("a list of 300 items does not fit", "3 2 0 3", "300 2 0 3");
  expect("a list of negative size", "3 2 0 3", "-3 2 0 3");
  expect("a face has only 2 vertices", "3 2 0 3", "2 2 0");
  expect("data after the last element", "3 2 0 3", "3 2 0 3 3");
  expect("\"3.0\" is not of the type", "3 2 0 3", "3 2 0 3.0");
  expect("\"zero\" is not of the type", "1 0 0", "1 0 zero");
  expect("is not finite", "1 0 0", "1 0 nan");
  expect("is not finite", "1 0 0", "1 0 -1e999");
  expect("too large for 4 vertices", "3 2 0 3", "3 2 0 4");
  expect("index -1 (counted from 0) is out of range", "3 2 0 3", "3 2 0 -1");
  expect("names a vertex twice", "3 2 0 3", "3 2 3 3");
  expect_mesh_problem("no_faces.ply",
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                      "property float y\nproperty float z\nend_header\n0 0 0\n",
                      "no triangle", "");
}

TEST_F(Ply, BinaryProblems) {
  const std::string good = binary_tetrahedron(false);
  EXPECT_TRUE(says(mesh_problem("long.ply", good + "x"), "data after the last element"));
  EXPECT_TRUE(says(mesh_problem("short.ply", good.substr(0, good.size() - 1)),
                   "does not fit into the rest"));
  std::string nan = good;
  nan.replace(nan.find("end_header\n") + 11 + 1, 4,
              bytes_of(std::numeric_limits<float>::quiet_NaN(), false));
  EXPECT_TRUE(says(mesh_problem("nan.ply", nan), "is not finite"));
  std::string huge = good;
  huge.replace(huge.find("element face 4"), 14, "element face 9223372036854775807");
  EXPECT_TRUE(says(mesh_problem("huge.ply", huge), "do not fit into the rest"));
  // A list that claims more items than the file has bytes.
  std::string list = good;
  list.replace(list.size() - 14, 2, "\xff\xff");
  EXPECT_TRUE(says(mesh_problem("list.ply", list), "items does not fit into the rest"));
}

}  // namespace
}  // namespace assay::corpus
