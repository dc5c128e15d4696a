// A detector in Python by its word: what the word may be, what serves it, which file it is of, and
// what tells it from another one.
#include "properties/worker/plugin/python_word.h"

#include <stdlib.h>
#include <unistd.h>

#include "corpus/digest.h"
#include "properties/worker/plugin/judged_library.h"
#include "tests/problem_words.h"

namespace assay::properties {
namespace {

namespace fs = std::filesystem;

class PythonWords : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("python_words_" + std::to_string(::getpid()));
    write("bin/assay-worker", "");
    write("libexec/assay/assay-worker", "");
    ::setenv("PYTHONPATH", (folder_ / "more").c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("PYTHONPATH");
    fs::remove_all(folder_);
  }

  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  fs::path worker() const { return folder_ / "bin/assay-worker"; }

  fs::path folder_;
};

TEST_F(PythonWords, HaveAModuleAndAClass) {
  const auto word = python_word_of("python:some.inner.module_2:Mine");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->module, "some.inner.module_2");
  EXPECT_EQ(word->name, "Mine");
  EXPECT_EQ(word->text(), "some.inner.module_2:Mine");
  for (const char* none : {"libmine.so", "./python:a:B", "python:", "python:a",
                           "python:a:", "python::B", "python:a:B:C", "python:a..b:C",
                           "python:../a:B", "python:a:2B", "python:a b:C", "python:a:B.C"}) {
    EXPECT_FALSE(python_word_of(none)) << none;
  }
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
  ASSERT_TRUE(python_module_files("python:mine:B"));
  EXPECT_EQ(python_module_files("python:mine:B").value().front(),
            folder_ / "more/mine/__init__.py");
  write("more/mine/inner.py", "");
  EXPECT_EQ(python_module_files("python:mine.inner:B").value().front(),
            folder_ / "more/mine/inner.py");
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
  EXPECT_FALSE(JudgedLibrary::of("python:mine:B", worker())->digest());
  write("bin/python/assay/python_detector.so", "library");
  EXPECT_FALSE(JudgedLibrary::of("python:mine:B", worker())->digest());
  write("more/mine.py", "one");
  const auto one = JudgedLibrary::of("python:mine:B", worker())->digest().value();
  EXPECT_EQ(one, JudgedLibrary::of("python:mine:B", worker())->digest().value());
  write("more/mine.py", "two");
  const auto two = JudgedLibrary::of("python:mine:B", worker())->digest().value();
  EXPECT_NE(one, two);
  write("bin/python/assay/python_detector.so", "another library");
  EXPECT_NE(two, JudgedLibrary::of("python:mine:B", worker())->digest().value());

  const auto library = folder_ / "bin/python/assay/python_detector.so";
  EXPECT_EQ(JudgedLibrary::of(library, worker())->digest().value(),
            corpus::sha256_of("another library"));
}

}  // namespace
}  // namespace assay::properties
