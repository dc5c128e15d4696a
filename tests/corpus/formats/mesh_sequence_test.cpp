// Sequences of frames, and the writer of meshes: a written mesh is read back bit by bit.
#include "corpus/formats/sequences.h"
#include "corpus/formats/step_source.h"
#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

using Paths = std::vector<std::filesystem::path>;

class MeshSequence : public Scratch {
 protected:
  Paths frames(const std::vector<std::string>& texts) const {
    Paths paths;
    for (const std::string& text : texts)
      paths.push_back(write("frame" + std::to_string(paths.size()) + ".obj", text));
    return paths;
  }
};

TEST_F(MeshSequence, FramesOfDifferentFormats) {
  const Paths paths = {write("a.obj", obj_tetrahedron), write("b.ply", ply_tetrahedron),
                       write("c.off.gz", gzip(off_tetrahedron))};
  const auto sequence = value_of(read_sequence(paths));
  EXPECT_EQ(sequence.frames.size(), 3U);
  EXPECT_EQ(sequence.frames[0], sequence.frames[2]);
  EXPECT_EQ(sequence.triangles.rows(), 4);
}

TEST_F(MeshSequence, ProblemsNameBothFiles) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto expect = [&](std::string_view words, const std::vector<std::string>& texts) {
    const auto sequence = read_sequence(frames(texts));
    for (const std::string_view said :
         {words, std::string_view("frame0.obj"), std::string_view("frame1.obj")})
      EXPECT_TRUE(says(sequence, said));
  };
  expect("vertices, but", {triangle + "f 1 2 3\n", triangle + "v 9 9 9\nf 1 2 3\n"});
  expect("triangle 0 is (1, 2, 0), but", {triangle + "f 1 2 3\n", triangle + "f 2 3 1\n"});
  expect("2 triangles, but", {triangle + "f 1 2 3\n", triangle + "f 1 2 3\nf 1 3 2\n"});
  expect("two meshes need --body", {triangle + "f 1 2 3\n", triangle + "v 9 9 9\nf 1 2 3\n"});
}

