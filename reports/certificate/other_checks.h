// The self-test and the short speed table, as evidence of a certificate.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace assay::reports {

using OnFacts = std::function<void(const std::string& name, const nlohmann::ordered_json& facts)>;

// Each family of `assay self-test`: {queries, contacts, contradictions, open, complete}.
void check_oracle(std::uint64_t queries, int jobs, const OnFacts& on_family);

// Each of speed_figures: {what, median, lo, hi, samples}, the ratio of processor times of
// interleaved steps of the built-in detector. 10 s.
void measure_speed(const OnFacts& on_figure);

}  // namespace assay::reports
