// Files: their digests, how they are written, which problems are found before they are read, and
// their order.
#include "corpus/files.h"

#include <signal.h>
#include <sys/wait.h>

#include "corpus/digest.h"
#include "corpus/formats/sequences.h"
#include "corpus/problem.h"
#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

// SHA-256 against the examples in print.

// NIST, "SHA-256 examples" (FIPS 180-4): no byte, one block, two blocks, a million times 'a'.
constexpr const char* of_nothing =
    "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr const char* of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* of_two_blocks =
    "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1";
constexpr const char* of_a_million =
    "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TEST(Digest, AgreesWithValuesInPrint) {
  EXPECT_EQ(sha256_of(""), of_nothing);
  EXPECT_EQ(sha256_of("abc"), of_abc);
  EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"), of_two_blocks);
  EXPECT_EQ(sha256_of(std::string(1'000'000, 'a')), of_a_million);
}

TEST(Digest, OfAFileIsThatOfItsBytes) {
  const auto path =
      std::filesystem::temp_directory_path() / ("assay-digest-test-" + std::to_string(getpid()));
  std::ofstream(path, std::ios::binary) << std::string(1'000'000, 'a');
  const auto digest = sha256_of_file(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(digest) << digest.error().message;
  EXPECT_EQ(digest.value(), of_a_million);
  EXPECT_TRUE(says(sha256_of_file(path), path.filename().string() + ": No such file"));
}

// Files written whole or not at all: by several at a time, and by who is killed.

class AtomicFile : public Scratch {
 protected:
  std::filesystem::path file() const { return folder() / "file"; }
  std::string text() const { return bytes_in(file()); }
  std::ptrdiff_t files_here() const {
    return std::distance(std::filesystem::directory_iterator(folder()), {});
  }
};

TEST_F(AtomicFile, ReplacesWhatIsThereAndLeavesNothingBeside) {
  for (const std::string words : {"a longer text", "short", ""}) {
    ASSERT_TRUE(write_file_atomically(file(), words));
    EXPECT_EQ(text(), words);
    EXPECT_EQ(files_here(), 1);
  }
}

TEST_F(AtomicFile, WhatFailsLeavesNothing) {
  std::filesystem::create_directory(file());
  EXPECT_FALSE(write_file_atomically(file(), "text"));  // no file becomes a folder
  EXPECT_EQ(files_here(), 1);
}

// What a killed writer left, long enough that it was not yet whole.
TEST_F(AtomicFile, TheNextWriterTakesUpWhatAKilledOneLeft) {
  ASSERT_TRUE(write_file_atomically(file(), "old"));
  const std::string large(std::size_t{1} << 26, 'x');
  bool was_left = false;
  for (int attempt = 0; attempt < 50 && !was_left; ++attempt) {
    const pid_t writer = fork();
    if (writer == 0) {
      for (;;) static_cast<void>(write_file_atomically(file(), large));
    }
    while (files_here() < 2) std::this_thread::yield();
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    was_left = files_here() > 1;
  }
  ASSERT_TRUE(was_left);
  EXPECT_TRUE(text() == "old" || text() == large);
  ASSERT_TRUE(write_file_atomically(file(), "new"));
  EXPECT_EQ(text(), "new");
  EXPECT_EQ(files_here(), 1);
}

TEST_F(AtomicFile, SeveralWritersAtATimeAreWhole) {
  constexpr int writers = 4, times = 200;
  std::vector<std::thread> threads;
  for (int w = 0; w < writers; ++w) {
    threads.emplace_back([&, w] {
      const std::string words(1000 + 1000 * w, static_cast<char>('a' + w));
      for (int i = 0; i < times; ++i) {
        EXPECT_TRUE(write_file_atomically(file(), words));
        const auto content = text();
        ASSERT_FALSE(content.empty());
        EXPECT_EQ(content.size(), 1000 + 1000 * static_cast<std::size_t>(content[0] - 'a'));
        EXPECT_EQ(std::count(content.begin(), content.end(), content[0]), std::ssize(content));
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(files_here(), 1);
}

// What may be wrong with a file before its content is looked at, and compressed files.

class FileProblems : public Scratch {};

TEST_F(FileProblems, MissingEmptyFolder) {
  EXPECT_TRUE(says(read_mesh(folder() / "absent.obj"), "absent.obj: cannot be read: No such file"));
  EXPECT_TRUE(says(mesh_problem("empty.obj", ""), "the file is empty"));
  EXPECT_TRUE(says(read_mesh(folder()), "cannot be read: Is a directory"));
}

TEST_F(FileProblems, NoPermission) {
  const auto path = write("locked.obj", obj_tetrahedron);
  std::filesystem::permissions(path, std::filesystem::perms::none);
  // The superuser may read everything; another user may not.
  const bool superuser = geteuid() == 0;
  ASSERT_TRUE(!superuser || seteuid(65534) == 0);
  const auto mesh = read_mesh(path);
  ASSERT_TRUE(!superuser || seteuid(0) == 0);
  EXPECT_TRUE(says(mesh, "cannot be read: Permission denied"));
}

TEST_F(FileProblems, MessagesAreOneLineWhateverThePath) {
  EXPECT_FALSE(says(read_mesh(folder() / "two\nlines.obj").error(), "\n"));
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
  for (std::size_t size = 1; size < good.size(); ++size)
    EXPECT_TRUE(says(mesh_problem("a.obj.gz", good.substr(0, size)), "the gzip stream")) << size;
  std::string wrong_sum = good;
  wrong_sum[wrong_sum.size() - 6] ^= 1;
  EXPECT_TRUE(says(mesh_problem("b.obj.gz", wrong_sum), "the gzip stream is damaged"));
  EXPECT_TRUE(says(mesh_problem("c.obj.gz", good + "tail"), "the gzip stream is damaged"));
  EXPECT_TRUE(says(mesh_problem("d.obj.gz", obj_tetrahedron), "has no gzip signature"));
  EXPECT_TRUE(says(mesh_problem("e.obj.gz", gzip("")), "the file is empty"));
}

TEST_F(FileProblems, DecompressedSizeIsLimited) {
  const auto path = write("big.gz", gzip(std::string(1 << 20, 'x')));
  EXPECT_EQ(value_of(read_bytes(path, 1 << 20)).size(), std::size_t{1} << 20);
  EXPECT_TRUE(says(read_bytes(path, (1 << 20) - 1), "larger than 1048575 bytes"));
  EXPECT_TRUE(says(read_bytes(write("plain", "12345"), 4), "larger than 4 bytes"));
}

// Files of frames in the order of their numbers, and what is said of that.

using Words = std::vector<std::string>;

void expect_order(const Words& input, const Words& expected, const std::string& remark) {
  const auto order = in_order_of_numbers({input.begin(), input.end()});
  Words files;
  for (const auto& file : order.files) files.push_back(file.string());
  EXPECT_EQ(files, expected);
  const std::string line = order.remarks.empty() ? "" : order.remarks.front();
  EXPECT_EQ(line.empty(), remark.empty()) << line;
  EXPECT_TRUE(says(line, remark));
}

void expect_as_given(const Words& input, const std::string& remark) {
  expect_order(input, input, remark);
}

TEST(FramesInOrder, TheOrderOfAShellIsPutInOrder) {
  const std::string line = "in the order of their numbers: ";
  expect_order({"d/sim_1.obj", "d/sim_10.obj", "d/sim_11.obj", "d/sim_2.obj"},
               {"d/sim_1.obj", "d/sim_2.obj", "d/sim_10.obj", "d/sim_11.obj"},
               line + "sim_2.obj before sim_10.obj");
  expect_order({"Sim_10.PLY", "sim_9.ply"}, {"Sim_10.PLY", "sim_9.ply"}, "");
  expect_order({"f-1-10.obj", "f-1-9.obj", "f-2-1.obj"}, {"f-1-9.obj", "f-1-10.obj", "f-2-1.obj"},
               line);
  expect_order({"run10/mesh.obj", "run9/mesh.obj"}, {"run9/mesh.obj", "run10/mesh.obj"},
               line + "run9/mesh.obj before run10/mesh.obj");
  // As bash lists them where LANG is en_US.UTF-8.
  expect_order({"d/sim_10.obj", "d/sim_11.obj", "d/sim_1.obj", "d/sim_2.obj"},
               {"d/sim_1.obj", "d/sim_2.obj", "d/sim_10.obj", "d/sim_11.obj"},
               line + "sim_1.obj before sim_10.obj");
  // What has another name stays where it is.
  expect_order({"rest.obj", "sim_10.obj", "sim_9.obj", "end.obj"},
               {"rest.obj", "sim_9.obj", "sim_10.obj", "end.obj"}, line);
  // Longer than any integer.
  const std::string nines(40, '9'), zeros(40, '0');
  expect_order({"1" + zeros + ".ply", nines + ".ply"}, {nines + ".ply", "1" + zeros + ".ply"},
               line);
}

TEST(FramesInOrder, AnyOtherOrderStaysAndIsTold) {
  const std::string line = "in your order, not in the order of their numbers: ";
  expect_as_given({"sim_10.obj", "sim_1.obj"}, line + "sim_10.obj before sim_1.obj");
  expect_as_given({"f1.obj", "f0.obj"}, line + "f1.obj before f0.obj");
  expect_as_given({"f0.obj", "f1.obj", "f0.obj"}, line + "f1.obj before f0.obj");
  expect_as_given({"s_10.obj", "s_2.obj", "s_1.obj"}, line);
  expect_as_given({"b.obj", "a.obj"}, "");
  expect_as_given({"sim_1.obj", "sim_2.obj", "sim_10.obj"}, "unevenly");
  expect_as_given({"sim_9.obj", "sim_10.obj", "sim_11.obj"}, "");
  expect_as_given({"two\nlines1.obj", "two\nlines0.obj"}, "two?lines1.obj before");
  expect_as_given({}, "");
}

TEST(FramesInOrder, DecimalsAreNumbersToo) {
  // As OpenFOAM names times: 0 and 0.5 are numbers of one kind.
  expect_order({"t_0.5.obj", "t_0.obj", "t_1.25.obj", "t_1.5.obj", "t_1.obj", "t_10.obj"},
               {"t_0.obj", "t_0.5.obj", "t_1.obj", "t_1.25.obj", "t_1.5.obj", "t_10.obj"},
               "order of their numbers: t_0.obj before t_0.5.obj");
  expect_as_given({"t_0.25.obj", "t_0.5.obj", "t_0.75.obj"}, "numbers may be whole or decimal");
  expect_as_given({"v1.1.obj", "v1.10.obj", "v1.2.obj"}, "their numbers may be whole or decimal");
  expect_as_given({"v1.9.obj", "v1.10.obj"}, "v1.9.obj before v1.10.obj: their");
  expect_as_given({"t_0.1.obj", "t_0.2.obj", "t_0.3.obj"}, "");
  expect_as_given({"sim.1.0008.obj", "sim.1.0009.obj", "sim.1.0010.obj"}, "");
}

TEST(FramesInOrder, GapsAndRepeatsAreTold) {
  expect_as_given({"f1.obj", "f2.obj", "f4.obj"}, "unevenly numbered: f4.obj follows f2.obj");
  expect_as_given({"f1.obj", "f2.obj", "f4.obj", "f5.obj", "f9.obj"},
                  "f4.obj follows f2.obj, and likewise at 1 more places");
  expect_as_given({"f0.obj", "f10.obj", "f20.obj", "f30.obj"}, "");
  expect_as_given({"f0.obj", "f10.obj", "f20.obj", "f25.obj"}, "f25.obj follows f20.obj");
  expect_as_given({"f1.obj", "f1.obj", "f2.obj"}, "repeated: f1.obj follows f1.obj");
  expect_as_given({"f01.obj", "f1.obj", "f2.obj"}, "repeated: f1.obj follows f01.obj");
  expect_as_given({"mesh2.obj", "mesh2.obj"}, "");
  expect_as_given({"f1.obj", "f5.obj"}, "");
  // Only one of the two numbers is that of the frame.
  expect_as_given({"take2_f1.obj", "take2_f2.obj", "take2_f4.obj"}, "f4.obj follows take2_f2.obj");
}

// A misspelt word means the nearest one that there is.

const std::vector<std::string> verbs = {"check", "self-test", "run", "verify"};

TEST(MeantWord, IsTheNearest) {
  EXPECT_EQ(meant_word(verbs, "chekc"), "check");
  EXPECT_EQ(meant_word(verbs, "chck"), "check");
  EXPECT_EQ(meant_word(verbs, "self_test"), "self-test");
  EXPECT_EQ(meant_word({"bend", "bond"}, "bnd"), "bend");
}

TEST(MeantWord, IsNoneThatIsFarNorAnotherThanTheWordItself) {
  EXPECT_EQ(meant_word({"bent", "bend"}, "bend"), "");
  EXPECT_EQ(meant_word(verbs, "judge"), "");
  // Two slips of three letters would make one short word of any other.
  EXPECT_EQ(meant_word(verbs, "rug"), "run");
  EXPECT_EQ(meant_word(verbs, "bug"), "");
  EXPECT_EQ(meant_word(verbs, ""), "");
}

TEST(MeantWord, EndsALine) {
  EXPECT_EQ(did_you_mean(verbs, "chekc"), "; did you mean check?");
  EXPECT_EQ(did_you_mean(verbs, "frobnicate"), "");
}

}  // namespace
}  // namespace assay::corpus
