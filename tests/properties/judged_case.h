// A generated case through the detector and the oracle, for tests of laws.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "detector/detector.h"
#include "oracle/step.h"
#include "properties/generators/families.h"
#include "properties/laws/case_facts.h"

namespace assay::properties::test {

struct Setting {
  detector::Options options;
  bool own_primitives = false;  // also where the case states some
  StagesOf stages_of = detector::standard_stages;
};

// view-point or view-line, own or given primitives; now and then another start, or first pairs.
inline Setting setting_of(std::string_view id) {
  Random random(Random::hash(id), 1);
  Setting setting;
  setting.options.culling =
      random.one_in(2) ? detector::Culling::view_point : detector::Culling::view_line;
  setting.own_primitives = random.one_in(3);
  if (random.one_in(8)) setting.options.pairs = detector::Pairs::first;
  if (random.one_in(16)) setting.options.start = detector::Start::unknown;
  if (random.one_in(16)) setting.options.start = detector::Start::clean;
  return setting;
}

inline GeneratedCase case_of(const std::string& id) {
  const auto stratum = id.substr(0, id.rfind(':'));
  const auto name = stratum.substr(stratum.rfind(':') + 1);
  for (const auto& family : families()) {
    if (family.name == name) return make_case(family, id);
  }
  throw std::invalid_argument("no family in the id " + id);
}

// All that CaseFacts refers to. Tests may change the results before they ask for facts().
class JudgedCase {
 public:
  JudgedCase(corpus::Case c, Setting setting)
      : source(std::move(c)),
        setting_(std::move(setting)),
        detector_(detector::Detector::assemble(source.triangles, source.frames.front(),
                                               setting_.options,
                                               setting_.stages_of(setting_.options))
                      .value()) {
    const auto script = corpus::steps_of(source);
    for (std::size_t s = 0; s < script.size(); ++s) {
      const auto& x_t0 = source.frames[static_cast<std::size_t>(script[s].from)];
      const auto& x_t1 = source.frames[static_cast<std::size_t>(script[s].to)];
      std::vector<detector::ViewPrimitive> given;
      const auto view = corpus::view_of_step(source, s);
      if (view && !setting_.own_primitives) {
        given.push_back(*view);
        if (setting_.options.culling == detector::Culling::view_point) given[0].q1 = given[0].q0;
      }
      results.push_back(script[s].commit ? detector_.step(x_t0, x_t1, given)
                                         : detector_.evaluate(x_t0, x_t1, given));
      judgements.push_back(oracle::judge_step(x_t0, x_t1, source.triangles, {1, {}}));
    }
  }
  JudgedCase(const JudgedCase&) = delete;
  JudgedCase& operator=(const JudgedCase&) = delete;

  CaseFacts facts() const {
    return {source, setting_.options, results, judgements, detector_.surface(), setting_.stages_of};
  }

  corpus::Case source;
  std::vector<detector::StepResult> results;
  std::vector<oracle::StepJudgement> judgements;

 private:
  Setting setting_;
  detector::Detector detector_;
};

}  // namespace assay::properties::test
