// `check` on long sequences of files: it needs the memory of a few frames only, and it reports a
// bad frame in a sequence.
#include "corpus/formats/sequences.h"
#include "corpus/scenes/scenes.h"
#include "reports/check/check_run.h"
#include "reports/terminal/work.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

class LongSequence : public testing::Test {
 protected:
  // The frames of a sphere that grows.
  std::vector<std::string> sphere(int triangles, int frames) const {
    const std::string folder = scratch / "sphere";
    expect_ended("scene breathing-sphere --size " + std::to_string(triangles) + " --frames " +
                     std::to_string(frames) + " --out " + folder,
                 0);
    std::vector<std::string> files;
    for (const auto& file : std::filesystem::directory_iterator(folder))
      files.push_back(file.path().string());
    std::sort(files.begin(), files.end());
    return files;
  }

  std::uint64_t peak_memory(const std::string& frames) const {
    const std::string report = scratch / "report.json";
    EXPECT_EQ(run_assay("check --no-oracle --json " + report + frames).exit_code, 0);
    return nlohmann::json::parse(read_text(report)).at("peak_memory_bytes");
  }

  const Scratch scratch;
};

TEST_F(LongSequence, TakesTheMemoryOfAFewFrames) {
  constexpr std::size_t many = 300;
  const auto files = sphere(20000, 3);
  std::string few, all;  // there and back, again and again
  for (const auto& file : files) few += " " + file;
  for (std::size_t f = 0; f < many; ++f) all += " " + files[f % 4 == 3 ? 1 : f % 4];
  // 10,000 vertices of 24 bytes: 70 MB more if all were kept. What is left is for the report.
  constexpr std::size_t a_frame = 240000;
  EXPECT_LT(peak_memory(all), peak_memory(few) + many * a_frame / 5);
}

class BadLateFrame : public LongSequence {
 protected:
  void SetUp() override {
    files = sphere(80, 5);
    good = read_text(files[3]);
  }

  std::string arguments() const {
    std::string all = "check --threads 1 --jobs 1";
    for (const auto& file : files) all += " " + file;
    return all;
  }

  // The fourth frame is found to be bad when its step comes.
  void expect_two_steps(const std::string& text, const std::vector<std::string>& words) {
    SCOPED_TRACE(words.back());
    files[3] = scratch.write("bad.obj", text);
    const std::string report = scratch / "report.json";
    const Outcome outcome = run_assay(arguments() + " --json " + report);
    for (const auto& word : words) expect_one_line(outcome, word);
    expect_ended(outcome, 2, {"; 4 steps;", "step 1: free", "step 2: free"});
    EXPECT_FALSE(says(outcome.out, "step 3"));
    EXPECT_FALSE(std::filesystem::exists(report));
  }

  std::vector<std::string> files;
  std::string good;
};

TEST_F(BadLateFrame, EndsTheCheckAfterTheStepsBeforeIt) {
  const std::string tetrahedron =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  expect_two_steps(tetrahedron, {"frame_0000.ply", "bad.obj", "vertices"});
  expect_two_steps(good.substr(0, good.size() - 20), {"bad.obj"});
  // The same vertices, and one triangle that begins with another of its corners.
  std::string other = good;
  std::rotate(other.end() - 12, other.end() - 8, other.end());
  expect_two_steps(other, {"frame_0000.ply", "bad.obj", "triangle 79 is"});
}

TEST_F(BadLateFrame, IsRefusedAtOnceWhereThatCanBeSeen) {
  files[3] = scratch / "absent.ply";
  expect_refused(arguments(), "absent.ply");
  files[3] = scratch.write("frame.xyz", "1 2 3\n");
  expect_refused(arguments(), "frame.xyz");
  files[3] = scratch.write("empty.obj", "");
  expect_refused(arguments(), "empty.obj");
}

TEST_F(BadLateFrame, IsRefusedAtOnceForAPlugInBecauseItIsSentTheWholeCase) {
  files[3] = scratch.write("cut.ply", good.substr(0, good.size() - 20));
  expect_refused(arguments() + " --detector " ASSAY_PLUGIN_DIR "/plugin_example.so", "cut.ply");
}

