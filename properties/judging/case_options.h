// The detector's options in words: those of a case file, and of the command line for the first
// four.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "corpus/cases/case_file.h"
#include "detector/options.h"
#include "properties/problem.h"

namespace assay::properties {

// Nothing for an unknown word.
std::optional<detector::Culling> culling_named(std::string_view word);
std::optional<detector::Start> start_named(std::string_view word);
std::optional<detector::Pairs> pairs_named(std::string_view word);
std::optional<detector::Arithmetic> arithmetic_named(std::string_view word);
// The coarse forms, each as sound as the default: in a case file alone, for they are there to be
// compared on a mesh, not to be chosen in daily use.
std::optional<detector::Release> release_named(std::string_view word);
std::optional<detector::GhostTest> ghost_test_named(std::string_view word);

const char* name_of(detector::Culling culling);
const char* name_of(detector::Start start);
const char* name_of(detector::Pairs pairs);
const char* name_of(detector::Arithmetic arithmetic);
const char* name_of(detector::Release release);
const char* name_of(detector::GhostTest ghost_test);

// The options that a case states, the others as they are by default. unknown_option for a name or a
// word that is none; the case's file is not named.
Expected<detector::Options> read_options(const corpus::Case& c);

// The same for a case whose options are known to be understood. What is not understood is left out.
detector::Options options_of(const corpus::Case& c);

// Options as a case states them: culling, start and pairs always, the others where they are not the
// default.
std::map<std::string, std::string, std::less<>> options_text(const detector::Options& options);

}  // namespace assay::properties
