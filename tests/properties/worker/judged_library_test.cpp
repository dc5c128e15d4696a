// A run ends if the judged library is built anew during the run.
#include "properties/worker/plugin/judged_library.h"

#include "corpus/digest.h"
#include "properties/worker/worker_process.h"
#include "tests/problem_words.h"
#include "tests/properties/worker/worker_cases.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

namespace fs = std::filesystem;
using detector::Answer, test::plugin, test::plugin_alone, test::small_case;

class JudgedLibraries : public testing::Test {
 protected:
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
  const tests::Scratch folder_;
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
  EXPECT_EQ(needed_files(file("mine.so")).value(), std::vector{file("beside.so")});
  EXPECT_TRUE(needed_files(plugin("always_free")).value().empty());
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
    EXPECT_TRUE(needed_files(file("none.so")).value().empty());
    WorkerProcess worker(ASSAY_WORKER, file("none.so"));
    const auto described = worker.describe();
    ASSERT_FALSE(described);
    EXPECT_TRUE(says(described.error(), "not a detector plug-in"));
  }
  EXPECT_FALSE(JudgedLibrary::of(file("nowhere.so"), ASSAY_WORKER)->digest());
}

// A detector in Python by its word: what the word may be, what serves it, which file it is of, and
// what tells it from another one.

class PythonWords : public testing::Test {
 protected:
  void SetUp() override {
    write("bin/assay-worker", "");
    write("libexec/assay/assay-worker", "");
    ::setenv("PYTHONPATH", (folder_ / "more").c_str(), 1);
  }
  void TearDown() override { ::unsetenv("PYTHONPATH"); }

  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  fs::path worker() const { return folder_ / "bin/assay-worker"; }

  const tests::Scratch scratch_;
  const fs::path folder_ = scratch_ / "";
};

TEST_F(PythonWords, HaveAModuleAndAClass) {
  const auto word = python_word_of("python:some.inner.module_2:Mine");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->module, "some.inner.module_2");
  EXPECT_EQ(word->name, "Mine");
  EXPECT_EQ(word->text(), "some.inner.module_2:Mine");
  for (const char* none : {"libmine.so", "./python:a:B", "python:", "python:a",
                           "python:a:", "python::B", "python:a:B:C", "python:a..b:C",
                           "python:../a:B", "python:a:2B", "python:a b:C", "python:a:B.C"})
    EXPECT_FALSE(python_word_of(none)) << none;
  EXPECT_TRUE(names_python("python:"));
  EXPECT_FALSE(names_python("./python:a:B"));
}

TEST_F(PythonWords, AreServedByThePackageBesideTheWorker) {
  const auto nowhere = python_plugin("python:a:B", worker());
  ASSERT_FALSE(nowhere);
  EXPECT_TRUE(says(nowhere.error(), "python:a:B: the Python module"));
  EXPECT_FALSE(python_plugin("python:a", worker()));

  // As it is installed, by CMake and by pip, and as it was built.
  const char* const installed = "libexec/assay/assay-worker";
  for (const auto& [place, beside] :
       {std::pair("lib/python3.11/dist-packages/assay", folder_ / installed),
        std::pair(".", worker()), std::pair("bin/python/assay", worker())}) {
    write(fs::path(place) / "python_detector.so", "");
    const auto found = python_plugin("python:a:B", beside);
    ASSERT_TRUE(found) << place;
    EXPECT_TRUE(fs::equivalent(found.value(), folder_ / place / "python_detector.so")) << place;
  }
}

TEST_F(PythonWords, AreOfAFile) {
  EXPECT_FALSE(python_module_files("python:mine:B"));
  write("more/mine/__init__.py", "");
  EXPECT_EQ(python_module_files("python:mine:B").value(),
            std::vector<fs::path>{folder_ / "more/mine/__init__.py"});
  EXPECT_FALSE(python_module_files("python:mine.other:B"));
  // What a package is around, and what is imported by name from beside it.
  write("more/mine/inner.py", "import numpy\n  from .beside import a, b\nimport far as near\n");
  write("more/mine/beside.py", "");
  write("more/far.py", "");
  EXPECT_EQ(
      python_module_files("python:mine.inner:B").value(),
      (std::vector<fs::path>{folder_ / "more/mine/inner.py", folder_ / "more/mine/__init__.py",
                             folder_ / "more/mine/beside.py", folder_ / "more/far.py"}));
}

TEST_F(PythonWords, AreToldApartByThatFileAndWhatServesThem) {
  const auto digest = [&] { return JudgedLibrary::of("python:mine:B", worker())->digest(); };
  EXPECT_FALSE(digest());
  write("bin/python/assay/python_detector.so", "library");
  EXPECT_FALSE(digest());
  write("more/mine.py", "one");
  const auto one = digest().value();
  EXPECT_EQ(one, digest().value());
  write("more/mine.py", "two");
  const auto two = digest().value();
  EXPECT_NE(one, two);
  write("bin/python/assay/python_detector.so", "another library");
  EXPECT_NE(two, digest().value());

  const auto library = folder_ / "bin/python/assay/python_detector.so";
  EXPECT_EQ(JudgedLibrary::of(library, worker())->digest().value(),
            corpus::sha256_of("another library"));
}

}  // namespace
}  // namespace assay::properties
