// The words for the detector's options in case files. The command line has words for the first
// four options.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "corpus/cases/case_file.h"
#include "detector/options.h"
#include "properties/problem.h"

namespace assay::properties {

// The option that a word stands for; nothing for an unknown word.
std::optional<detector::Culling> culling_named(std::string_view word);
std::optional<detector::Start> start_named(std::string_view word);
std::optional<detector::Pairs> pairs_named(std::string_view word);
std::optional<detector::Arithmetic> arithmetic_named(std::string_view word);
// These two have coarse forms, each as sound as the default. Only case files can choose them,
// because they are there to be compared on a mesh and not for daily use.
std::optional<detector::Release> release_named(std::string_view word);
std::optional<detector::GhostTest> ghost_test_named(std::string_view word);

const char* name_of(detector::Culling culling);
const char* name_of(detector::Start start);
const char* name_of(detector::Pairs pairs);
const char* name_of(detector::Arithmetic arithmetic);
const char* name_of(detector::Release release);
const char* name_of(detector::GhostTest ghost_test);

// The options that a case states; the others are the defaults. unknown_option for an unknown name
// or word; the problem does not name the case's file.
Expected<detector::Options> read_options(const corpus::Case& c);

// The same for a case whose options are known to be understood. Options that are not understood
// are ignored.
detector::Options options_of(const corpus::Case& c);

// The words with which a case states these options: culling, start and pairs always, the others if
// they are not the default.
std::map<std::string, std::string, std::less<>> options_text(const detector::Options& options);

}  // namespace assay::properties
