#include "properties/campaign/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>

#include "corpus/files.h"
#include "corpus/json_fields.h"
#include "corpus/problem.h"
#include "detector/mesh/problem.h"
#include "properties/fields.h"
#include "properties/generators/families.h"
#include "properties/queries/query_families.h"
#include "properties/words.h"

namespace assay::properties {
namespace {

// Makes the strata. Every generic family gets the first number of cases, every other family the
// second.
std::vector<StratumPlan> strata(std::uint64_t generic, std::uint64_t others, double generic_bound,
                                double other_bound) {
  std::vector<StratumPlan> list;
  for (const auto& family : families()) {
    const bool is_generic = family.name.ends_with("-generic");
    list.push_back({std::string(family.name), is_generic ? generic : others,
                    is_generic ? generic_bound : other_bound});
  }
  for (const auto further : {counted_families(), question_families()}) {
    for (const auto& family : further)
      list.push_back({std::string(family.name), others, other_bound});
  }
  return list;
}

// Adds strata of sizes, from 1,000 triangles on. Counts that are multiples of ten show each shape
// equally often.
void add_sizes(CampaignPlan& plan, std::initializer_list<std::uint64_t> cases) {
  auto family = size_families().begin();
  for (const auto count : cases) plan.strata.push_back({std::string((family++)->name), count, 0});
}

std::vector<CampaignPlan> make_named_plans() {
  constexpr double minute = 60, hour = 60 * minute;
  CampaignPlan smoke;
  smoke.name = "smoke";
  smoke.about = "a little of everything, 2 minutes on 2 cores; states bounds, requires none";
  smoke.strata = strata(600, 200, 0, 0);
  smoke.law_premises = 20;
  smoke.fault_cases = 300;
  smoke.fault_seeds = 1;
  smoke.tetrahedron_seconds = 5;
  smoke.search = 10'000;
  smoke.policy.self_test_queries = 10'000;
  smoke.policy.repeated_triangles = 2000;

  CampaignPlan quick;
  quick.name = "quick";
  quick.about = "all claims, laws and planted faults, 10 minutes on 2 cores";
  quick.strata = strata(4000, 1500, 5e-3, 5e-2);
  add_sizes(quick, {20, 10});
  quick.law_premises = 1000;
  quick.fault_cases = 800;
  quick.fault_seeds = 3;
  quick.tetrahedron_seconds = 40;
  quick.search = 50'000;
  quick.policy.self_test_queries = 20'000;
  quick.policy.repeated_triangles = 5000;

  CampaignPlan nightly = quick;
  nightly.name = "nightly";
  nightly.about = "one night";
  nightly.strata = strata(30'000, 20'000, 1e-3, 1e-3);
  add_sizes(nightly, {100, 40, 10});
  nightly.seconds = 8 * hour;
  nightly.laws_every = 4;
  nightly.fault_cases = 5000;
  nightly.fault_seeds = 5;
  nightly.tetrahedron_seconds = 5 * minute;
  nightly.search = 500'000;
  nightly.policy.self_test_queries = 100'000;
  nightly.policy.repeated_triangles = 20'000;
  nightly.policy.speed_limits = {
      {"free-step-over-bvh", 1. / 50}, {"search-step-over-bvh", 1.05}, {"exact-over-double", 1.3}};

  CampaignPlan release = nightly;
  release.name = "release";
  release.about = "before a release; best divided among several runs (shares)";
  release.strata = strata(120'000, 60'000, 2e-4, 2e-4);
  add_sizes(release, {200, 100, 20, 10});
  release.seconds = 72 * hour;
  release.search = 2'000'000;

  return {smoke, quick, nightly, release};
}

}  // namespace

const std::vector<CampaignPlan>& named_plans() {
  static const std::vector<CampaignPlan> plans = make_named_plans();
  return plans;
}

namespace {

bool is_of_queries(const StratumPlan& stratum) { return is_query_family(stratum.family); }

}  // namespace

bool asks_queries(const CampaignPlan& plan) {
  return std::ranges::any_of(plan.strata, is_of_queries);
}

bool asks_queries_alone(const CampaignPlan& plan) {
  return !plan.strata.empty() && std::ranges::all_of(plan.strata, is_of_queries);
}

CampaignPlan without_queries(CampaignPlan plan) {
  std::erase_if(plan.strata, is_of_queries);
  return plan;
}

CampaignPlan without_questions(CampaignPlan plan) {
  std::erase_if(plan.strata,
                [](const StratumPlan& stratum) { return is_question_family(stratum.family); });
  return plan;
}

CampaignPlan with_queries(CampaignPlan plan) {
  if (asks_queries(plan)) return plan;
  StratumPlan largest;
  for (const auto& stratum : plan.strata) {
    if (stratum.cases > largest.cases) largest = stratum;
  }
  if (largest.cases == 0) return plan;
  for (const auto& family : query_families()) {
    const bool is_in_another =
        is_dear_query_family(family.name) && !family.name.ends_with("extreme");
    if (is_in_another) continue;
    plan.strata.push_back({std::string(family.name), largest.cases, largest.wanted_bound});
  }
  return plan;
}

CampaignPlan without_relations(CampaignPlan plan) {
  std::erase_if(plan.strata, [](const StratumPlan& stratum) {
    return std::any_of(counted_families().begin(), counted_families().end(),
                       [&](const Family& family) { return family.name == stratum.family; });
  });
  return plan;
}

std::string trial_id(const CampaignPlan& plan, std::uint64_t seed, const std::string& family,
                     std::uint64_t index) {
  return fmt::format("{}:{}:{}:{}", plan.name, seed, family, index);
}

CampaignPlan query_plan(CampaignPlan plan) {
  if (asks_queries_alone(plan)) return plan;
  plan = with_queries(without_queries(std::move(plan)));
  std::erase_if(plan.strata, [](const StratumPlan& stratum) { return !is_of_queries(stratum); });
  plan.laws_every = 0;
  plan.law_premises = 0;
  plan.tetrahedron_seconds = 0;
  return plan;
}

// Campaign files: schema `assay-campaign/1`.

template <class Archive>
void fields(Archive& archive, StratumPlan& stratum) {
  archive("family", stratum.family, "cases", stratum.cases, "bound", stratum.wanted_bound);
}

ASSAY_FIELDS(Policy, power, self_test_queries, repeated_triangles, speed_limits)

template <class Archive>
void fields(Archive& archive, CampaignPlan& plan) {
  archive("name", plan.name, "strata", plan.strata, "seconds", plan.seconds, "case_seconds",
          plan.case_seconds, "case_bytes", plan.case_bytes, "laws_every", plan.laws_every,
          "law_premises", plan.law_premises, "fault_cases", plan.fault_cases, "fault_seeds",
          plan.fault_seeds, "tetrahedron_seconds", plan.tetrahedron_seconds, "shrink_share",
          plan.shrink_share, "search", plan.search, "policy", plan.policy);
}

namespace {

using corpus::JsonField, corpus::Refused, corpus::want;
using Json = corpus::Json;

constexpr const char* schema = "assay-campaign/1";

// Fields that have to be there. The others keep their values if they are missing.
constexpr std::string_view needed[] = {"name", "strata", "family", "cases"};

// Whole numbers from 0 to below these.
constexpr std::int64_t most_cases = 1'000'000'000, most_repeated_triangles = 1'000'000;

// The condition on the number of a field, and its text.
struct Rule {
  std::string_view field;
  bool (*holds)(const Json&);
  const char* expectation;
};
constexpr Rule rules[] = {
    {"bound", [](const Json& x) { return x >= 0 && x < 1; }, "0 <= bound < 1 expected"},
    {"power", [](const Json& x) { return x > 0 && x <= 1; }, "0 < power <= 1 expected"},
    // Takes the same numbers as the option --memory.
    {"case_bytes",
     [](const Json& x) { return x.is_number_unsigned() && x <= std::uint64_t{1} << 60; },
     "a whole number of bytes expected"},
};
constexpr Rule other_rule = {"", [](const Json& x) { return x >= 0; },
                             "a number of at least 0 expected"};

class PlanReader : public corpus::JsonReader<PlanReader>, public NamedFields<PlanReader> {
 public:
  using JsonReader::JsonReader, JsonReader::read;

