// Sequences of frames, and the writer: what is written reads back bit by bit.
#include "corpus/formats/mesh_writer.h"
#include "corpus/formats/sequence_reader.h"
#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

using Paths = std::vector<std::filesystem::path>;

class MeshSequence : public Scratch {
 protected:
  Paths frames(const std::vector<std::string>& texts) const {
    Paths paths;
    for (const std::string& text : texts) {
      paths.push_back(write("frame" + std::to_string(paths.size()) + ".obj", text));
    }
    return paths;
  }
};

TEST_F(MeshSequence, FramesOfDifferentFormats) {
  const Paths paths = {write("a.obj", obj_tetrahedron), write("b.ply", ply_tetrahedron),
                       write("c.off.gz", gzip(off_tetrahedron))};
  const auto sequence = read_sequence(paths);
  ASSERT_TRUE(sequence) << sequence.error().message;
  EXPECT_EQ(sequence.value().frames.size(), 3U);
  EXPECT_EQ(sequence.value().frames[0], sequence.value().frames[2]);
  EXPECT_EQ(sequence.value().triangles.rows(), 4);
}

TEST_F(MeshSequence, ProblemsNameBothFiles) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto expect = [&](std::string_view words, const std::vector<std::string>& texts) {
    const auto sequence = read_sequence(frames(texts));
    ASSERT_FALSE(sequence);
    EXPECT_TRUE(says(sequence.error(), words));
    EXPECT_NE(sequence.error().message.find("frame0.obj"), std::string::npos);
    EXPECT_NE(sequence.error().message.find("frame1.obj"), std::string::npos);
  };
  expect("vertices, but", {triangle + "f 1 2 3\n", triangle + "v 9 9 9\nf 1 2 3\n"});
  expect("triangle 0 is (1, 2, 0), but in", {triangle + "f 1 2 3\n", triangle + "f 2 3 1\n"});
  expect("2 triangles, but", {triangle + "f 1 2 3\n", triangle + "f 1 2 3\nf 1 3 2\n"});
  expect("two meshes are --body", {triangle + "f 1 2 3\n", triangle + "v 9 9 9\nf 1 2 3\n"});
}

TEST_F(MeshSequence, FramesAreTakenInTheOrderOfTheirNumbers) {
  const auto frame = [&](int number) {
    const auto x = std::to_string(number);
    return write("f" + x + ".obj", "v " + x + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  };
  const auto sequence = read_sequence(Paths{frame(1), frame(10), frame(2)});
  ASSERT_TRUE(sequence) << sequence.error().message;
  EXPECT_EQ(sequence.value().frames[1](0, 0), 2);
  ASSERT_EQ(sequence.value().remarks.size(), 2u);
  EXPECT_EQ(sequence.value().remarks[0],
            "frames are taken in the order of their numbers: f2.obj before f10.obj");
}

TEST_F(MeshSequence, NoFramesAndBadFrames) {
  EXPECT_TRUE(says(read_sequence({}).error(), "no mesh file is given"));
  const Paths paths = {write("a.obj", obj_tetrahedron), folder() / "absent.obj"};
  EXPECT_TRUE(says(read_sequence(paths).error(), "cannot be read"));
}

TEST_F(MeshSequence, EachFrameIsReadOnceWhenItIsAskedFor) {
  const Paths paths = {write("a.obj", obj_tetrahedron), folder() / "b.off", folder() / "c.ply"};
  SequenceReader reader(paths);
  EXPECT_EQ(reader.frames(), 3U);
  // A file is there only while its frame is read.
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.triangles().rows(), 4);
  std::filesystem::remove(paths[0]);
  write("b.off", off_tetrahedron);
  EXPECT_EQ(reader.next().value().rows(), 4);
  std::filesystem::remove(paths[1]);
  EXPECT_FALSE(reader.at_end());
  write("c.ply", ply_tetrahedron);
  ASSERT_TRUE(reader.next());
  EXPECT_TRUE(reader.at_end());
}

TEST_F(MeshSequence, AFrameThatIsBadEndsNeitherTheReaderNorWhatWasReadBefore) {
  const Paths paths = {write("a.obj", obj_tetrahedron), write("b.off", "OFF\n4 4 6\n0 0 0\n"),
                       write("c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")};
  SequenceReader reader(paths);
  ASSERT_TRUE(reader.next());
  EXPECT_TRUE(says(reader.next().error(), "the file ends where"));
  EXPECT_TRUE(says(reader.next().error(), "the file ends where"));
  write("b.off", off_tetrahedron);
  ASSERT_TRUE(reader.next());
  const auto other = reader.next();
  ASSERT_FALSE(other);
  EXPECT_TRUE(says(other.error(), "vertices, but"));
  EXPECT_NE(other.error().message.find("a.obj"), std::string::npos) << other.error().message;
  EXPECT_NE(other.error().message.find("c.obj"), std::string::npos) << other.error().message;
}

