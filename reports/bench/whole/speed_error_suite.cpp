// Suite `speed-error` measures what each arithmetic and culling costs, and what it gets wrong.
// First its figures as a table, as JSON, as samples and as a picture; then its rows.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "reports/bench/whole/speed_error.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using detector::Arithmetic;
using detector::Culling;
using detector::Pairs;

// "26 families (14 scene, 8 generated, 4 real), 971 steps": what the table below it is about.
std::string families_text(std::span<const FamilySummary> families) {
  std::vector<std::pair<std::string, int>> kinds;
  std::uint64_t count = 0, steps = 0;
  for (const auto& family : families) {
    if (family.variant != reference_variant) continue;
    ++count;
    steps += family.steps;
    if (kinds.empty() || kinds.back().first != family.kind) kinds.emplace_back(family.kind, 0);
    ++kinds.back().second;
  }
  std::vector<std::string> list;
  for (const auto& [kind, number] : kinds) list.push_back(fmt::format("{} {}", number, kind));
  return fmt::format("{} families ({}), {} steps", count, fmt::join(list, ", "), steps);
}

// In how many steps; the median and the largest share of a step; the largest in ulps.
std::string time_text(const properties::TimesOff& off) {
  if (off.steps == 0) return "0";
  return fmt::format("{}: {:.2g}, {:.2g} ({:.1g} ulp)", off.steps, off.quantile(0.5),
                     off.worst_share, off.worst_ulps);
}

// A line for each variant: time over the reference's; unsafe and alarming steps, with a star if the
// variant is on the Pareto line of that error; wrong answers and pairs; first times that are off.
std::string variants_text(std::span<const VariantSummary> variants) {
  constexpr int widths[] = {-11, -12, -6, -19, 9, 9, 7, 7, 8, 9, -27, -1};
  std::string text = table_line(widths,
                                {"arithmetic", "culling", "pairs", "time", "unsafe", "alarming",
                                 "missed", "alarms", "missing", "spurious", "  late", "early"},
                                0);
  const auto starred = [](std::uint64_t count, const ShareOfSteps& share) {
    return fmt::format("{}{}", count, share.on_pareto_line ? " *" : "  ");
  };
  for (const auto& [variant, over, e, unsafe, alarming] : variants) {
    text += table_line(
        widths,
        {name_of(variant.arithmetic), name_of(variant.culling), name_of(variant.pairs),
         fmt::format("{:.2f} [{:.2f}, {:.2f}]", over.value, over.lo, over.hi),
         starred(e.unsafe, unsafe), starred(e.alarming, alarming), std::to_string(e.missed),
         std::to_string(e.false_alarms), std::to_string(e.missing), std::to_string(e.spurious),
         "  " + time_text(e.late), time_text(e.early)},
        0);
  }
  return text;
}

Json head_of(const Variant& variant) {
  return json_object("arithmetic", name_of(variant.arithmetic), "culling", name_of(variant.culling),
                     "pairs", name_of(variant.pairs));
}

Json json_of(const ShareOfSteps& share) {
  return json_object("share", share.share, "interval", std::array{share.lo, share.hi},
                     "on_pareto_line", share.on_pareto_line);
}

Json json_of(const FamilySummary& f) {
  Json json = json_object("family", f.family, "kind", f.kind);
  json.update(head_of(f.variant));
  json.update(json_object("steps", f.steps, "hash", fmt::format("{:016x}", f.hash), "ns_a_step",
                          f.ns_a_step, "ns_a_triangle", f.ns_a_triangle, "time_over_reference",
                          f.over_reference, "box_tests", f.box_tests, "candidates", f.candidates,
                          "elementary_tests", f.elementary_tests, "errors", f.errors));
  return json;
}

Json json_of(const VariantSummary& v) {
  Json json = head_of(v.variant);
  json.update(json_object("time_over_reference", v.over_reference, "unsafe", json_of(v.unsafe),
                          "alarming", json_of(v.alarming), "errors", v.errors));
  return json;
}

Json sample_of(const VariantStep& s) {
  Json json = json_object("family", s.family, "kind", s.kind, "case", s.case_id, "step", s.step + 1,
                          "triangles", s.triangles);
  json.update(head_of(s.variant));
  json.update(json_object("hash", fmt::format("{:016x}", s.hash), "box_tests", s.box_tests,
                          "candidates", s.candidates, "elementary_tests", s.elementary_tests,
                          "errors", s.errors, "ns", s.ns));
  return json;
}

