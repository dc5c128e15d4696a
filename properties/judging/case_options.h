// Turns the detector's options into the words of a case file, and back; detector/options.h lists
// these words. The word for a separation is the shortest decimal that gives back the same double.
// The option `limits` has the value `asked` if the detector was also asked how far each step may
// go.
#pragma once

#include <map>
#include <string>

#include "properties/worker/case_run.h"

namespace assay::properties {

// Returns the options that a case states; an option that the case does not state has its default.
// Fails if a name or a word is unknown; the problem does not name the case's file.
Expected<Options> read_options(const Case& c);
// Reads the options as a configuration of this name.
Expected<Configuration> read_configuration(const Case& c, std::string name);

// Returns the options of a case that is known to state its options correctly. Unknown options are
// ignored.
Options options_of(const Case& c);

// Return the words with which a case states these options: always culling, start and pairs, and
// each other option that is not the default.
using OptionWords = std::map<std::string, std::string, std::less<>>;
OptionWords options_text(const Options& options);
OptionWords configuration_text(const Configuration& configuration);

}  // namespace assay::properties
