#include "reports/page/data/page_file.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "reports/terminal/words.h"

namespace assay::reports {

std::string script_safe(const nlohmann::ordered_json& data) {
  const std::string text =
      data.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  // In JSON these characters stand within strings only, and there \u means the same.
  static const std::map<char, std::string_view> written = {
      {'<', "\\u003c"}, {'>', "\\u003e"}, {'&', "\\u0026"}};
  return replaced(text, written);
}

std::string page_text(std::string_view page, const nlohmann::ordered_json& data) {
  constexpr std::string_view mark = "ASSAY_REPORT_DATA";
  const auto at = page.find(mark);
  if (at == std::string_view::npos || page.find(mark, at + 1) != std::string_view::npos)
    throw std::logic_error("the template of the page must hold its mark once");
  std::string out(page.substr(0, at));
  out += script_safe(data);
  out += page.substr(at + mark.size());
  return out;
}

}  // namespace assay::reports
