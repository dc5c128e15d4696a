// A detector in Python by its word: what the word may be, what serves it, which file it is of, and
// what tells it from another one.
#include "properties/worker/plugin/python_word.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>

#include "corpus/digest.h"
#include "properties/campaign/plugin_digest.h"

namespace assay::properties {
namespace {

namespace fs = std::filesystem;

class PythonWords : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / "python_words";
    fs::remove_all(folder_);
    write("bin/assay-worker", "");
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
  EXPECT_EQ(nowhere.error().kind, ProblemKind::not_found);
  EXPECT_NE(nowhere.error().message.find("python:a:B: the Python module"), std::string::npos);
  EXPECT_FALSE(python_plugin("python:a", worker()));

  for (const char* place : {"lib/python3.11/dist-packages/assay", ".", "bin/python/assay"}) {
    write(fs::path(place) / "python_detector.so", "");
    const auto found = python_plugin("python:a:B", worker());
    ASSERT_TRUE(found) << place;
    EXPECT_TRUE(fs::equivalent(found.value(), folder_ / place / "python_detector.so")) << place;
  }
}

TEST_F(PythonWords, AreOfAFile) {
  EXPECT_FALSE(python_module_file("python:mine:B"));
  write("more/mine/__init__.py", "");
  ASSERT_TRUE(python_module_file("python:mine:B"));
  EXPECT_EQ(python_module_file("python:mine:B").value(), folder_ / "more/mine/__init__.py");
  write("more/mine/inner.py", "");
  EXPECT_EQ(python_module_file("python:mine.inner:B").value(), folder_ / "more/mine/inner.py");
  EXPECT_FALSE(python_module_file("python:mine.other:B"));
}

TEST_F(PythonWords, AreToldApartByThatFileAndWhatServesThem) {
  EXPECT_FALSE(digest_of_plugin("python:mine:B", worker()));
  write("bin/python/assay/python_detector.so", "library");
  EXPECT_FALSE(digest_of_plugin("python:mine:B", worker()));
  write("more/mine.py", "one");
  const auto one = digest_of_plugin("python:mine:B", worker()).value();
  EXPECT_EQ(one, digest_of_plugin("python:mine:B", worker()).value());
  write("more/mine.py", "two");
  const auto two = digest_of_plugin("python:mine:B", worker()).value();
  EXPECT_NE(one, two);
  write("bin/python/assay/python_detector.so", "another library");
  EXPECT_NE(two, digest_of_plugin("python:mine:B", worker()).value());

  const auto library = folder_ / "bin/python/assay/python_detector.so";
  EXPECT_EQ(digest_of_plugin(library, worker()).value(), corpus::sha256_of("another library"));
}

}  // namespace
}  // namespace assay::properties
