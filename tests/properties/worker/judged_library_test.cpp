// A library that is built anew while it is judged ends the run.
#include "properties/worker/plugin/judged_library.h"

#include "corpus/digest.h"
#include "properties/worker/worker_process.h"
#include "tests/problem_words.h"
#include "tests/properties/worker/worker_cases.h"

namespace assay::properties {
namespace {

namespace fs = std::filesystem;
using detector::Answer, test::plugin, test::plugin_alone, test::small_case;

class JudgedLibraries : public testing::Test {
 protected:
  JudgedLibraries() {
    std::string name = (fs::temp_directory_path() / "assay-judged-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~JudgedLibraries() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }
  // Writes over the bytes, as cp does, or puts another file in the place, as a linker does.
  void put(const std::string& original, const std::string& name, bool over = false) const {
    if (!over) fs::remove(file(name));
    std::ifstream from(original, std::ios::binary);
    std::ofstream(file(name), std::ios::binary) << from.rdbuf();
  }
  static std::string digest_of(const fs::path& file) {
    return corpus::sha256_of_file(file).value();
  }
  static Answer answer(WorkerProcess& worker) {
    const auto run = worker.run(small_case(31, 0), plugin_alone)[0];
    EXPECT_EQ(run.end, RunEnd::completed) << run.explanation;
    return run.steps.empty() ? Answer::error : run.steps[0].answer;
  }

 private:
  fs::path folder_;
};

TEST_F(JudgedLibraries, ServeNoMoreWhereTheyChange) {
  for (const bool over : {false, true}) {
    put(plugin("always_free"), "mine.so");
    const auto free = digest_of(file("mine.so"));
    {
      WorkerProcess first(ASSAY_WORKER, file("mine.so"));
      EXPECT_EQ(answer(first), Answer::free);
      const auto judged = JudgedLibrary::of(file("mine.so"), ASSAY_WORKER);
      EXPECT_TRUE(judged->is_as_it_was());
      // Who has loaded it goes on where another file lies in its place.
      put(plugin("always_collision"), "mine.so");
      WorkerProcess second(ASSAY_WORKER, file("mine.so"));
      const auto described = second.describe();
      ASSERT_FALSE(described);
      EXPECT_EQ(described.error().message,
                file("mine.so").string() +
                    ": it changed while it was judged; start again in another folder");
      EXPECT_EQ(judged->digest().value(), free);
      EXPECT_FALSE(judged->is_as_it_was());
    }
    put(plugin("always_collision"), "mine.so", over);
    WorkerProcess later(ASSAY_WORKER, file("mine.so"));
    EXPECT_EQ(answer(later), Answer::collision);
    EXPECT_NE(JudgedLibrary::of(file("mine.so"), ASSAY_WORKER)->digest().value(), free);
  }
}

TEST_F(JudgedLibraries, AreJudgedWithWhatTheyNeed) {
  put(plugin("with_neighbour"), "mine.so");
  put(ASSAY_PLUGIN_DIR "/free/beside.so", "beside.so");
  EXPECT_EQ(needed_files(file("mine.so")), std::vector{file("beside.so")});
  EXPECT_TRUE(needed_files(plugin("always_free")).empty());
  const auto both = corpus::sha256_of(digest_of(file("mine.so")) + digest_of(file("beside.so")));
  WorkerProcess first(ASSAY_WORKER, file("mine.so"));
  EXPECT_EQ(answer(first), Answer::free);
  const auto judged = JudgedLibrary::of(file("mine.so"), ASSAY_WORKER);
  EXPECT_EQ(judged->digest().value(), both);
  put(ASSAY_PLUGIN_DIR "/collision/beside.so", "beside.so");
  EXPECT_TRUE(says(judged->is_as_it_was().error(), "beside.so: it changed while it was judged"));
}

TEST_F(JudgedLibraries, MayBeNoLibraries) {
  for (const std::string bytes : {"", "\177ELF", "\177ELF\2\1\1", "text"}) {
    std::ofstream(file("none.so")) << bytes << std::string(bytes.size() > 5 ? 200 : 0, '\377');
    EXPECT_TRUE(needed_files(file("none.so")).empty());
    WorkerProcess worker(ASSAY_WORKER, file("none.so"));
    const auto described = worker.describe();
    ASSERT_FALSE(described);
    EXPECT_TRUE(says(described.error(), "not a detector plug-in"));
  }
  EXPECT_FALSE(JudgedLibrary::of(file("nowhere.so"), ASSAY_WORKER)->digest());
}

}  // namespace
}  // namespace assay::properties
