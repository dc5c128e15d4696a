// A generated case with the results of the detector and the judgements of the oracle, for tests of
// laws.
#pragma once

#include "oracle/mesh/step.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/laws/law.h"
#include "properties/queries/query_families.h"
#include "properties/random.h"
#include "properties/worker/case_run.h"
#include "tests/test.h"

namespace assay::properties::test {

struct Setting {
  detector::Options options;
  bool own_primitives = false;  // the detector's primitives, even if the case states others
  StagesOf stages_of = detector::standard_stages;
};

// Returns a setting with Culling::view_point or view_line, sometimes with a culling that chooses
// views, and with own or stated primitives. A few settings have another start, or ask for first
// pairs.
inline Setting setting_of(std::string_view id) {
  Random random(Random::hash(id), 1);
  Setting setting;
  setting.options.culling =
      random.one_in(2) ? detector::Culling::view_point : detector::Culling::view_line;
  setting.own_primitives = random.one_in(3);
  if (random.one_in(8)) setting.options.pairs = detector::Pairs::first;
  if (random.one_in(16)) setting.options.start = detector::Start::unknown;
  if (random.one_in(16)) setting.options.start = detector::Start::clean;
  if (random.one_in(4))
    setting.options.culling =
        random.one_in(2) ? detector::Culling::view_auto : detector::Culling::automatic;
  return setting;
}

// Returns the setting for a law. L14 is about steps that prove patches apart, so it needs
// Culling::automatic.
inline Setting setting_for(const Law& law, std::string_view id) {
  Setting setting = setting_of(id);
  if (law.number == "L14") setting.options.culling = detector::Culling::automatic;
  return setting;
}

inline RandomCase case_of(const std::string& id) {
  const auto stratum = id.substr(0, id.rfind(':'));
  const auto name = stratum.substr(stratum.rfind(':') + 1);
  const Family* family = find_family(name);
  if (!family) throw std::invalid_argument("no family in the id " + id);
  return make_case(*family, id);
}

// Returns the case without its view primitive, so that the detector uses its own primitives.
inline corpus::Case without_view(corpus::Case c) {
  c.view.reset();
  return c;
}

// Owns all that CaseFacts refers to. Tests may change the results before they call facts().
class JudgedCase {
 public:
  JudgedCase(corpus::Case c, Setting setting)
      : source(setting.own_primitives ? without_view(std::move(c)) : std::move(c)),
        setting_(std::move(setting)),
        player_(CasePlayer::make(source, setting_.options, setting_.stages_of(setting_.options))
                    .value()) {
    for (std::size_t s = 0; s < player_.steps(); ++s) {
      results.push_back(player_.play(s));
      judgements.push_back(
          oracle::judge_step({player_.x_t0(s), player_.x_t1(s)}, source.triangles, {1, {}}));
    }
  }
  JudgedCase(const JudgedCase&) = delete;
  JudgedCase& operator=(const JudgedCase&) = delete;

  CaseFacts facts() const {
    return {source,
            setting_.options,
            results,
            judgements,
            player_.detector().surface(),
            setting_.stages_of};
  }

  corpus::Case source;
  std::vector<detector::StepResult> results;
  std::vector<oracle::StepJudgement> judgements;

 private:
  Setting setting_;
  CasePlayer player_;
};

}  // namespace assay::properties::test
