// Campaign files: schema `assay-campaign/1`.
#include <algorithm>
#include <boost/outcome/try.hpp>
#include <nlohmann/json.hpp>

#include "corpus/file_bytes.h"
#include "corpus/json_fields.h"
#include "detector/mesh/problem.h"
#include "properties/campaign/plan.h"
#include "properties/queries/query_families.h"
#include "properties/words.h"

namespace assay::properties {
namespace {

constexpr const char* schema = "assay-campaign/1";

class PlanReader {
 public:
  explicit PlanReader(corpus::JsonField top) : top_(std::move(top)) {}

  corpus::Expected<CampaignPlan> read() {
    BOOST_OUTCOME_TRY(schema_field, top_.at("schema"));
    if (schema_field.json() != schema) {
      return schema_field.problem(std::string(schema) + " expected");
    }
    for (const auto& [key, value] : top_.json().items()) {
      // An unknown key is refused, because a misspelt limit must not pass for a limit that was not
      // stated.
      if (std::find(std::begin(keys), std::end(keys), key) == std::end(keys))
        return top_.problem("no field '" + key + "' is known");
    }
    BOOST_OUTCOME_TRY(name_field, top_.at("name"));
    BOOST_OUTCOME_TRY(name, name_field.text());
    plan_.name = name;
    // The name becomes part of ids and of file names.
    if (name.empty() || name.find_first_not_of(name_letters) != std::string::npos) {
      return name_field.problem("a name of letters, digits, '-', '_' and '.' expected");
    }
    BOOST_OUTCOME_TRY(read_strata());
    BOOST_OUTCOME_TRY(read_seconds());
    BOOST_OUTCOME_TRY(read_number("case_seconds", plan_.case_seconds));
    BOOST_OUTCOME_TRY(read_bytes("case_bytes", plan_.case_bytes));
    BOOST_OUTCOME_TRY(read_number("tetrahedron_seconds", plan_.tetrahedron_seconds));
    BOOST_OUTCOME_TRY(read_number("shrink_share", plan_.shrink_share));
    BOOST_OUTCOME_TRY(read_count("laws_every", plan_.laws_every));
    BOOST_OUTCOME_TRY(read_count("law_premises", plan_.law_premises));
    BOOST_OUTCOME_TRY(read_count("fault_cases", plan_.fault_cases));
    auto seeds = static_cast<std::uint64_t>(plan_.fault_seeds);
    BOOST_OUTCOME_TRY(read_count("fault_seeds", seeds));
    plan_.fault_seeds = static_cast<int>(seeds);
    if (top_.has("shrink_faults")) {
      BOOST_OUTCOME_TRY(field, top_.at("shrink_faults"));
      if (!field.json().is_boolean()) return field.problem("true or false expected");
      plan_.shrink_faults = field.json().get<bool>();
    }
    BOOST_OUTCOME_TRY(read_policy());
    BOOST_OUTCOME_TRY(check_whole());
    return plan_;
  }

 private:
  corpus::Expected<void> check_whole() const {
    if (plan_.case_seconds <= 0) return top_.problem("case_seconds above 0 expected");
    if (plan_.shrink_share > 1) return top_.problem("shrink_share of at most 1 expected");
    if ((plan_.fault_cases > 0) != (plan_.fault_seeds > 0))
      return top_.problem("fault_cases and fault_seeds belong together");
    const bool has_cases = std::any_of(plan_.strata.begin(), plan_.strata.end(),
                                       [](const StratumPlan& s) { return s.cases > 0; });
    if (!has_cases && plan_.fault_cases == 0 && plan_.tetrahedron_seconds == 0)
      return top_.problem("there is nothing to do");
    return boost::outcome_v2::success();
  }

  // The value null says that there is no limit. It has to be stated, so that nobody leaves the
  // limit out by mistake.
  corpus::Expected<void> read_seconds() {
    const bool has_none = top_.has("seconds") && top_.json()["seconds"].is_null();
    if (has_none) return boost::outcome_v2::success();
    BOOST_OUTCOME_TRY(read_number("seconds", plan_.seconds));
    if (plan_.seconds <= 0) return top_.problem("seconds above 0, or null, expected");
    return boost::outcome_v2::success();
  }

