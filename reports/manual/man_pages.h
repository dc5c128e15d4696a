// Man pages in the macros of man(7).
#pragma once

#include "reports/terminal/manual.h"

namespace assay::reports {

// What stands at the foot of each page.
struct ManFoot {
  std::string date, version;  // "2026-01-31", "0.3.0"
};

// The page assay(1), and assay-VERB(1).
std::string man_page(const std::vector<VerbManual>& verbs, const ManFoot& foot);
std::string man_page(const VerbManual& verb, const ManFoot& foot);

}  // namespace assay::reports
