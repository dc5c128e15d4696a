// The page as one file: the data put into the template that is built from reports/page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace assay::reports {

// The template, embedded when the program was built.
std::string_view page_template();

// JSON that may stand inside a script element: no '<', '>' or '&', and only ASCII (so no U+2028).
// Text that is no UTF-8 is replaced.
std::string script_safe(const nlohmann::ordered_json& data);

// REQUIRES a template that holds the mark of the data exactly once, as page_template() does.
std::string page_text(std::string_view page, const nlohmann::ordered_json& data);

}  // namespace assay::reports