// As long as `seconds` of processor time.
void work(double seconds) {
  const std::clock_t begin = std::clock();
  while (static_cast<double>(std::clock() - begin) < seconds * CLOCKS_PER_SEC) {
  }
}

TEST(ReadingFrames, TakesNoneOfTheTimeLimit) {
  reports::Limits limits(0.05, {});
  {
    const reports::Limits::Pause pause(limits);
    work(0.1);
  }
  EXPECT_FALSE(limits.exceeded());
  work(0.1);
  EXPECT_TRUE(limits.exceeded());
}

// The steps that `check` goes through: the same frames from files, one after another, as of a case
// that is at hand as a whole.
using reports::CheckInput;

class CheckedSteps : public testing::Test {
 protected:
  // A sphere of four frames, and its files.
  void SetUp() override {
    files = {scratch / "0.ply", scratch / "1.ply", scratch / "2.ply", scratch / "3.ply"};
    auto scene = value_of(corpus::make_scene("breathing-sphere", {80, 4, {}}));
    for (std::size_t f = 0; f < files.size(); ++f)
      ASSERT_TRUE(corpus::write_mesh(files[f], scene.frames[f], scene.triangles));
    frames = scene.frames;
  }

  Scratch scratch;
  std::vector<std::string> files;
  std::vector<detector::Positions> frames;
};

TEST_F(CheckedSteps, OfFilesAreReadOnceAndOnTheWay) {
  CheckInput input = std::move(reports::read_check_input(files).value());
  auto& steps = *input.steps;
  EXPECT_EQ(input.file, files[0]);
  EXPECT_EQ(steps.count(), 3u);
  EXPECT_EQ(steps.frames(), 4u);
  EXPECT_EQ(steps.first_frame(), frames[0]);
  EXPECT_EQ(steps.whole(), nullptr);
  EXPECT_EQ(steps.case_file(), nullptr);
  // Once a frame was read its file may be gone, though it is the start of another step.
  for (std::size_t s = 0; s < steps.count(); ++s) {
    std::filesystem::remove(files[s]);
    const auto step = value_of(steps.step(s));
    EXPECT_EQ(step.x_t0, frames[s]);
    EXPECT_EQ(step.x_t1, frames[s + 1]);
    EXPECT_TRUE(step.commit);
    // Asked for again it is the same, and nothing is read.
    EXPECT_EQ(steps.step(s).value().x_t0, frames[s]);
  }
}

TEST_F(CheckedSteps, ABadFrameIsAProblemOfItsStep) {
  const std::string good = read_text(files[2]);
  scratch.write("2.ply", good.substr(0, good.size() / 2));
  CheckInput input = std::move(reports::read_check_input(files).value());
  ASSERT_TRUE(input.steps->step(0));
  const auto step = input.steps->step(1);
  EXPECT_TRUE(says(step, "2.ply"));
  CheckInput again = std::move(reports::read_check_input(files).value());
  EXPECT_TRUE(says(again.steps->read_whole(), step.error().message));
}

TEST_F(CheckedSteps, OfACaseFileAreThoseOfItsScript) {
  const std::string file = curated("D9b_centre_jump_second_step");
  const auto c = corpus::read_case(file).value();
  const auto input = std::move(reports::read_check_input({file}).value());
  auto& steps = *input.steps;
  ASSERT_NE(steps.case_file(), nullptr);
  EXPECT_EQ(steps.case_file()->options, c.options);
  const auto script = steps_of(c);
  ASSERT_EQ(steps.count(), script.size());
  for (std::size_t s = 0; s < script.size(); ++s) {
    EXPECT_EQ(steps.step(s).value().x_t0, start_of(c, script[s]));
    EXPECT_EQ(steps.step(s).value().x_t1, end_of(c, script[s]));
    EXPECT_EQ(steps.step(s).value().commit, script[s].commit);
    EXPECT_EQ(steps.step(s).value().view.has_value(), c.view.has_value());
  }
}

}  // namespace
}  // namespace assay::tests