  // Reads all fields of an object. An unknown key is refused, because a misspelt limit must not
  // pass for a limit that was not stated; `names` has those that are not read here.
  template <class T>
  static void read_all(const JsonField& object, T& x, Json names = Json::object()) {
    if (!object.json().is_object()) throw Refused{object.problem("an object expected")};
    names.update(json_of_fields<Json>(x));
    for (const auto& [key, value] : object.json().items()) {
      if (!names.contains(key)) throw Refused{object.problem("no field '" + key + "' is known")};
    }
    PlanReader reader(object);
    fields(reader, x);
  }

  template <class T>
  void field(std::string_view name, T& x) const {
    if (std::ranges::count(needed, name) == 0 && !object().has(name)) return;
    const auto value = want(object().at(name));
    // The value null says that there is no limit. It has to be stated (fault_of), so that nobody
    // leaves the limit out by mistake.
    if (name == "seconds" && value.json().is_null()) return;
    if constexpr (std::is_arithmetic_v<T>) {
      const auto* found = std::ranges::find(rules, name, &Rule::field);
      const Rule& rule = found == std::end(rules) ? other_rule : *found;
      if (std::is_floating_point_v<T>) {
        want(value.number());
      } else if (&rule == &other_rule) {
        want(value.integer(0, name == "repeated_triangles" ? most_repeated_triangles : most_cases));
      }
      if (!rule.holds(value.json())) throw Refused{value.problem(rule.expectation)};
      value.json().get_to(x);
    } else {
      read(value, x);
    }
  }
  static void read(const JsonField& field, Policy& policy) { read_all(field, policy); }
  static void read(const JsonField& field, std::vector<StratumPlan>& strata) {
    const auto size = want(field.size());
    for (std::size_t i = 0; i < size; ++i) {
      StratumPlan stratum;
      read_all(field.item(i), stratum);
      const auto family = field.item(i).at("family").value();
      if (!find_family(stratum.family)) throw Refused{family.problem("no family of this name")};
      if (std::ranges::count(strata, stratum.family, &StratumPlan::family) > 0)
        throw Refused{family.problem("this family occurs twice")};
      strata.push_back(std::move(stratum));
    }
  }
  static void read(const JsonField& field, decltype(Policy::speed_limits)& limits) {
    if (!field.json().is_object()) throw Refused{field.problem("an object expected")};
    for (const auto& [figure, value] : field.json().items()) {
      if (std::ranges::find(speed_figures, figure) == std::end(speed_figures))
        throw Refused{field.problem("no figure '" + figure + "' is known")};
      const auto limit = want(field.at(figure));
      if (want(limit.number()) <= 0) throw Refused{limit.problem("a number above 0 expected")};
      limits[figure] = value;
    }
  }
};

// Returns what is wrong with the plan as a whole, if anything is.
std::optional<corpus::Problem> fault_of(const JsonField& top, const CampaignPlan& plan) {
  const auto name_letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  // The name becomes part of ids and of file names.
  if (plan.name.empty() || plan.name.find_first_not_of(name_letters) != std::string::npos)
    return top.at("name").value().problem("a name of letters, digits, '-', '_' and '.' expected");
  const bool has_no_limit = top.has("seconds") && top.json()["seconds"].is_null();
  if (!has_no_limit && plan.seconds <= 0) return top.problem("seconds above 0, or null, expected");
  if (plan.case_seconds <= 0) return top.problem("case_seconds above 0 expected");
  if (plan.shrink_share > 1) return top.problem("shrink_share of at most 1 expected");
  if ((plan.fault_cases > 0) != (plan.fault_seeds > 0))
    return top.problem("fault_cases and fault_seeds must both be 0, or both above 0");
  const bool has_cases =
      std::ranges::any_of(plan.strata, [](const StratumPlan& s) { return s.cases > 0; });
  if (!has_cases && plan.fault_cases == 0 && plan.tetrahedron_seconds == 0 && plan.search == 0)
    return top.problem("the campaign has nothing to do");
  return std::nullopt;
}

}  // namespace

corpus::Expected<CampaignPlan> parse_plan(const std::string& text,
                                          const std::filesystem::path& name) try {
  const auto json = want(corpus::parse_json(text, name));
  const JsonField top(json, name);
  const auto schema_field = want(top.at("schema"));
  if (schema_field.json() != schema) return schema_field.problem(std::string(schema) + " expected");
  CampaignPlan plan;
  PlanReader::read_all(top, plan, {{"schema", schema}, {"about", ""}});
  if (auto fault = fault_of(top, plan)) return *fault;
  return plan;
} catch (const Refused& refusal) {
  return refusal.problem;
}

std::string plan_text(const CampaignPlan& plan) {
  Json json = {{"schema", schema}};
  json.update(json_of_fields<Json>(plan));
  if (plan.seconds <= 0) json["seconds"] = nullptr;
  return json.dump();
}

namespace {

// Returns whether a run's options and its detector's parts turn the named plan `other` into this
// one. Options limit a case; a plug-in is asked no question families, and no relations if it takes
// none; its query is judged beside the steps, or alone. Times may differ: a campaign that was
// stopped by --time keeps its name.
bool is_made_of(CampaignPlan plan, const CampaignPlan& other) {
  plan.seconds = 0;
  plan.case_seconds = other.case_seconds;
  plan.case_bytes = other.case_bytes;
  const CampaignPlan of_plugin = without_questions(other);
  const auto variants = {other,
                         of_plugin,
                         without_relations(of_plugin),
                         with_queries(of_plugin),
                         with_queries(without_relations(of_plugin)),
                         query_plan(of_plugin)};
  return std::ranges::any_of(variants, [&](CampaignPlan variant) {
    variant.seconds = 0;
    return plan_text(plan) == plan_text(variant);
  });
}

}  // namespace

corpus::Expected<CampaignPlan> read_plan(const std::filesystem::path& file) {
  BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(file));
  BOOST_OUTCOME_TRY(plan, parse_plan(bytes, file));
  for (const auto& other : named_plans()) {
    if (plan.name == other.name && !is_made_of(plan, other))
      return corpus::problem_in(file, "differs from the built-in campaign of the same name");
  }
  return plan;
}

corpus::Expected<CampaignPlan> find_plan(const std::string& name_or_file) {
  for (const auto& plan : named_plans()) {
    if (plan.name == name_or_file) return plan;
  }
  std::error_code ignored;
  if (!std::filesystem::exists(name_or_file, ignored)) {
    return corpus::problem_in(
        name_or_file, "is no campaign and no file" +
                          corpus::did_you_mean(corpus::names_among(named_plans()), name_or_file));
  }
  return read_plan(name_or_file);
}

}  // namespace assay::properties