  corpus::Expected<void> read_strata() {
    BOOST_OUTCOME_TRY(field, top_.at("strata"));
    BOOST_OUTCOME_TRY(size, field.size());
    for (std::size_t i = 0; i < size; ++i) {
      const auto item = field.item(i);
      for (const auto& [key, value] : item.json().items()) {
        if (key != "family" && key != "cases" && key != "bound")
          return item.problem("no field '" + key + "' is known");
      }
      StratumPlan stratum;
      BOOST_OUTCOME_TRY(family_field, item.at("family"));
      BOOST_OUTCOME_TRY(family, family_field.text());
      if (!find_family(family)) return family_field.problem("no family of this name");
      if (std::any_of(plan_.strata.begin(), plan_.strata.end(),
                      [&](const StratumPlan& other) { return other.family == family; })) {
        return family_field.problem("this family is there already");
      }
      stratum.family = family;
      BOOST_OUTCOME_TRY(cases_field, item.at("cases"));
      BOOST_OUTCOME_TRY(cases, cases_field.integer(0, most_cases));
      stratum.cases = static_cast<std::uint64_t>(cases);
      if (item.has("bound")) {
        BOOST_OUTCOME_TRY(bound_field, item.at("bound"));
        BOOST_OUTCOME_TRY(bound, bound_field.number());
        if (bound < 0 || bound >= 1) return bound_field.problem("0 <= bound < 1 expected");
        stratum.wanted_bound = bound;
      }
      plan_.strata.push_back(std::move(stratum));
    }
    return boost::outcome_v2::success();
  }

  corpus::Expected<void> read_policy() {
    if (!top_.has("policy")) return boost::outcome_v2::success();
    BOOST_OUTCOME_TRY(policy, top_.at("policy"));
    if (!policy.json().is_object()) return policy.problem("an object expected");
    for (const auto& [key, value] : policy.json().items()) {
      if (key != "power" && key != "self_test_queries" && key != "repeated_triangles" &&
          key != "speed_limits")
        return policy.problem("no field '" + key + "' is known");
    }
    if (policy.has("power")) {
      BOOST_OUTCOME_TRY(field, policy.at("power"));
      BOOST_OUTCOME_TRY(power, field.number());
      if (power <= 0 || power > 1) return field.problem("0 < power <= 1 expected");
      plan_.policy.power = power;
    }
    if (policy.has("self_test_queries")) {
      BOOST_OUTCOME_TRY(field, policy.at("self_test_queries"));
      BOOST_OUTCOME_TRY(queries, field.integer(0, most_cases));
      plan_.policy.self_test_queries = static_cast<std::uint64_t>(queries);
    }
    if (policy.has("repeated_triangles")) {
      BOOST_OUTCOME_TRY(field, policy.at("repeated_triangles"));
      BOOST_OUTCOME_TRY(triangles, field.integer(0, most_repeated_triangles));
      plan_.policy.repeated_triangles = static_cast<std::uint64_t>(triangles);
    }
    if (!policy.has("speed_limits")) return boost::outcome_v2::success();
    BOOST_OUTCOME_TRY(limits, policy.at("speed_limits"));
    if (!limits.json().is_object()) return limits.problem("an object expected");
    for (const auto& [figure, value] : limits.json().items()) {
      if (std::find(std::begin(speed_figures), std::end(speed_figures), figure) ==
          std::end(speed_figures))
        return limits.problem("no figure '" + figure + "' is known");
      BOOST_OUTCOME_TRY(field, limits.at(figure));
      BOOST_OUTCOME_TRY(limit, field.number());
      if (limit <= 0) return field.problem("a number above 0 expected");
      plan_.policy.speed_limits.push_back({figure, limit});
    }
    return boost::outcome_v2::success();
  }

  corpus::Expected<void> read_number(const char* key, double& value) {
    if (!top_.has(key)) return boost::outcome_v2::success();
    BOOST_OUTCOME_TRY(field, top_.at(key));
    BOOST_OUTCOME_TRY(number, field.number());
    if (number < 0) return field.problem("a number of at least 0 expected");
    value = number;
    return boost::outcome_v2::success();
  }

  corpus::Expected<void> read_count(const char* key, std::uint64_t& value) {
    if (!top_.has(key)) return boost::outcome_v2::success();
    BOOST_OUTCOME_TRY(field, top_.at(key));
    BOOST_OUTCOME_TRY(number, field.integer(0, most_cases));
    value = static_cast<std::uint64_t>(number);
    return boost::outcome_v2::success();
  }