struct ArithmeticLook {
  Arithmetic arithmetic;
  const char* colour;
};
constexpr ArithmeticLook arithmetic_looks[] = {{Arithmetic::exact, colour::blue},
                                               {Arithmetic::bounded, colour::green},
                                               {Arithmetic::double_precision, colour::orange},
                                               {Arithmetic::single_precision, colour::vermilion}};

struct Mark {
  Culling culling;
  int point_type;  // a number of gnuplot; all these points are filled
};
constexpr Mark marks[] = {{Culling::automatic, 15},   {Culling::view_auto, 7},
                          {Culling::view_point, 9},   {Culling::view_line, 11},
                          {Culling::normal_cone, 13}, {Culling::bvh, 5}};

// Exact arithmetic is drawn hollow, because it has no error at all and would hide bounded
// arithmetic.
bool is_hollow(Arithmetic arithmetic) { return arithmetic == Arithmetic::exact; }

std::vector<std::string> legend() {
  std::vector<std::string> entries;
  for (const auto& [arithmetic, colour] : arithmetic_looks) {
    entries.push_back(
        fmt::format("points pointtype {} pointsize 1.2 linewidth 1.5 linecolor '{}' title '{}'",
                    is_hollow(arithmetic) ? 6 : 7, colour, name_of(arithmetic)));
  }
  entries.emplace_back("lines linecolor '#000000' linewidth 1.5 dashtype 2 title 'Pareto line'");
  for (const auto& [culling, point_type] : marks) {
    entries.push_back(
        fmt::format("points pointtype {} pointsize 1.1 linecolor '#333333' title '{}'", point_type,
                    name_of(culling)));
  }
  return entries;
}

}  // namespace

std::string speed_error_picture(std::span<const VariantSummary> variants) {
  std::vector<ErrorPoint> points;
  double fastest = 1, slowest = 1, most = 0.01;
  std::uint64_t judged = 0;
  for (const auto& [arithmetic, colour] : arithmetic_looks) {
    for (const auto& [culling, point_type] : marks) {
      const Variant drawn{arithmetic, culling, detector::Pairs::all};
      const auto v = std::find_if(variants.begin(), variants.end(),
                                  [&](const auto& one) { return one.variant == drawn; });
      if (v == variants.end()) continue;
      const bool hollow = is_hollow(arithmetic);
      points.push_back({fmt::format("pointtype {} pointsize {} linecolor '{}' linewidth {}",
                                    point_type - (hollow ? 1 : 0), hollow ? 1.3 : 0.9, colour,
                                    hollow ? 1.2 : 0.7),
                        v->over_reference, v->unsafe, v->alarming});
      fastest = std::min(fastest, v->over_reference.lo);
      slowest = std::max(slowest, v->over_reference.hi);
      most = std::max({most, v->unsafe.hi, v->alarming.hi});
      judged = std::max(judged, v->errors.steps);
    }
  }
  ErrorPicture picture;
  picture.settings = fmt::format(
      "set xtics (0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1, 1.5, 2, 3, 4, 5, 7, 10)\n"
      "set xrange [{:.3f}:{:.3f}]\nset yrange [{:.2f}:{:.2f}]\n"
      "set bmargin at screen 0.15\nset tmargin at screen 0.9\n"
      "set xlabel 'time of a step over that of exact with bvh, times'\n",
      fastest / 1.1, slowest * 1.1, -0.03 * 100 * most, 1.05 * 100 * most);
  picture.left = fmt::format(
      "set lmargin at screen 0.06\nset rmargin at screen 0.435\n"
      "set title 'Unsafe: a contact or pair missed, or a time too late'\n"
      "set ylabel '% of {} steps'\n",
      judged);
  picture.right =
      "set lmargin at screen 0.485\nset rmargin at screen 0.86\n"
      "set title 'Alarming: a contact or pair that there is not'\n"
      "set key at screen 0.865, screen 0.88 left top vertical maxcols 1 Left reverse samplen 1.5 "
      "spacing 1.25\n";
  picture.legend = legend();
  picture.has_pareto_line = true;
  return error_picture(points, picture);
}

