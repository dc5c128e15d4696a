// The steps that `check` goes through: the same frames from files, one after another, as of a case
// that is at hand as a whole.
#include "corpus/formats/sequences.h"
#include "corpus/scenes/scenes.h"
#include "reports/check/check_run.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

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
