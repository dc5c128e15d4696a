// Answers that are not asked for here, but were given before: by a log, or by a table.
#pragma once

#include <optional>
#include <string>

#include "corpus/formats/step_log.h"
#include "reports/check/step_answers.h"

namespace assay::reports {

class GivenAnswers : public StepAnswers {
 public:
  bool is_recorded() const override { return true; }
  nlohmann::ordered_json to_json() const override { return detector_json({{"library", nullptr}}); }
  std::string error_of(std::size_t, const detector::StepResult&) const override;

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

}  // namespace assay::reports
