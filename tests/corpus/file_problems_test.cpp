// What may be wrong with a file before its content is looked at, and compressed files.
#include "corpus/file_bytes.h"
#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

class FileProblems : public Scratch {};

TEST_F(FileProblems, MissingEmptyFolder) {
  const auto missing = read_mesh(folder() / "absent.obj");
  ASSERT_FALSE(missing);
  EXPECT_TRUE(says(missing.error(), "cannot be read: No such file"));
  EXPECT_NE(missing.error().message.find("absent.obj"), std::string::npos);
  EXPECT_TRUE(says(mesh_problem("empty.obj", ""), "the file is empty"));
  const auto directory = read_mesh(folder());
  ASSERT_FALSE(directory);
  EXPECT_TRUE(says(directory.error(), "cannot be read: Is a directory"));
}

TEST_F(FileProblems, NoPermission) {
  const auto path = write("locked.obj", obj_tetrahedron);
  std::filesystem::permissions(path, std::filesystem::perms::none);
  // The superuser may read everything; another user may not.
  const bool superuser = geteuid() == 0;
  if (superuser) {
    ASSERT_EQ(seteuid(65534), 0);
  }
  const auto mesh = read_mesh(path);
  if (superuser) {
    ASSERT_EQ(seteuid(0), 0);
  }
  ASSERT_FALSE(mesh);
  EXPECT_TRUE(says(mesh.error(), "cannot be read: Permission denied"));
}

TEST_F(FileProblems, MessagesAreOneLineWhateverThePath) {
  const auto mesh = read_mesh(folder() / "two\nlines.obj");
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().message.find('\n'), std::string::npos);
}

TEST_F(FileProblems, EveryFormatCompressed) {
  expect_tetrahedron(read_mesh(write("a.obj.gz", gzip(obj_tetrahedron))));
  expect_tetrahedron(read_mesh(write("a.OBJ.GZ", gzip(obj_tetrahedron))));
  expect_tetrahedron(read_mesh(write("a.off.gz", gzip(off_tetrahedron))));
  expect_tetrahedron(read_mesh(write("a.ply.gz", gzip(ply_tetrahedron))));
  // Told from its content, not from its name; several members one after another.
  expect_tetrahedron(read_mesh(
      write("b.obj", gzip(obj_tetrahedron.substr(0, 20)) + gzip(obj_tetrahedron.substr(20)))));
}

TEST_F(FileProblems, DamagedCompression) {
  const std::string good = gzip(obj_tetrahedron);
  for (std::size_t size = 1; size < good.size(); ++size) {
    EXPECT_TRUE(says(mesh_problem("a.obj.gz", good.substr(0, size)), "the gzip stream")) << size;
  }
  std::string wrong_sum = good;
  wrong_sum[wrong_sum.size() - 6] ^= 1;
  EXPECT_TRUE(says(mesh_problem("b.obj.gz", wrong_sum), "the gzip stream is damaged"));
  EXPECT_TRUE(says(mesh_problem("c.obj.gz", good + "tail"), "the gzip stream is damaged"));
  EXPECT_TRUE(says(mesh_problem("d.obj.gz", obj_tetrahedron), "has no gzip signature"));
  EXPECT_TRUE(says(mesh_problem("e.obj.gz", gzip("")), "the file is empty"));
}

TEST_F(FileProblems, DecompressedSizeIsLimited) {
  const auto path = write("big.gz", gzip(std::string(1 << 20, 'x')));
  const auto fits = read_bytes(path, 1 << 20);
  ASSERT_TRUE(fits);
  EXPECT_EQ(fits.value().size(), std::size_t{1} << 20);
  const auto refused = read_bytes(path, (1 << 20) - 1);
  ASSERT_FALSE(refused);
  EXPECT_TRUE(says(refused.error(), "larger than the 1048575 bytes"));
  const auto plain = read_bytes(write("plain", "12345"), 4);
  ASSERT_FALSE(plain);
  EXPECT_TRUE(says(plain.error(), "larger than the 4 bytes"));
}

}  // namespace
}  // namespace assay::corpus
