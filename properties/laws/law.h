#pragma once
#include <span>
#include <string_view>
#include "corpus/case_file.h"
#include "oracle/step.h"
#include "properties/campaign/record.h"
namespace assay::properties {
struct Law { std::string_view name; };
inline std::span<const Law> laws() { return {}; }
inline void add_law_counts(const corpus::Case&, const detector::Options&, std::span<const detector::StepResult>, std::span<const oracle::StepJudgement>, Counts&) {}
}
