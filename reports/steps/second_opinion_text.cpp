#include "reports/steps/second_opinion_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "properties/judging/agreement.h"
#include "properties/words.h"

namespace assay::reports {
namespace {

using oracle::Contradiction;
using oracle::ContradictionKind;

const char* name_of(ContradictionKind kind) {
  return properties::word_of(
      {"query", "missing-pair", "static-pair", "static-late", "static-apart"}, kind);
}

bool is_static(const Contradiction& c) {
  return c.kind != ContradictionKind::query && c.kind != ContradictionKind::missing_pair;
}

std::string exact_time_text(const oracle::StaticTime& time) {
  if (const auto* t = std::get_if<double>(&time)) return fmt::format("{}", *t);
  const auto& fraction = std::get<oracle::RationalTime>(time);
  return fmt::format("{}/{}", fraction.numerator, fraction.denominator);
}

std::vector<std::int32_t> vertices_of(const detector::Feature& feature) {
  std::vector<std::int32_t> used;
  for (const auto v : feature.vertices) {
    if (v >= 0) used.push_back(v);
  }
  return used;
}

std::string contradiction_text(const Contradiction& c) {
  const auto verdict = [](bool contact) { return contact ? "contact" : "no contact"; };
  std::string out = fmt::format("  CONTRADICTION ({}):", name_of(c.kind));
  if (c.pair.a >= 0) out += fmt::format(" triangles {} and {}", c.pair.a, c.pair.b);
  if (is_static(c)) {
    out += fmt::format(" at t = {}; oracle: {}, at rest: {}\n", exact_time_text(c.time),
                       verdict(c.judged), verdict(c.second));
  } else {
    out += fmt::format(" {} of vertices", properties::name_of(c.feature.kind));
    for (const auto v : vertices_of(c.feature)) out += fmt::format(" {}", v);
    out += fmt::format("; oracle: {}, referee: {}\n", verdict(c.judged), verdict(c.second));
  }
  return out;
}

}  // namespace

std::string second_opinion_text(const oracle::SecondOpinion& opinion, double milliseconds) {
  std::string out = fmt::format(
      "  second opinion: {} queries ({} contact, {} no contact, {} open), {} static checks, {} "
      "contradictions{}, {:.1f} ms\n",
      opinion.queries, opinion.contact, opinion.no_contact, opinion.open, opinion.static_checks,
      opinion.contradictions.size(), opinion.complete ? "" : " (stopped)", milliseconds);
  constexpr std::size_t most_listed = 10;
  const auto& list = opinion.contradictions;
  for (std::size_t i = 0; i < std::min(list.size(), most_listed); ++i) {
    out += contradiction_text(list[i]);
  }
  if (list.size() > most_listed) out += fmt::format("  ... {} more\n", list.size() - most_listed);
  return out;
}

nlohmann::ordered_json second_opinion_json(const oracle::SecondOpinion& opinion, double share,
                                           double milliseconds) {
  using Json = nlohmann::ordered_json;
  Json contradictions = Json::array();
  for (const Contradiction& c : opinion.contradictions) {
    const bool has_pair = c.pair.a >= 0;
    contradictions.push_back(
        {{"kind", name_of(c.kind)},
         {"triangles", has_pair ? Json::array({c.pair.a, c.pair.b}) : Json()},
         {"feature", is_static(c) ? Json() : Json(properties::name_of(c.feature.kind))},
         {"vertices", vertices_of(c.feature)},
         {"time", is_static(c) ? Json(exact_time_text(c.time)) : Json()},
         {"oracle", c.judged},
         {"second", c.second}});
  }
  return {{"share", share},
          {"complete", opinion.complete},
          {"queries", opinion.queries},
          {"contact", opinion.contact},
          {"no_contact", opinion.no_contact},
          {"open", opinion.open},
          {"static_checks", opinion.static_checks},
          {"contradictions", contradictions},
          {"time_ms", milliseconds}};
}

}  // namespace assay::reports
