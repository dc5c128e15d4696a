#include "reports/manual/pages.h"

#include <filesystem>

#include "reports/manual/completion.h"
#include "reports/manual/man_pages.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"

namespace assay::reports {

Expected<void> write_pages(const std::string& folder, const std::vector<VerbManual>& verbs) {
  const std::filesystem::path man = std::filesystem::path(folder) / "man",
                              completion = std::filesystem::path(folder) / "completion";
  std::error_code error;
  for (const auto& made : {man, completion}) {
    std::filesystem::create_directories(made, error);
    if (error) return Problem{made.string() + ": cannot be made: " + error.message()};
  }
  const ManFoot foot = {commit_date(), ASSAY_VERSION};
  BOOST_OUTCOME_TRYV(write_text_file(man / "assay.1", man_page(verbs, foot)));
  for (const auto& verb : verbs) {
    BOOST_OUTCOME_TRYV(write_text_file(man / ("assay-" + verb.name + ".1"), man_page(verb, foot)));
  }
  BOOST_OUTCOME_TRYV(write_text_file(completion / "assay.bash", bash_completion(verbs)));
  return write_text_file(completion / "_assay", zsh_completion(verbs));
}

}  // namespace assay::reports
