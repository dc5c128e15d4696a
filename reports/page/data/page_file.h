// Makes the page as one file: the data is put into the template that is built from reports/page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace assay::reports {

// The template, embedded when the program was built.
std::string_view page_template();

// The data as JSON that may stand inside a script element: no '<', '>' or '&', and only ASCII (so
// no U+2028). Text that is no UTF-8 is replaced.
std::string script_safe(const nlohmann::ordered_json& data);

// The template `page` with the data. REQUIRES that it holds the mark of the data exactly once, as
// page_template() does.
std::string page_text(std::string_view page, const nlohmann::ordered_json& data);

}  // namespace assay::reports
