#include "reports/bench/peers/peer_output.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/bench/speed_error/error_output.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* row_form =
    "{:<37} {:<8}{:<19} {:>7} {:>6} {:>6} {:>10} {:>10} {:>9} {:>4} {:>5} {:>6} {:>5}\n";

std::string text_of(const PeerTimes& times) {
  return times.steps == 0 ? "0" : fmt::format("{}: {:.1g}", times.steps, times.worst);
}

std::string time_text(const std::optional<Estimate>& over) {
  return over ? fmt::format("{:.3g} [{:.2g}, {:.2g}]", over->value, over->lo, over->hi) : "-";
}

// Gives "a t p", or a part of it: the detector says whether there is a collision, when the first
// is, and which pairs are in contact.
std::string letters_of(const PeerRow& row) {
  std::string letters = "a";
  letters += row.answers.find("time") == std::string::npos ? "  " : " t";
  letters += row.answers.find("pairs") == std::string::npos ? "" : " p";
  return letters;
}

std::string text_of(const PeerRow& row) {
  const auto& c = row.counts;
  // A count stands in brackets if the detector promised nothing about it.
  const auto asked = [&](std::uint64_t count) {
    return row.claims_soundness || count == 0 ? fmt::format("{}", count)
                                              : fmt::format("({})", count);
  };
  return fmt::format(fmt::runtime(row_form), row.detector, letters_of(row), time_text(row.over),
                     asked(c.unsafe), asked(c.missed), c.false_alarms, text_of(c.late),
                     text_of(c.early), c.undecided, row.slow, c.steps,
                     row.create_over ? fmt::format("{:.2g}", *row.create_over) : "-",
                     row.bytes_a_triangle ? fmt::format("{:.0f}", *row.bytes_a_triangle) : "-");
}

Json json_of(const PeerTimes& times) {
  return {{"steps", times.steps}, {"worst_share", times.worst}};
}

Json json_of(const PeerCounts& c) {
  return {{"steps", c.steps},        {"left_out", c.left_out},
          {"contact", c.contact},    {"undecided", c.undecided},
          {"unsafe", c.unsafe},      {"confirmed", c.confirmed},
          {"missed", c.missed},      {"false_alarms", c.false_alarms},
          {"missing", c.missing},    {"spurious", c.spurious},
          {"late", json_of(c.late)}, {"early", json_of(c.early)}};
}

Json json_of(const std::optional<Estimate>& over) { return over ? to_json(*over) : Json(); }
Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

}  // namespace

std::string text_of(std::span<const PeerRow> rows, std::span<const PeerFamily> families,
                    std::span<const AbsentPeer> absent) {
  std::string text =
      fmt::format(fmt::runtime(row_form), "detector", "answers", "time", "unsafe", "missed",
                  "alarms", "late", "early", "undecided", "slow", "steps", "create", "bytes");
  PeerCounts peers, built_in;
  for (const auto& row : rows) {
    text += text_of(row);
    (row.is_built_in ? built_in : peers).add(row.counts);
  }
  text +=
      "answers: a collision or not, t when first, p which pairs; each in its own contract\n"
      "time, create (preprocessing): over built-in, exact, bvh, same steps; medians of families\n"
      "(n): of what was not promised; late, early: steps, and the worst as a share of the step\n"
      "slow: cases with a step of more than 5 s, run once; bytes: a triangle, at the highest\n";
  text += fmt::format(
      "unsafe answers confirmed by referee or rational witness: {} of {}, built-in {} of {}\n",
      peers.confirmed, peers.unsafe, built_in.confirmed, built_in.unsafe);
  for (const auto& family : families) {
    if (family.ended > 0)
      text += fmt::format("ended early: {}, {}: {} of {} cases, first {}\n", family.detector,
                          family.family, family.ended, family.cases, family.first_end);
  }
  for (const auto& [name, why] : absent) text += fmt::format("absent: {}: {}\n", name, why);
  return text;
}

std::string unconfirmed_text(std::span<const UnsafeAnswer> answers) {
  std::string text;
  for (const auto& one : answers) {
    if (!one.is_confirmed)
      text += fmt::format("by the oracle alone: {}, case {}, step {}: {}\n", one.detector,
                          one.case_id, one.step + 1, one.defect);
  }
  return text;
}

Json to_json(std::span<const UnsafeAnswer> answers) {
  Json list = Json::array();
  for (const auto& one : answers) {
    list.push_back({{"detector", one.detector},
                    {"case", one.case_id},
                    {"step", one.step + 1},
                    {"what", one.defect},
                    {"confirmed", one.is_confirmed}});
  }
  return list;
}

Json to_json(std::span<const PeerRow> rows) {
  Json list = Json::array();
  for (const auto& row : rows) {
    list.push_back({{"detector", row.detector},
                    {"version", row.version},
                    {"is_built_in", row.is_built_in},
                    {"claims", row.claims},
                    {"contract", row.contract},
                    {"answers", row.answers},
                    {"time_over_reference", json_of(row.over)},
                    {"create_over_reference", json_of(row.create_over)},
                    {"families_timed", row.families},
                    {"slow", row.slow},
                    {"ended_early", row.ended},
                    {"bytes_a_triangle", json_of(row.bytes_a_triangle)},
                    {"counts", json_of(row.counts)}});
  }
  return list;
}

Json to_json(std::span<const PeerFamily> families) {
  Json list = Json::array();
  for (const auto& f : families) {
    list.push_back({{"detector", f.detector},
                    {"family", f.family},
                    {"kind", f.kind},
                    {"time_over_reference", json_of(f.over)},
                    {"create_over_reference", json_of(f.create_over)},
                    {"cases", f.cases},
                    {"cases_timed", f.cases_timed},
                    {"slow", f.slow},
                    {"ended_early", f.ended},
                    {"first_end", f.first_end.empty() ? Json() : Json(f.first_end)},
                    {"counts", json_of(f.counts)}});
  }
  return list;
}

Json to_json(std::span<const AbsentPeer> absent) {
  Json list = Json::array();
  for (const auto& [name, why] : absent) list.push_back({{"name", name}, {"why", why}});
  return list;
}

std::string csv_of(std::span<const PeerFamily> families) {
  std::string text =
      "detector,family,kind,time_over,time_lo,time_hi,steps,left_out,contact,unsafe,confirmed,"
      "missed,"
      "false_alarms,late,late_worst,early,early_worst,undecided,slow\n";
  for (const auto& f : families) {
    const auto& c = f.counts;
    const auto times =
        f.over ? fmt::format("{},{},{}", f.over->value, f.over->lo, f.over->hi) : ",,";
    text += fmt::format("\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", f.detector,
                        f.family, f.kind, times, c.steps, c.left_out, c.contact, c.unsafe,
                        c.confirmed, c.missed, c.false_alarms, c.late.steps, c.late.worst,
                        c.early.steps, c.early.worst, c.undecided, f.slow);
  }
  return text;
}

}  // namespace assay::reports
