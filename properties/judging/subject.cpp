#include "properties/judging/subject.h"

#include <fmt/format.h>

#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

using detector::Culling;
using detector::Pairs;
using detector::Start;

Claims DetectorUnderTest::claims_in(const Configuration& configuration) const {
  return built_in ? claims_of(configuration.options) : claims;
}

Claims DetectorUnderTest::claims_on(const corpus::Case& c,
                                    const Configuration& configuration) const {
  return says_query(c) && !built_in ? query_claims : claims_in(configuration);
}

DetectorUnderTest built_in_detector() {
  DetectorUnderTest detector;
  detector.name = "built-in";
  for (const auto culling : all_values<Culling>) {
    detector.configurations.push_back({name_of(culling), {culling, Start::verified, Pairs::all}});
  }
  // There is no configuration of first pairs for view lines, because a step with first pairs ends
  // with K, which is found in the same way from lines.
  detector.configurations.push_back(
      {"view-point/first", {Culling::view_point, Start::verified, Pairs::first}});
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    detector.configurations.push_back(
        {fmt::format("{}/bounded", name_of(culling)),
         {culling, Start::verified, Pairs::all, detector::Arithmetic::bounded}});
  }
  return detector;
}

WorkerProcess Subject::process(std::uint32_t variation, bool asks_twice) const {
  return {worker,
          plugin,
          {.isolation = isolation,
           .least = isolated,
           .threads = threads,
           .variation = variation,
           .asks_twice = asks_twice}};
}

}  // namespace assay::properties
