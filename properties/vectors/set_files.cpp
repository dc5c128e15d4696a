#include "properties/vectors/set_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cmath>
#include <set>

#include "corpus/atomic_file.h"
#include "corpus/digest.h"
#include "corpus/file_bytes.h"
#include "corpus/json_fields.h"
#include "properties/reducer/case_edits.h"
#include "properties/vectors/exact_csv.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

constexpr std::string_view licence = "MIT";
constexpr std::string_view how_to_cite =
    "Assay conformance vectors for continuous collision detection, version 1.0.0, 2026";

std::string json_word(std::string_view text) { return corpus::json_text(corpus::Json(text)); }

// JSON readers take "-0" for the integer 0 and lose the sign.
std::string number(double x) { return x == 0 && std::signbit(x) ? "-0.0" : fmt::format("{}", x); }

template <class Items, class Text>
std::string list(const Items& items, const Text& text) {
  std::string out = "[";
  for (const auto& item : items) out.append(out.size() > 1 ? "," : "").append(text(item));
  return out.append("]");
}

std::string texts(const std::vector<std::string>& items) { return list(items, json_word); }

std::string point_text(const detector::Point& x) { return list(x, number); }

std::string first_text(const VectorFacts& facts) {
  if (!facts.first) return "";
  return fmt::format(",\"first_time\":[{},{}],\"polynomial\":{}", number(facts.first->lo),
                     number(facts.first->hi), texts(facts.polynomial));
}

std::string query_text(const Vector& v) {
  const auto query = *query_of(v.c);
  const auto points = [&](auto end) {
    return list(query.points, [&](const detector::MovingPoint& p) { return point_text(p.*end); });
  };
  std::string out;
  if (v.question == VectorQuestion::distance)
    out += fmt::format(",\"distance\":{}", number(v.distance));
  if (v.steps[0].least_distance && std::isfinite(*v.steps[0].least_distance))
    out += fmt::format(",\"least_distance\":{}", number(*v.steps[0].least_distance));
  out += first_text(v.steps[0]);
  return out + fmt::format(",\"t0\":{},\"t1\":{}", points(&detector::MovingPoint::t0),
                           points(&detector::MovingPoint::t1));
}

std::string step_text(const corpus::CaseStep& step, const VectorFacts& facts) {
  std::string out = fmt::format("{{\"from\":{},\"to\":{},\"commit\":{},\"result\":\"{}\"",
                                step.from, step.to, step.commit, name_of(facts.result));
  out += first_text(facts);
  if (facts.pairs) {
    out += ",\"pairs\":" + list(*facts.pairs, [](const corpus::ExpectedPair& p) {
             return fmt::format("[{},{},{},{}]", p.pair.a, p.pair.b, number(p.time.lo),
                                number(p.time.hi));
           });
  }
  return out + "}";
}

std::string mesh_text(const Vector& v) {
  std::string out = ",\"triangles\":" + list(triangles_of(v.c), [](const auto& t) {
                      return fmt::format("[{},{},{}]", t[0], t[1], t[2]);
                    });
  out += ",\"frames\":" + list(v.c.frames, [](const detector::Positions& frame) {
           return list(corpus::points_of(frame), point_text);
         });
  const auto steps = corpus::steps_of(v.c);
  out += ",\"steps\":[";
  for (std::size_t s = 0; s < steps.size(); ++s)
    out += (s > 0 ? "," : "") + step_text(steps[s], v.steps[s]);
  return out + "]";
}

std::string case_line(const Vector& v) {
  std::string out = fmt::format("{{\"id\":{},\"about\":{},\"result\":\"{}\"", json_word(v.c.id),
                                json_word(v.c.about), name_of(v.result()));
  out += says_query(v.c) ? query_text(v) : mesh_text(v);
  out += ",\"flags\":" + list(v.flags, [](VectorFlag f) { return json_word(name_of(f)); });
  if (!v.hard.kind.empty())
    out +=
        fmt::format(",\"hard\":{{\"kind\":{},\"bits\":{}}}", json_word(v.hard.kind), v.hard.bits);
  if (!v.open.empty()) out += ",\"open\":" + texts(v.open);
  if (!v.breaks.empty()) out += ",\"breaks\":" + texts(v.breaks);
  if (!v.split_of.empty()) out += ",\"split_of\":" + json_word(v.split_of);
  return out + ",\"source\":" + json_word(v.c.source) + "}";
}

