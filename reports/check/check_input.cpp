#include "reports/check/check_input.h"

#include <boost/outcome/try.hpp>
#include <filesystem>

#include "properties/judging/case_options.h"

namespace assay::reports {
namespace {

corpus::Expected<std::unique_ptr<CheckedSteps>> steps_of_case_file(const std::string& file) {
  BOOST_OUTCOME_TRY(c, corpus::read_case(file));
  if (const auto options = properties::read_options(c); !options) {
    return corpus::problem_in(file, options.error().message);
  }
  if (c.frames.size() < 2) return one_frame_only();
  return steps_of_case(std::make_shared<const corpus::Case>(std::move(c)), true);
}

}  // namespace

corpus::Expected<CheckInput> read_check_input(const std::vector<std::string>& files) {
  const bool is_case_file =
      files.size() == 1 && std::filesystem::path(files[0]).extension() == ".json";
  BOOST_OUTCOME_TRY(steps, is_case_file ? steps_of_case_file(files[0])
                                        : steps_of_files({files.begin(), files.end()}));
  return CheckInput{files[0], std::move(steps)};
}

}  // namespace assay::reports
