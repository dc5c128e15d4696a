// Answers that are not asked for here, but were given before: by a log, or by a table beside the
// frames of `check`.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "corpus/formats/step_log.h"
#include "reports/check/step_answers.h"

namespace assay::reports {

class GivenAnswers : public StepAnswers {
 public:
  bool is_recorded() const override { return true; }
  nlohmann::ordered_json to_json() const override { return detector_json({{"library", nullptr}}); }

 protected:
  GivenAnswers(properties::Subject subject, const corpus::StepSource& steps)
      : StepAnswers(std::move(subject)), triangles_(steps.triangles()) {}

  // Begins the run of step s, which is undecided until an answer is taken.
  void begin_run(std::size_t s);
  // Reads the answer as that of a plug-in is read, and believes none of it.
  void take(const std::optional<corpus::LoggedAnswer>& logged);
  void take_error(const std::string& text);

 private:
  Expected<detector::StepResult> result_of(const corpus::LoggedAnswer& logged) const;

  const detector::Triangles& triangles_;
};

// Answers to the steps of `input` from a table FILE.csv with the columns step, answer and time: the
// step counted from 1, free, collision, undecided or error, and a time of contact, which may be
// empty. Claimed is that no step with a contact is called free, and, where a time is given, that no
// contact begins before it. Rows are in any order; steps without a row are left out. Fails if the
// file is no such table, or names a step twice.
Expected<std::unique_ptr<StepAnswers>> answers_of_table(const std::string& file,
                                                        const CheckInput& input,
                                                        properties::Adjacency adjacency);

}  // namespace assay::reports