std::string group_text(const VectorGroup& group) {
  std::string out = fmt::format(
      "{{\"schema\":\"{}\",\"version\":\"{}\",\"group\":\"{}\",\"features\":\"{}\","
      "\"question\":\"{}\",\"precision\":\"{}\",\"licence\":\"{}\",\"cases\":[\n",
      vectors_schema, vectors_version, group.name(), name_of(group.features),
      name_of(group.question), name_of(group.precision), licence);
  for (std::size_t i = 0; i < group.cases.size(); ++i)
    out += case_line(group.cases[i]) + (i + 1 < group.cases.size() ? ",\n" : "\n");
  return out + "]}\n";
}

std::string file_of(const VectorGroup& group) { return group.name() + ".json"; }

struct Digests {
  std::vector<std::string> of_groups;
  std::string of_set;
};

Digests digests_of(const VectorSet& set, const std::vector<SetFile>& groups) {
  Digests digests;
  std::string lines;
  for (std::size_t i = 0; i < set.groups.size(); ++i) {
    digests.of_groups.push_back(corpus::sha256_of(groups[i].text));
    lines += fmt::format("{}  {}\n", digests.of_groups.back(), groups[i].name);
  }
  digests.of_set = corpus::sha256_of(lines);
  return digests;
}

std::vector<SetFile> group_files(const VectorSet& set) {
  std::vector<SetFile> files;
  for (const auto& group : set.groups) files.push_back({file_of(group), group_text(group)});
  return files;
}

std::string set_text(const VectorSet& set, const Digests& digests) {
  corpus::Json json;
  json["schema"] = vectors_schema;
  json["version"] = vectors_version;
  json["profile"] = set.profile;
  auto groups = corpus::Json::array();
  for (std::size_t i = 0; i < set.groups.size(); ++i) {
    const auto& group = set.groups[i];
    groups.push_back({{"file", file_of(group)},
                      {"sha256", digests.of_groups[i]},
                      {"cases", group.cases.size()},
                      {"features", name_of(group.features)},
                      {"question", name_of(group.question)},
                      {"precision", name_of(group.precision)}});
  }
  json["cases"] = set.size();
  json["digest"] = digests.of_set;
  json["licence"] = licence;
  json["cite"] = how_to_cite;
  json["groups"] = groups;
  for (const auto& flag : flag_texts()) {
    auto& text = json["flags"][name_of(flag.flag)];
    text["about"] = flag.about;
    text["wrong"] = flag.wrong;
    text["links"] = flag.links;
  }
  return corpus::json_text(json, 1) + "\n";
}

}  // namespace

std::vector<SetFile> files_of(const VectorSet& set) {
  auto files = group_files(set);
  const auto digests = digests_of(set, files);
  files.insert(files.begin(), {"set.json", set_text(set, digests)});
  for (const auto& group : set.groups) {
    if (group.features != VectorFeatures::mesh)
      files.push_back({"csv/" + csv_name(group), csv_text(group)});
  }
  return files;
}

std::string digest_of(const VectorSet& set) { return digests_of(set, group_files(set)).of_set; }

Expected<void> write_set(const std::filesystem::path& folder, const VectorSet& set) {
  std::error_code failure;
  for (const auto& file : files_of(set)) {
    const auto path = folder / file.name;
    std::filesystem::create_directories(path.parent_path(), failure);
    if (failure)
      return Problem{fmt::format("{}: {}", path.parent_path().string(), failure.message())};
    BOOST_OUTCOME_TRYV(corpus::write_file_atomically(path, file.text));
  }
  return boost::outcome_v2::success();
}

}  // namespace assay::properties
