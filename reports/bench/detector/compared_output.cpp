#include "reports/bench/detector/compared_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "properties/campaign/ledger/binding.h"
#include "reports/bench/speed_error/error_output.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

std::string ratio_text(const std::optional<ComparedTime>& time) {
  if (!time) return "-";
  return fmt::format("{:.3g} [{:.3g}, {:.3g}]", time->over.value, time->over.lo, time->over.hi);
}

std::string ms_text(const std::optional<ComparedTime>& time, Estimate ComparedTime::*whose) {
  return time ? fmt::format("{:.3g}", ((*time).*whose).value) : "-";
}

// Gives "2: 0.01", for example: the number of steps that are off, and by how much at worst.
std::string off_text(const FirstTimesOff& off) {
  return off.steps == 0 ? "0" : fmt::format("{}: {:.1g}", off.steps, off.worst);
}

constexpr const char* compared_row =
    "{:<20} {:>9} {:>5} {:>9} {:>9} {:>22} {:>9} {:>9} {:>22} {:>6} {:>6} {:>9} {:>9} {:>7} {:>8} "
    "{:>9}";

std::string text_of(const ComparedSequence& s) {
  const auto& e = s.errors;
  auto text = fmt::format(
      compared_row, s.name, s.triangles,
      s.left_out ? fmt::format("{}-{}", s.steps + s.left_out, s.left_out)
                 : fmt::format("{}", s.steps),
      ms_text(s.step, &ComparedTime::plugin_ms), ms_text(s.step, &ComparedTime::built_in_ms),
      ratio_text(s.step), ms_text(s.create, &ComparedTime::plugin_ms),
      ms_text(s.create, &ComparedTime::built_in_ms), ratio_text(s.create), e.unsafe, e.false_alarms,
      off_text(e.late), off_text(e.early), e.missing, e.spurious, e.undecided);
  if (!s.ended.empty()) text += "  " + s.ended;
  return text + "\n";
}

Json json_of(const std::optional<ComparedTime>& time) {
  if (!time) return nullptr;
  return {{"plugin_ms", to_json(time->plugin_ms)},
          {"built_in_ms", to_json(time->built_in_ms)},
          {"over", to_json(time->over)}};
}

Json json_of(const FirstTimesOff& off) {
  return {{"steps", off.steps}, {"worst_share", off.worst}};
}

Json json_of(const PluginErrors& e) {
  return {{"judged", e.judged},        {"contact", e.contact},   {"undecided", e.undecided},
          {"unsafe", e.unsafe},        {"missed", e.missed},     {"false_alarms", e.false_alarms},
          {"missing", e.missing},      {"spurious", e.spurious}, {"late", json_of(e.late)},
          {"early", json_of(e.early)}, {"broken", e.broken}};
}

}  // namespace

std::string text_of(const ComparedDetector& detector, std::span<const ComparedSequence> sequences) {
  auto text = fmt::format(
      "beside the built-in detector, auto, exact, {} pairs; processor time in ms with all "
      "threads, medians\n",
      detector.claims.all_pairs ? "all" : "first");
  text += fmt::format(compared_row, "sequence", "triangles", "steps", "a step", "built-in",
                      "over built-in", "create", "built-in", "over built-in", "unsafe", "alarms",
                      "late", "early", "missing", "spurious", "undecided") +
          "\n";
  for (const auto& sequence : sequences) text += text_of(sequence);
  const bool has_left_out = std::any_of(sequences.begin(), sequences.end(),
                                        [](const auto& one) { return one.left_out > 0; });
  if (has_left_out) text += "steps 5-2: of 5, 2 are left out by the contract\n";
  return text;
}

Json to_json(const ComparedDetector& detector) {
  Json claims = Json::array();
  for (const auto claim : properties::list_of(detector.claims)) claims.push_back(name_of(claim));
  return {{"name", detector.name},
          {"version", detector.version},
          {"library", detector.library},
          {"claims", std::move(claims)},
          {"isolation", text_of(detector.isolation)},
          {"threads", detector.threads},
          {"contract", nlohmann::json(detector.contract)}};
}

Json to_json(std::span<const ComparedSequence> sequences) {
  Json list = Json::array();
  for (const auto& s : sequences) {
    list.push_back({{"sequence", s.name},
                    {"kind", s.kind},
                    {"triangles", s.triangles},
                    {"steps", s.steps},
                    {"left_out", s.left_out},
                    {"ended", s.ended.empty() ? Json() : Json(s.ended)},
                    {"step", json_of(s.step)},
                    {"create", json_of(s.create)},
                    {"errors", json_of(s.errors)}});
  }
  return list;
}

std::string csv_of(std::span<const ComparedSequence> sequences) {
  std::string text =
      "sequence,kind,triangles,steps,left_out,round,plugin_ms_a_step,built_in_ms_a_step,"
      "plugin_create_ms,built_in_create_ms,contact,unsafe,missed,false_alarms,missing,spurious,"
      "late_steps,late_worst,early_steps,early_worst,undecided,broken\n";
  for (const auto& s : sequences) {
    const auto& e = s.errors;
    const auto line = [&](const std::string& times) {
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", s.name, s.kind,
                          s.triangles, s.steps, s.left_out, times, e.contact, e.unsafe, e.missed,
                          e.false_alarms, e.missing, e.spurious, e.late.steps, e.late.worst,
                          e.early.steps, e.early.worst, e.undecided, joined(e.broken, " "));
    };
    if (!s.step || !s.create) line(",,,,");
    for (std::size_t r = 0; s.step && s.create && r < s.step->over.samples.size(); ++r)
      line(fmt::format("{},{},{},{},{}", r + 1, s.step->plugin_ms.samples[r],
                       s.step->built_in_ms.samples[r], s.create->plugin_ms.samples[r],
                       s.create->built_in_ms.samples[r]));
  }
  return text;
}

}  // namespace assay::reports
