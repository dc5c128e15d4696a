// The detector's options as the words of a case file; detector/options.h lists these words. The
// separation is a number, as the shortest decimal that gives back the same double. `limits` is
// `asked` where the detector was asked, too, how far each step may be gone.
#pragma once

#include <map>
#include <string>

#include "corpus/cases/case_file.h"
#include "detector/options.h"
#include "properties/problem.h"
#include "properties/words.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// The options that a case states; the others are the defaults. Fails at an unknown name or word;
// the problem does not name the case's file.
Expected<detector::Options> read_options(const corpus::Case& c);
// The same as a configuration of this name.
Expected<Configuration> read_configuration(const corpus::Case& c, std::string name);

// The same for a case whose options are known to be understood. Options that are not understood
// are ignored.
detector::Options options_of(const corpus::Case& c);

// The words with which a case states these options: culling, start and pairs always, the others if
// they are not the default.
using OptionWords = std::map<std::string, std::string, std::less<>>;
OptionWords options_text(const detector::Options& options);
OptionWords configuration_text(const Configuration& configuration);

}  // namespace assay::properties
