// Files written whole or not at all: by several at a time, and by who is killed.
#include "corpus/atomic_file.h"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <thread>

#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

class AtomicFile : public Scratch {
 protected:
  std::filesystem::path file() const { return folder() / "file"; }
  std::string text() const {
    std::ifstream in(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
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
        const auto seen = text();
        ASSERT_FALSE(seen.empty());
        EXPECT_EQ(seen.size(), 1000 + 1000 * static_cast<std::size_t>(seen[0] - 'a'));
        EXPECT_EQ(std::count(seen.begin(), seen.end(), seen[0]), std::ssize(seen));
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(files_here(), 1);
}

}  // namespace
}  // namespace assay::corpus