TEST_F(MeshSequence, WhatIsSeenWithoutReading) {
  const auto look = [&](const std::string& name, std::string_view bytes) {
    return look_at_mesh(write(name, bytes));
  };
  EXPECT_TRUE(look("a.obj", obj_tetrahedron));
  EXPECT_TRUE(look("of_no_known_name", ply_tetrahedron));
  EXPECT_TRUE(says(look("a.xyz", obj_tetrahedron).error(), "neither PLY nor OFF"));
  EXPECT_TRUE(says(look("empty.ply", "").error(), "the file is empty"));
  EXPECT_TRUE(says(look("plain.obj.gz", obj_tetrahedron).error(), "has no gzip signature"));
  EXPECT_TRUE(says(look("a.xyz.gz", gzip(obj_tetrahedron)).error(), "neither PLY nor OFF"));
  EXPECT_TRUE(look("a.xyz.gz", gzip(off_tetrahedron)));
  EXPECT_TRUE(says(look("empty.off.gz", gzip("")).error(), "the file is empty"));
  EXPECT_TRUE(says(look("cut.off.gz", gzip(off_tetrahedron).substr(0, 40)).error(),
                   "the gzip stream is cut off"));
  // The format may be told only by several members together.
  EXPECT_TRUE(look("a.gz", gzip("pl") + gzip(ply_tetrahedron.substr(2))));
  // What is behind the start is not seen.
  std::string large(off_tetrahedron);
  for (int i = 0; i < 100000; ++i) large += std::to_string(i * 7919 % 100003) + "\n";
  EXPECT_TRUE(look("large.off", large));
  EXPECT_TRUE(look("large.off.gz", gzip(large).substr(0, 100000)));
  EXPECT_TRUE(says(look_at_mesh(folder() / "absent.obj").error(), "cannot be read: No such file"));
  EXPECT_TRUE(says(look_at_mesh(folder()).error(), "cannot be read: Is a directory"));
}

TEST_F(MeshSequence, LookingAheadNamesTheFirstFileThatCannotBeRead) {
  Paths paths = {write("a.obj", obj_tetrahedron), write("b.obj", "nonsense")};
  ASSERT_TRUE(SequenceReader(paths).look_ahead());
  paths.push_back(folder() / "absent.obj");
  paths.push_back(folder() / "absent_too.obj");
  const auto ahead = SequenceReader(paths).look_ahead();
  ASSERT_FALSE(ahead);
  EXPECT_NE(ahead.error().message.find("absent.obj"), std::string::npos) << ahead.error().message;
}

TEST_F(MeshSequence, WrittenFramesReadBackBitByBit) {
  using Limits = std::numeric_limits<double>;
  Sequence sequence;
  sequence.triangles.resize(2, 3);
  sequence.triangles << 0, 1, 2, 2, 1, 3;
  for (int f = 0; f < 3; ++f) {
    detector::Positions x(4, 3);
    x << 0.1, -0.0, Limits::denorm_min(), Limits::max(), -Limits::max(), 1e-300, f, 1.0 / 3,
        std::nextafter(1.0, 2.0), -7, 1e17, 0.3;
    sequence.frames.push_back(x);
  }
  const auto paths = write_sequence(folder() / "out" / "deep", sequence);
  ASSERT_TRUE(paths) << paths.error().message;
  EXPECT_EQ(paths.value()[2].filename(), "frame_0002.ply");
  const auto back = read_sequence(paths.value());
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back.value().triangles, sequence.triangles);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(0, std::memcmp(back.value().frames[f].data(), sequence.frames[f].data(),
                             sizeof(double) * 12));
  }
  // Nothing but the frames is left in the folder.
  const std::filesystem::directory_iterator files(folder() / "out" / "deep");
  EXPECT_EQ(std::distance(begin(files), end(files)), 3);
}

TEST_F(MeshSequence, WhatCannotBeWritten) {
  const detector::Positions x = detector::Positions::Zero(3, 3);
  detector::Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const auto absent = write_mesh(folder() / "absent" / "a.ply", x, triangles);
  ASSERT_FALSE(absent);
  EXPECT_TRUE(says(absent.error(), "cannot be written"));
  // A folder stands where the file should go: the file beside it must be gone again.
  std::filesystem::create_directories(folder() / "b.ply" / "c");
  ASSERT_FALSE(write_mesh(folder() / "b.ply", x, triangles));
  const std::filesystem::directory_iterator files(folder());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
  const auto blocked = write_sequence(write("file", "x") / "folder", Sequence{triangles, {x}});
  ASSERT_FALSE(blocked);
  EXPECT_TRUE(says(blocked.error(), "cannot be made"));
}

}  // namespace
}  // namespace assay::corpus
