// A random small step as a case, the verdict on a run of a case, and the plug-ins of the tests.
#pragma once

#include "corpus/cases/case_file.h"
#include "properties/judging/exam.h"
#include "properties/worlds/small_steps.h"
#include "tests/test.h"

namespace assay::properties::test {

inline corpus::Case small_case(std::uint64_t seed, std::uint64_t index) {
  const SmallStep step = make_small_step(seed, index);
  corpus::Case c;
  c.id = "small-step:" + std::to_string(seed) + ":" + std::to_string(index);
  c.triangles = step.triangles;
  c.frames = {step.x_t0, step.x_t1};
  return c;
}

inline Verdict verdict_on(corpus::Case c, std::vector<oracle::StepJudgement> truth, CaseRun run,
                          const Configuration& configuration, const DetectorUnderTest& detector,
                          const CaseRun* again = nullptr) {
  CaseResults examined{std::move(c), std::move(truth), {std::move(run)}};
  if (again) examined.again = {*again};
  judge({detector, {&configuration, 1}}, examined);
  return std::move(examined.verdicts[0]);
}

inline std::string plugin(const std::string& name) {
  return std::string(ASSAY_PLUGIN_DIR) + "/plugin_" + name + ".so";
}

}  // namespace assay::properties::test
