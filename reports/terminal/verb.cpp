#include "reports/terminal/verb.h"

#include <CLI/CLI.hpp>

namespace assay::reports {

VerbOption VerbOption::required() {
  option_->required();
  return *this;
}

VerbOption VerbOption::with(const Check& check) {
  option_->check(CLI::Validator(check.complaint, check.words));
  return *this;
}

VerbOption VerbOption::in_range(std::uint64_t least, std::uint64_t most) {
  option_->check(CLI::Range(least, most));
  return *this;
}

VerbOption VerbOption::shows_default() {
  option_->capture_default_str();
  return *this;
}

VerbOption VerbOption::excludes(VerbOption other) {
  option_->excludes(other.option_);
  return *this;
}

Verb::Verb(CLI::App& app, const std::string& name, const std::string& about)
    : app_(app.add_subcommand(name, about)) {}

VerbOption Verb::add(const std::string& name, std::string& target, const std::string& about) {
  return VerbOption(app_->add_option(name, target, about));
}
VerbOption Verb::add(const std::string& name, std::vector<std::string>& target,
                     const std::string& about) {
  return VerbOption(app_->add_option(name, target, about));
}
VerbOption Verb::add(const std::string& name, int& target, const std::string& about) {
  return VerbOption(app_->add_option(name, target, about));
}
VerbOption Verb::add(const std::string& name, std::uint64_t& target, const std::string& about) {
  return VerbOption(app_->add_option(name, target, about));
}
VerbOption Verb::add(const std::string& name, double& target, const std::string& about) {
  return VerbOption(app_->add_option(name, target, about));
}
VerbOption Verb::add(const std::string& name, std::optional<double>& target,
                     const std::string& about) {
  return VerbOption(app_->add_option(name, target, about));
}
VerbOption Verb::add_flag(const std::string& name, bool& target, const std::string& about) {
  return VerbOption(app_->add_flag(name, target, about));
}
VerbOption Verb::add_word(const std::string& name,
                          std::function<void(const std::string& word)> take,
                          const std::string& about) {
  return VerbOption(app_->add_option_function<std::string>(name, std::move(take), about));
}

}  // namespace assay::reports
