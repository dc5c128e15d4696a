// The detector's options in words: those of a case file, and of the command line for the first
// four.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "corpus/cases/case_file.h"
#include "detector/options.h"

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

// What is wrong with a case's options (an unknown name or word), as one line; nothing when they are
// understood.
std::optional<std::string> wrong_option(const corpus::Case& c);

// Options of a case that wrong_option accepts.
detector::Options options_of(const corpus::Case& c);

// Options as a case states them: culling, start and pairs always, the others where they are not the
// default.
std::map<std::string, std::string, std::less<>> options_text(const detector::Options& options);

}  // namespace assay::properties
