#include "reports/check/checked_steps.h"

#include <boost/outcome/try.hpp>
#include <utility>

#include "corpus/formats/sequence_reader.h"

namespace assay::reports {
namespace {

using detector::Positions;

class StepsOfCase : public CheckedSteps {
 public:
  StepsOfCase(std::shared_ptr<const corpus::Case> c, bool is_case_file)
      : case_(std::move(c)), script_(corpus::steps_of(*case_)), is_case_file_(is_case_file) {}

  std::size_t count() const override { return script_.size(); }
  std::size_t frames() const override { return case_->frames.size(); }
  const detector::Triangles& triangles() const override { return case_->triangles; }
  const Positions& first_frame() const override { return case_->frames.front(); }

  corpus::Expected<CheckedStep> step(std::size_t s) override {
    return CheckedStep{start_of(*case_, script_[s]), end_of(*case_, script_[s]),
                       view_of_step(*case_, s), script_[s].commit};
  }

  std::shared_ptr<const corpus::Case> whole() const override { return case_; }
  const corpus::Case* case_file() const override { return is_case_file_ ? case_.get() : nullptr; }

  corpus::Expected<std::unique_ptr<CheckedSteps>> read_whole() override {
    return steps_of_case(case_, is_case_file_);
  }

 private:
  std::shared_ptr<const corpus::Case> case_;
  std::vector<corpus::CaseStep> script_;
  bool is_case_file_;
};

// Consecutive steps share a frame: the end of one is the start of the next.
class StepsOfFiles : public CheckedSteps {
 public:
  StepsOfFiles(corpus::SequenceReader reader, Positions first, Positions second)
      : reader_(std::move(reader)), x_t0_(std::move(first)), x_t1_(std::move(second)) {}

  std::size_t count() const override { return reader_.frames() - 1; }
  std::size_t frames() const override { return reader_.frames(); }
  const detector::Triangles& triangles() const override { return reader_.triangles(); }
  const Positions& first_frame() const override { return x_t0_; }

  corpus::Expected<CheckedStep> step(std::size_t s) override {
    if (s > step_) {
      BOOST_OUTCOME_TRYV(go_on());
    }
    return CheckedStep{x_t0_, x_t1_};
  }

  corpus::Expected<std::unique_ptr<CheckedSteps>> read_whole() override {
    corpus::Case c;
    c.triangles = reader_.triangles();
    c.frames.push_back(std::move(x_t0_));
    c.frames.push_back(std::move(x_t1_));
    while (!reader_.at_end()) {
      BOOST_OUTCOME_TRY(frame, reader_.next());
      c.frames.push_back(std::move(frame));
    }
    return steps_of_case(std::make_shared<const corpus::Case>(std::move(c)), false);
  }

 private:
  corpus::Expected<void> go_on() {
    x_t0_.swap(x_t1_);
    x_t1_.resize(0, 3);  // so that there are not three while the next one is read
    BOOST_OUTCOME_TRY(frame, reader_.next());
    x_t1_ = std::move(frame);
    ++step_;
    return boost::outcome_v2::success();
  }

  corpus::SequenceReader reader_;
  std::size_t step_ = 0;  // whose frames these are
  Positions x_t0_, x_t1_;
};

}  // namespace

std::unique_ptr<CheckedSteps> steps_of_case(std::shared_ptr<const corpus::Case> c,
                                            bool is_case_file) {
  return std::make_unique<StepsOfCase>(std::move(c), is_case_file);
}

corpus::Expected<std::unique_ptr<CheckedSteps>> steps_of_files(
    std::vector<std::filesystem::path> files) {
  corpus::SequenceReader reader(std::move(files));
  BOOST_OUTCOME_TRY(first, reader.next());
  if (reader.at_end()) return one_frame_only();
  BOOST_OUTCOME_TRY(second, reader.next());
  BOOST_OUTCOME_TRYV(reader.look_ahead());
  return std::make_unique<StepsOfFiles>(std::move(reader), std::move(first), std::move(second));
}

corpus::Problem one_frame_only() {
  return corpus::problem_in({}, "one frame only: a step needs two frames or more");
}

}  // namespace assay::reports
