// Turns the detector's options into the words of a case file, and back; detector/options.h lists
// these words. The separation is a number, as the shortest decimal that gives back the same double.
// `limits` is `asked` if the detector was also asked how far each step may go.
#pragma once

#include <map>
#include <string>

#include "properties/worker/case_run.h"

namespace assay::properties {

// Reads the options that a case states; the others are the defaults. Fails at an unknown name or
// word; the problem does not name the case's file.
Expected<Options> read_options(const Case& c);
// Reads the options as a configuration of this name.
Expected<Configuration> read_configuration(const Case& c, std::string name);

// Returns the options of a case that is known to state them correctly. Options that are not
// understood are ignored.
Options options_of(const Case& c);

// Return the words with which a case states these options: culling, start and pairs always, the
// others if they are not the default.
using OptionWords = std::map<std::string, std::string, std::less<>>;
OptionWords options_text(const Options& options);
OptionWords configuration_text(const Configuration& configuration);

}  // namespace assay::properties
