// A table of answers beside the frames of `check`, in place of a detector.
#pragma once

#include <memory>
#include <string>

#include "reports/check/step_answers.h"

namespace assay::reports {

// Answers to the steps of `input` from a table FILE.csv with the columns step, answer and time: the
// step counted from 1, free, collision, undecided or error, and a time of contact, which may be
// empty. Claimed is that no step with a contact is called free, and, where a time is given, that no
// contact begins before it. Rows are in any order; steps without a row are left out. Fails if the
// file is no such table, or names a step twice.
Expected<std::unique_ptr<StepAnswers>> answers_of_table(const std::string& file,
                                                        const CheckInput& input,
                                                        properties::Adjacency adjacency);

}  // namespace assay::reports
