// L12: input that must be refused by name.
#pragma once

#include "properties/laws/law.h"

namespace assay::properties {

// Repeats the case's own run, with every kind of bad call before each step.
void check_bad_input(CaseFacts& facts, LawTally& tally);

}  // namespace assay::properties