  // Takes the same numbers as the option --memory.
  corpus::Expected<void> read_bytes(const char* key, std::uint64_t& value) {
    if (!top_.has(key)) return boost::outcome_v2::success();
    BOOST_OUTCOME_TRY(field, top_.at(key));
    constexpr std::uint64_t most = std::uint64_t{1} << 60;
    if (!field.json().is_number_unsigned() || field.json().get<std::uint64_t>() > most)
      return field.problem("a whole number of bytes expected");
    value = field.json().get<std::uint64_t>();
    return boost::outcome_v2::success();
  }

  static constexpr std::int64_t most_cases = 1'000'000'000, most_repeated_triangles = 1'000'000;
  static constexpr const char* name_letters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  static constexpr const char* keys[] = {"schema",
                                         "name",
                                         "about",
                                         "strata",
                                         "seconds",
                                         "case_seconds",
                                         "case_bytes",
                                         "laws_every",
                                         "law_premises",
                                         "fault_cases",
                                         "fault_seeds",
                                         "shrink_faults",
                                         "tetrahedron_seconds",
                                         "shrink_share",
                                         "policy"};
  corpus::JsonField top_;
  CampaignPlan plan_;
};

}  // namespace

corpus::Expected<CampaignPlan> parse_plan(const std::string& text,
                                          const std::filesystem::path& name) {
  BOOST_OUTCOME_TRY(json, corpus::parse_json(text, name));
  return PlanReader(corpus::JsonField(json, name)).read();
}

// Whether two plans differ in their time alone. A campaign that was stopped by --time keeps its
// name.
static bool is_the_same_but_for_time(CampaignPlan a, CampaignPlan b) {
  a.seconds = b.seconds = 0;
  return plan_text(a) == plan_text(b);
}

const CampaignPlan* plan_meant_by(std::string_view name) {
  for (const auto& plan : named_plans()) {
    if (is_nearly(plan.name, name)) return &plan;
  }
  return nullptr;
}

corpus::Expected<CampaignPlan> find_plan(const std::string& name_or_file) {
  for (const auto& plan : named_plans()) {
    if (plan.name == name_or_file) return plan;
  }
  const auto* meant = plan_meant_by(name_or_file);
  std::error_code ignored;
  if (meant && !std::filesystem::exists(name_or_file, ignored)) {
    return corpus::problem_in(name_or_file,
                              "is no campaign and no file; did you mean " + meant->name + "?");
  }
  BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(name_or_file));
  BOOST_OUTCOME_TRY(plan, parse_plan(bytes, name_or_file));
  for (const auto& named : named_plans()) {
    if (plan.name != named.name || is_the_same_but_for_time(plan, named)) continue;
    return corpus::problem_in(name_or_file,
                              "is another plan than the built-in campaign of its name");
  }
  return plan;
}

std::string plan_text(const CampaignPlan& plan) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& s : plan.strata) {
    list.push_back({{"family", s.family}, {"cases", s.cases}, {"bound", s.wanted_bound}});
  }
  auto limits = nlohmann::ordered_json::object();
  for (const auto& [figure, limit] : plan.policy.speed_limits) limits[figure] = limit;
  return nlohmann::ordered_json{
      {"schema", schema},
      {"name", plan.name},
      {"strata", std::move(list)},
      {"seconds", plan.seconds > 0 ? nlohmann::ordered_json(plan.seconds) : nullptr},
      {"case_seconds", plan.case_seconds},
      {"case_bytes", plan.case_bytes},
      {"laws_every", plan.laws_every},
      {"law_premises", plan.law_premises},
      {"fault_cases", plan.fault_cases},
      {"fault_seeds", plan.fault_seeds},
      {"shrink_faults", plan.shrink_faults},
      {"tetrahedron_seconds", plan.tetrahedron_seconds},
      {"shrink_share", plan.shrink_share},
      {"policy",
       {{"power", plan.policy.power},
        {"self_test_queries", plan.policy.self_test_queries},
        {"repeated_triangles", plan.policy.repeated_triangles},
        {"speed_limits", std::move(limits)}}}}
      .dump();
}

}  // namespace assay::properties