TEST_F(MeshSequence, FramesAreTakenInTheOrderOfTheirNumbers) {
  const auto frame = [&](int number) {
    const auto x = std::to_string(number);
    return write("f" + x + ".obj", "v " + x + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  };
  const auto sequence = value_of(read_sequence(Paths{frame(1), frame(10), frame(2)}));
  EXPECT_EQ(sequence.frames[1](0, 0), 2);
  ASSERT_EQ(sequence.remarks.size(), 2u);
  EXPECT_EQ(sequence.remarks[0],
            "frames are taken in the order of their numbers: f2.obj before f10.obj");
}

TEST_F(MeshSequence, NoFramesAndBadFrames) {
  EXPECT_TRUE(says(read_sequence({}), "no mesh file is given"));
  const Paths paths = {write("a.obj", obj_tetrahedron), folder() / "absent.obj"};
  EXPECT_TRUE(says(read_sequence(paths), "cannot be read"));
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
  for (const char* said : {"vertices, but", "a.obj", "c.obj"}) EXPECT_TRUE(says(other, said));
}

TEST_F(MeshSequence, WhatIsSeenWithoutReading) {
  const auto look = [&](const std::string& name, std::string_view bytes) {
    return look_at_mesh(write(name, bytes));
  };
  EXPECT_TRUE(look("a.obj", obj_tetrahedron));
  EXPECT_TRUE(look("of_no_known_name", ply_tetrahedron));
  EXPECT_TRUE(says(look("a.xyz", obj_tetrahedron), "neither PLY nor OFF"));
  EXPECT_TRUE(says(look("empty.ply", ""), "the file is empty"));
  EXPECT_TRUE(says(look("plain.obj.gz", obj_tetrahedron), "has no gzip signature"));
  EXPECT_TRUE(says(look("a.xyz.gz", gzip(obj_tetrahedron)), "neither PLY nor OFF"));
  EXPECT_TRUE(look("a.xyz.gz", gzip(off_tetrahedron)));
  EXPECT_TRUE(says(look("empty.off.gz", gzip("")), "the file is empty"));
  EXPECT_TRUE(
      says(look("cut.off.gz", gzip(off_tetrahedron).substr(0, 40)), "the gzip stream is cut off"));
  // The format may be told only by several members together.
  EXPECT_TRUE(look("a.gz", gzip("pl") + gzip(ply_tetrahedron.substr(2))));
  // What is behind the start is not seen.
  std::string large(off_tetrahedron);
  for (int i = 0; i < 100000; ++i) large += std::to_string(i * 7919 % 100003) + "\n";
  EXPECT_TRUE(look("large.off", large));
  EXPECT_TRUE(look("large.off.gz", gzip(large).substr(0, 100000)));
  EXPECT_TRUE(says(look_at_mesh(folder() / "absent.obj"), "cannot be read: No such file"));
  EXPECT_TRUE(says(look_at_mesh(folder()), "cannot be read: Is a directory"));
}

TEST_F(MeshSequence, LookingAheadNamesTheFirstFileThatCannotBeRead) {
  Paths paths = {write("a.obj", obj_tetrahedron), write("b.obj", "nonsense")};
  ASSERT_TRUE(SequenceReader(paths).look_ahead());
  paths.push_back(folder() / "absent.obj");
  paths.push_back(folder() / "absent_too.obj");
  EXPECT_TRUE(says(SequenceReader(paths).look_ahead(), "absent.obj"));
}

TEST_F(MeshSequence, WrittenFramesReadBackBitByBit) {
  using Limits = std::numeric_limits<double>;
  Sequence sequence;
  sequence.triangles = tests::triangles_of("0 1 2, 2 1 3");
  for (int f = 0; f < 3; ++f) {
    detector::Positions x(4, 3);
    x << 0.1, -0.0, Limits::denorm_min(), Limits::max(), -Limits::max(), 1e-300, f, 1.0 / 3,
        std::nextafter(1.0, 2.0), -7, 1e17, 0.3;
    sequence.frames.push_back(x);
  }
  const auto paths = value_of(write_sequence(folder() / "out" / "deep", sequence));
  EXPECT_EQ(paths[2].filename(), "frame_0002.ply");
  const auto back = value_of(read_sequence(paths));
  EXPECT_EQ(back.triangles, sequence.triangles);
  for (std::size_t f = 0; f < 3; ++f)
    EXPECT_EQ(0,
              std::memcmp(back.frames[f].data(), sequence.frames[f].data(), sizeof(double) * 12));
  // Nothing but the frames is left in the folder.
  const std::filesystem::directory_iterator files(folder() / "out" / "deep");
  EXPECT_EQ(std::distance(begin(files), end(files)), 3);
}

TEST_F(MeshSequence, WhatCannotBeWritten) {
  const detector::Positions x = detector::Positions::Zero(3, 3);
  const auto triangles = tests::triangles_of("0 1 2");
  EXPECT_TRUE(says(write_mesh(folder() / "absent" / "a.ply", x, triangles), "cannot be written"));
  // A folder stands where the file should go: the file beside it must be gone again.
  std::filesystem::create_directories(folder() / "b.ply" / "c");
  ASSERT_FALSE(write_mesh(folder() / "b.ply", x, triangles));
  const std::filesystem::directory_iterator files(folder());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
  EXPECT_TRUE(says(write_sequence(write("file", "x") / "folder", Sequence{triangles, {x}}),
                   "cannot be made"));
}

// Several meshes as bodies of one: frames in step, vertices and triangles behind each other.

using Bodies = std::vector<std::vector<std::filesystem::path>>;

class BodiesOfFiles : public Scratch {
 protected:
  // A triangle at this height.
  std::filesystem::path triangle(const std::string& name, int z) const {
    const auto height = " " + std::to_string(z) + "\n";
    return write(name, "v 0 0" + height + "v 1 0" + height + "v 0 1" + height + "f 1 2 3\n");
  }
};

TEST_F(BodiesOfFiles, FollowEachOther) {
  const BodyFiles bodies = {{{triangle("a0.obj", 0), triangle("a1.obj", 1)},
                             {triangle("b0.obj", 5), triangle("b1.obj", 6)}},
                            {{1, 1}}};
  const auto steps = value_of(steps_of_bodies(bodies));
  EXPECT_EQ(steps->count(), 1u);
  EXPECT_EQ(steps->triangles(), tests::triangles_of("0 1 2, 3 4 5"));
  ASSERT_TRUE(steps->counted());
  EXPECT_EQ(steps->counted()->body, (std::vector<std::int32_t>{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(steps->counted()->apart, bodies.apart);
  const auto step = value_of(steps->step(0));
  EXPECT_EQ(step.x_t0(3, 2), 5);
  EXPECT_EQ(step.x_t1(0, 2), 1);
  EXPECT_EQ(step.x_t1(5, 2), 6);
}

TEST_F(BodiesOfFiles, OneFrameStandsStill) {
  const BodyFiles bodies = {{{triangle("still.obj", 3)},
                             {triangle("0.obj", 0), triangle("1.obj", 1), triangle("2.obj", 2)}},
                            {}};
  const auto whole = value_of(value_of(steps_of_bodies(bodies))->read_whole());
  const auto c = whole->whole();
  ASSERT_EQ(c->frames.size(), 3u);
  ASSERT_TRUE(c->counted);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(c->frames[f](0, 2), 3);
    EXPECT_EQ(c->frames[f](3, 2), static_cast<double>(f));
  }
}

// One frame of each body, and one mesh alone, are at rest: a step that ends where it starts.
TEST_F(BodiesOfFiles, OneFrameOfAllIsAtRest) {
  for (const BodyFiles& bodies : {BodyFiles{{{triangle("a.obj", 3)}, {triangle("b.obj", 4)}}, {}},
                                  BodyFiles{{{triangle("a.obj", 3)}}, {}}}) {
    auto steps = value_of(steps_of_bodies(bodies));
    EXPECT_TRUE(steps->is_at_rest());
    ASSERT_EQ(steps->count(), 1u);
    const auto step = value_of(steps->step(0));
    EXPECT_EQ(step.x_t0, step.x_t1);
    EXPECT_EQ(step.x_t1(0, 2), 3);
    const auto whole = value_of(steps->read_whole());
    EXPECT_EQ(whole->whole()->frames.size(), 1u);
    EXPECT_EQ(whole->count(), 1u);
  }
}

TEST_F(BodiesOfFiles, OneMeshAloneHasNoRelation) {
  const auto steps = value_of(steps_of_files({triangle("0.obj", 0), triangle("1.obj", 1)}));
  EXPECT_EQ(steps->counted(), nullptr);
}

TEST_F(BodiesOfFiles, AreToldInWords) {
  const auto one = triangle("f1.obj", 1), two = triangle("f2.obj", 2), ten = triangle("f10.obj", 9);
  const auto text_of = [](const Bodies& frames) {
    return value_of(steps_of_bodies({frames, {}}))->text();
  };
  EXPECT_EQ(text_of({{one, two}}).title, "one mesh moving from f1.obj to f2.obj");
  EXPECT_EQ(text_of({{one, one}}).title, "one mesh at rest");
  const auto in_order = text_of({{one, ten, two}});
  EXPECT_EQ(in_order.title, "one mesh moving through 3 frames from f1.obj to f10.obj");
  EXPECT_EQ(in_order.files, (std::vector{one.string(), two.string(), ten.string()}));
  const auto two_bodies = text_of({{one, ten, two}, {two, one, one}});
  EXPECT_EQ(two_bodies.title, "2 bodies");
  EXPECT_EQ(two_bodies.files.size(), 6u);
  ASSERT_EQ(two_bodies.remarks.size(), 3u);
  EXPECT_TRUE(says(two_bodies.remarks[2], "in your order"));
  // The words outlive the reader of the files.
  auto steps = steps_of_files({one, ten, two});
  const auto whole = steps.value()->read_whole();
  EXPECT_EQ(whole.value()->text().remarks, in_order.remarks);
  EXPECT_EQ(whole.value()->whole()->frames[1](0, 2), 2);
}

// Two triangles that share an edge, and no vertex. At t = 1 the fourth vertex is `gap` beside the
// second one.
class DoubledCornersOfFiles : public BodiesOfFiles {
 protected:
  std::filesystem::path seam(const std::string& name, const std::string& gap) const {
    return write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 " + gap +
                           "\nv -0 1 -0\nv 1 1 0\nv 0 0 0\nf 1 2 3\nf 4 6 5\n");
  }
  std::string last_remark(const BodyFiles& files) const {
    const auto steps = steps_of_bodies(files);
    if (!steps) return steps.error().message;
    const auto text = steps.value()->text();
    return text.remarks.empty() ? "" : text.remarks.back();
  }
};

TEST_F(DoubledCornersOfFiles, AreToldAndWelded) {
  const auto a = seam("a.obj", "0"), b = seam("b.obj", "0"), apart = seam("c.obj", "1e-300");
  EXPECT_TRUE(says(last_remark({{{a, b}}}),
                   "4 vertices are at 2 places: neighbouring triangles share none"));
  EXPECT_TRUE(says(last_remark({{{a, apart}}}), "2 vertices are at 1 place: "));
  BodyFiles welded{{{a, b}}};
  welded.weld = true;
  EXPECT_TRUE(
      says(last_remark(welded), "welded: 4 vertices are at 2 places and count as 2 vertices"));
  const auto shared = tests::triangles_of("0 1 2, 1 5 2"),
             one_apart = tests::triangles_of("0 1 2, 3 5 2");
  EXPECT_EQ(steps_of_bodies(welded).value()->triangles(), shared);
  // A frame far behind counts, too; and the mesh as a whole is the same.
  welded.frames = {{a, b, b, apart}};
  EXPECT_EQ(steps_of_bodies(welded).value()->triangles(), one_apart);
  EXPECT_EQ(steps_of_bodies(welded).value()->read_whole().value()->triangles(), one_apart);
  // Bodies are not welded to each other.
  welded.frames = {{a, b}, {a, b}};
  EXPECT_EQ(steps_of_bodies(welded).value()->triangles().bottomRows(2),
            (shared.array() + 7).matrix());
  // What has no corner in common is not told.
  EXPECT_EQ(last_remark({{{triangle("0.obj", 0), triangle("1.obj", 1)}}}), "");
}

TEST_F(DoubledCornersOfFiles, ThatCollapseATriangleAreRefused) {
  const auto thin = write("thin.obj", "v 0 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3\n");
  BodyFiles files{{{thin, thin}}};
  files.weld = true;
  EXPECT_TRUE(says(last_remark(files), "--weld: triangle 0 "));
}

TEST_F(DoubledCornersOfFiles, RingsAndDistanceAtRestAreARelation) {
  const auto a = seam("a.obj", "0"), b = seam("b.obj", "0.5");
  const auto steps = value_of(steps_of_bodies({{{a, b}}, {}, 2, 0.25}));
  const auto* counted = steps->counted();
  ASSERT_TRUE(counted);
  EXPECT_EQ(counted->rings, 2);
  EXPECT_EQ(counted->rest_distance, 0.25);
  EXPECT_EQ(counted->rest[5], (detector::Point{1, 1, 0}));
  EXPECT_TRUE(counted->body.empty());
}

TEST_F(BodiesOfFiles, ThatDoNotFitAreRefused) {
  const auto three = std::vector{triangle("0.obj", 0), triangle("1.obj", 1), triangle("2.obj", 2)};
  const auto two = std::vector{triangle("3.obj", 0), triangle("4.obj", 1)};
  EXPECT_TRUE(says(steps_of_bodies({{three, two}, {}}),
                   "3.obj: 2 frames of body 1, but another body has 3 frames"));
  EXPECT_TRUE(says(steps_of_bodies({{two, two}, {{0, 2}}}), "a pair of bodies names body 2"));
}

}  // namespace
}  // namespace assay::corpus