void add_figures(std::span<const VariantStep> steps, std::span<const FamilySummary> families,
                 std::span<const VariantSummary> variants, BenchReport& report) {
  report.below = fmt::format("\n{}\n{}\n", families_text(families), variants_text(variants));
  for (const auto& family : families) report.add_figure("families", json_of(family));
  for (const auto& variant : variants) report.add_figure("variants", json_of(variant));
  for (const auto& step : steps) report.add_sample(sample_of(step));
  report.picture = speed_error_picture(variants);
}

namespace {

// Adds what each arithmetic gets wrong, over all cullings and kinds of pairs.
void add_errors(std::span<const VariantSummary> variants, BenchReport& report) {
  for (const auto arithmetic : all_values<Arithmetic>) {
    properties::StepErrors all;
    for (const auto& summary : variants) {
      if (summary.variant.arithmetic == arithmetic) all += summary.errors;
    }
    const bool exact = arithmetic == Arithmetic::exact,
               proved = exact || arithmetic == Arithmetic::bounded;
    const auto add = [&](const char* label, std::uint64_t count, bool claimed, std::string note) {
      report.add(fmt::format("{}, {}", label, name_of(arithmetic)), "",
                 exactly(static_cast<double>(count)), wanted_if(claimed, at_most(0)),
                 std::move(note));
    };
    const std::string of = fmt::format("of {} steps, all cullings, all pairs and first", all.steps);
    add("wrong answers", all.missed + all.false_alarms, exact, of);
    add("free against a contact", all.missed, proved, of);
    add("missing pairs", all.missing, proved, "");
    add("spurious pairs", all.spurious, exact, "");
    add("first times late", all.late.steps, proved, "steps");
    add("first times late or early", all.late.steps + all.early.steps, exact, "steps");
  }
}

// Names the families in which an arithmetic has no wrong answer, no wrong pair and no late time.
void add_families_without_error(std::span<const FamilySummary> families, BenchReport& report) {
  for (const auto arithmetic :
       {Arithmetic::bounded, Arithmetic::double_precision, Arithmetic::single_precision}) {
    std::set<std::string> all, wrong;
    for (const auto& family : families) {
      all.insert(family.family);
      if (family.variant.arithmetic == arithmetic &&
          family.errors.unsafe + family.errors.alarming > 0) {
        wrong.insert(family.family);
      }
    }
    std::set<std::string> right;
    std::set_difference(all.begin(), all.end(), wrong.begin(), wrong.end(),
                        std::inserter(right, right.end()));
    report.add(fmt::format("families never wrong, {}", name_of(arithmetic)), "",
               exactly(static_cast<double>(right.size())), {},
               fmt::format("of {}: {}", all.size(), fmt::join(right, ", ")));
  }
}

void add_ratios(std::span<const FamilySummary> families, BenchReport& report) {
  const Variant chosen{Arithmetic::exact, Culling::automatic, Pairs::all};
  const Variant cones{Arithmetic::exact, Culling::normal_cone, Pairs::all};
  const Variant doubles{Arithmetic::double_precision, Culling::automatic, Pairs::all};
  for (const auto& family : families) {
    if (family.variant != chosen) continue;
    const std::string& name = family.family;
    // Times are judged on large meshes only, because a step of a tiny one is over in some
    // microseconds.
    const bool large = family.kind == "scene" || family.kind == "real";
    const std::string note = fmt::format("{:.0f} ns a triangle", family.ns_a_triangle.value);
    report.add("auto over bvh, " + name, "times", family.over_reference,
               wanted_if(large, wanted::view_auto_over_bvh), note);
    report.add("auto over normal-cone, " + name, "times", time_over(families, name, chosen, cones));
    report.add("exact over double, auto, " + name, "times",
               time_over(families, name, chosen, doubles),
               wanted_if(large, wanted::exact_over_double));
  }
}

}  // namespace

BenchReport speed_error_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("speed-error");
  std::vector<std::string> missing;
  std::vector<VariantStep> steps;
  for (const auto& family : all_families(settings, missing)) {
    progress.phase(family.name);
    for (const auto& timed : family.cases()) {
      auto done = run_case(family, timed, report.wrong_answers, progress.tick);
      std::move(done.begin(), done.end(), std::back_inserter(steps));
    }
  }
  for (const auto& file : missing) report.add_no_data("real sequences", file);
  progress.phase("intervals");
  const auto families = by_family(steps);
  const auto variants = by_variant(families);
  add_errors(variants, report);
  add_families_without_error(families, report);
  add_ratios(families, report);
  add_figures(steps, families, variants, report);
  return report;
}

}  // namespace assay::reports
