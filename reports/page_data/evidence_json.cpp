#include "reports/page_data/evidence_json.h"

#include "properties/faults/fault.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using properties::RunFindings;

Json number_or_null(std::uint64_t number) { return number == 0 ? Json() : Json(number); }

Json shrunk_json(const std::optional<properties::ShrunkFault>& shrunk) {
  if (!shrunk) return nullptr;
  return {{"from_triangles", shrunk->before.triangles},
          {"from_steps", shrunk->before.steps},
          {"vertices", shrunk->after.vertices},
          {"triangles", shrunk->after.triangles},
          {"steps", shrunk->after.steps},
          {"calls", shrunk->calls}};
}

Json fault_json(const properties::FaultProof& proof) {
  const auto* fault = properties::find_fault(proof.fault);
  const bool has_case = !fault || !fault->curated.empty();
  const auto median = proof.median();
  Json cases = Json::array();
  for (const auto& needed : proof.needed) cases.push_back(needed ? Json(*needed) : Json());
  return {{"name", proof.fault},
          {"about", fault ? Json(fault->about) : Json()},
          {"law", proof.law},
          {"status", name_of(proof.status)},
          {"found", proof.found()},
          {"time_over", proof.time_over},
          {"median_cases", median ? Json(*median) : Json()},
          {"cases", std::move(cases)},
          {"by_curated", has_case ? Json(proof.curated) : Json()},
          {"known_vertices", number_or_null(proof.known_vertices)},
          {"shrunk", shrunk_json(proof.shrunk)}};
}

Json speed_json(const Json& speed, const Json& limits) {
  Json list = Json::array();
  for (const auto& figure : speed) {
    const auto what = figure.at("what").get<std::string>();
    list.push_back({{"what", what},
                    {"median", figure.at("median")},
                    {"lo", figure.at("lo")},
                    {"hi", figure.at("hi")},
                    {"limit", limits.contains(what) ? limits.at(what) : Json()}});
  }
  return list;
}

}  // namespace

Json faults_json(const RunFindings& findings) {
  if (findings.evidence.faults.empty()) return nullptr;
  Json list = Json::array();
  for (const auto& proof : findings.evidence.faults) list.push_back(fault_json(proof));
  return list;
}

Json faults_taken_from(const RunFindings& findings) {
  const auto& power = findings.evidence.power;
  if (power.empty()) return nullptr;
  return {{"campaign", power[0].campaign}, {"seed", power[0].seed}};
}

Json worlds_json(const RunFindings& findings) {
  Json list = Json::array();
  for (const auto& world : findings.evidence.worlds)
    list.push_back(
        {{"world", world.world},
         {"complete", world.complete},
         {"classes", world.classes},
         {"motions", world.motions},
         {"counterexample", world.counterexample ? Json(*world.counterexample) : Json()}});
  return list;
}

Json certificate_json(const Json& statement) {
  const Json& p = statement.at("predicate");
  Json self_test = p.at("self_test");
  if (self_test.is_object()) self_test.erase("families");
  const auto& policy = p.at("campaign").at("plan").at("policy");
  return {{"subject", statement.at("subject")},
          {"versions", p.at("versions")},
          {"issued", p.at("times").at("issued")},
          {"seconds", p.at("times").at("seconds")},
          {"speaks_of", p.at("confidence").at("speaks_of")},
          {"self_test", std::move(self_test)},
          {"corpus", p.at("corpus")},
          {"waivers", p.at("waivers")},
          {"speed", speed_json(p.at("times").at("speed"), policy.at("speed_limits"))},
          {"digests", p.at("digests")},
          {"replay", p.at("replay")}};
}

}  // namespace assay::reports
