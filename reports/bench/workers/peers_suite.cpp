// Suite `peers` compares those detectors of others that are there with the built-in one. First its
// figures as a table, as JSON, as samples and as a picture; then its runs.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/bench/pictures.h"
#include "reports/bench/workers/peers.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

std::string row_text(std::span<const int> widths, const PeerRow& row) {
  const auto& e = row.counts.errors;
  // Whether there is a collision, when the first is, and which pairs are in contact.
  std::string letters = "a";
  letters += row.answers.find("time") == std::string::npos ? "  " : " t";
  letters += row.answers.find("pairs") == std::string::npos ? "" : " p";
  // A count stands in brackets if the detector promised nothing about it.
  const auto asked = [&](std::uint64_t count) {
    return row.subject.detector.claims.has(properties::Claim::free_sound) || count == 0
               ? std::to_string(count)
               : fmt::format("({})", count);
  };
  const auto time =
      row.over ? fmt::format("{:.3g} [{:.2g}, {:.2g}]", row.over->value, row.over->lo, row.over->hi)
               : "-";
  return table_line(
      widths, {row.subject.name, fmt::format("{:<8}{}", letters, time), asked(e.unsafe),
               asked(e.missed), std::to_string(e.false_alarms), text_of(e.late), text_of(e.early),
               std::to_string(e.undecided), std::to_string(row.slow), std::to_string(e.steps),
               row.create_over ? fmt::format("{:.2g}", *row.create_over) : "-",
               row.bytes_a_triangle ? fmt::format("{:.0f}", *row.bytes_a_triangle) : "-"});
}

Json json_of(const PeerCounts& counts) {
  Json json = counts.errors;
  json["left_out"] = counts.left_out;
  json["confirmed"] = counts.confirmed;
  return json;
}

Json json_of(const PeerRow& row) {
  const auto& subject = row.subject;
  std::vector<const char*> claims;
  for (const auto claim : properties::list_of(subject.detector.claims))
    claims.push_back(name_of(claim));
  return json_object("detector", subject.name, "version", subject.description.version,
                     "is_built_in", subject.detector.built_in, "claims", claims, "contract",
                     phrases_of(subject.detector.contract), "answers", row.answers,
                     "time_over_reference", row.over, "create_over_reference", row.create_over,
                     "families_timed", row.families, "slow", row.slow, "ended_early", row.ended,
                     "bytes_a_triangle", row.bytes_a_triangle, "counts", json_of(row.counts));
}

Json json_of(const PeerFamily& f) {
  return json_object(
      "detector", f.detector, "family", f.family, "kind", f.kind, "time_over_reference", f.over(),
      "create_over_reference", f.create_over(), "cases", f.cases, "cases_timed", f.cases_timed,
      "slow", f.slow, "ended_early", f.ended, "first_end",
      f.first_end.empty() ? std::nullopt : std::optional(f.first_end), "counts", json_of(f.counts));
}

// The built-in detector has one colour. Each other detector has a colour of its own, as far as the
// colours go. Point types are numbers of gnuplot: of a hollow point, and one higher for the same
// shape, filled. A hollow point shows a detector that does not promise to miss nothing. A shape
// that is used again has another colour.
std::string look_of(const PeerRow& row, std::size_t place) {
  constexpr std::array colours = {colour::vermilion, colour::orange, colour::green,
                                  colour::purple,    colour::sky,    colour::grey};
  constexpr std::array hollow = {4, 6, 8, 10, 12, 14};
  return fmt::format(
      "pointtype {} pointsize 1.2 linewidth 1.2 linecolor '{}'",
      hollow[(place + place / hollow.size()) % hollow.size()] +
          (row.subject.detector.claims.has(properties::Claim::free_sound) ? 1 : 0),
      row.subject.detector.built_in ? colour::blue : colours[place % colours.size()]);
}

}  // namespace

std::string peers_text(std::span<const PeerRow> rows, std::span<const PeerFamily> families,
                       std::span<const AbsentPeer> absent, std::span<const UnsafeAnswer> answers) {
  constexpr int widths[] = {-37, -27, 7, 6, 6, 10, 10, 9, 4, 5, 6, 5};
  std::string text = table_line(
      widths, {"detector", fmt::format("{:<8}{}", "answers", "time"), "unsafe", "missed", "alarms",
               "late", "early", "undecided", "slow", "steps", "create", "bytes"});
  PeerCounts peers, built_in;
  for (const auto& row : rows) {
    text += row_text(widths, row);
    (row.subject.detector.built_in ? built_in : peers) += row.counts;
  }
  text +=
      "answers: a collision or not, t when first, p which pairs; each in its own contract\n"
      "time, create (preprocessing): over built-in, exact, bvh, same steps; medians of families\n"
      "(n): of what was not promised; late, early: steps, and the worst as a share of the step\n"
      "slow: cases with a step of more than 5 s, run once; bytes: a triangle, at the highest\n";
  text += fmt::format(
      "unsafe answers confirmed by referee or rational witness: {} of {}, built-in {} of {}\n",
      peers.confirmed, peers.errors.unsafe, built_in.confirmed, built_in.errors.unsafe);
  for (const auto& family : families) {
    if (family.ended > 0)
      text += fmt::format("ended early: {}, {}: {} of {} cases, first {}\n", family.detector,
                          family.family, family.ended, family.cases, family.first_end);
  }
  for (const auto& [name, why] : absent) text += fmt::format("absent: {}: {}\n", name, why);
  for (const auto& one : answers) {
    if (!one.is_confirmed)
      text += fmt::format("by the oracle alone: {}, case {}, step {}: {}\n", one.detector,
                          one.case_id, one.step + 1, one.defect);
  }
  return text;
}

std::string peers_picture(std::span<const PeerRow> rows) {
  std::vector<ErrorPoint> points;
  ErrorPicture picture;
  double least = 1, most = 1;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    const auto& errors = row.counts.errors;
    if (!row.over || errors.steps == 0) continue;
    points.push_back({look_of(row, i), *row.over, share_of(errors.unsafe, errors.steps),
                      share_of(errors.false_alarms, errors.steps)});
    picture.legend.push_back(fmt::format("points {} title {} noenhanced", look_of(row, i),
                                         quoted_for_gnuplot(row.subject.name)));
    least = std::min(least, row.over->lo);
    most = std::max(most, row.over->hi);
  }
  picture.height = 480;
  // This scale shows shares near 0 and shares of some tens of % on one axis. It has 0 on it.
  picture.settings = fmt::format(
      "set xtics (0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500)\nset xrange [{:.3g}:{:.3g}]\n"
      "set nonlinear y via asinh(10*y) inverse sinh(y)/10\nset yrange [-0.03:100]\n"
      "set ytics (0, 0.1, 0.3, 1, 3, 10, 30, 100)\n"
      "set bmargin at screen 0.14\nset tmargin at screen 0.9\n"
      "set xlabel 'time of a step over that of built-in, exact, bvh, times'\n",
      least / 1.2, most * 1.2);
  picture.left =
      "set ylabel '% of the steps that its contract takes'\n"
      "set lmargin at screen 0.07\nset rmargin at screen 0.385\n"
      "set title 'Unsafe: a contact missed, or a time too late'\n";
  picture.right =
      "set lmargin at screen 0.435\nset rmargin at screen 0.76\n"
      "set title 'False alarms: a collision that there is not'\n"
      "set key at screen 0.765, screen 0.9 left top vertical maxcols 1 Left reverse samplen 1 "
      "spacing 1.2 font ',11'\n";
  return error_picture(points, picture);
}

void add_figures(std::span<const PeerRow> rows, std::span<const PeerFamily> families,
                 std::span<const AbsentPeer> absent, std::span<const UnsafeAnswer> answers,
                 BenchReport& report) {
  report.below = peers_text(rows, families, absent, answers);
  for (const auto& row : rows) report.add_figure("peers", json_of(row));
  for (const auto& family : families) {
    report.add_figure("peer_families", json_of(family));
    report.add_sample(json_of(family));
  }
  for (const auto& [name, why] : absent)
    report.add_figure("absent_peers", json_object("name", name, "why", why));
  for (const auto& one : answers) {
    report.add_figure("unsafe_answers",
                      json_object("detector", one.detector, "case", one.case_id, "step",
                                  one.step + 1, "what", one.defect, "confirmed", one.is_confirmed));
  }
  report.picture = peers_picture(rows);
}

namespace {

// With --quick, keeps only the two public sequences of fewest triangles.
void keep_smallest_sequences(std::vector<CaseFamily>& families, BenchReport& report) {
  std::vector<std::pair<Eigen::Index, std::string>> sizes;
  for (const auto& family : families) {
    if (family.kind == "real")
      sizes.emplace_back(family.cases().front().c.triangles.rows(), family.name);
  }
  std::sort(sizes.begin(), sizes.end());
  constexpr std::size_t kept = 2;
  for (std::size_t i = kept; i < sizes.size(); ++i) {
    std::erase_if(families, [&](const auto& family) { return family.name == sizes[i].second; });
    report.add_left_out(sizes[i].second, "left out: --quick takes the two smallest sequences");
  }
}

// Bytes for each triangle of a mesh of 20,480 triangles, for preprocessing and one step: how far
// the resident memory of a new process rises above that with a mesh of 20 triangles. Nothing if a
// run does not complete.
std::optional<double> bytes_a_triangle(const PeerSubject& subject) {
  auto worker = subject.make_worker(60);
  const properties::Configuration configuration = {subject.name, subject.options, {}, true};
  constexpr int small = 20, large = 20'480, frames = 101;  // so many that a step moves little
  double peaks[2] = {}, triangles = 0;
  for (const int size : {small, large}) {
    auto scene = bench_scene("bend", size, frames);
    scene.frames.resize(2);
    const auto c = timed_case("", std::move(scene), subject.options.start).c;
    const auto run = worker.run(c, {&configuration, 1}).front();
    if (!run.times || run.times->peak_bytes == 0) return std::nullopt;
    peaks[size == large ? 1 : 0] = static_cast<double>(run.times->peak_bytes);
    triangles = static_cast<double>(c.triangles.rows());
  }
  return (peaks[1] - peaks[0]) / triangles;
}

}  // namespace

BenchReport peers_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("peers");
  progress.phase("peers");
  const auto peers = find_peers(settings.peers);
  std::vector<std::string> missing;
  auto families = all_families(settings, missing);
  for (const auto& file : missing) report.add_no_data("public sequence", file);
  if (settings.scale < 1) keep_smallest_sequences(families, report);
  PeerRuns runs(peers.subjects, {.large_seconds = settings.case_seconds, .jobs = settings.jobs});
  std::vector<PeerFamily> done;
  std::vector<UnsafeAnswer> unsafe;
  for (const auto& family : families) {
    progress.phase(family.name);
    auto of_family = runs.run(family, report.wrong_answers, unsafe, progress.tick);
    std::move(of_family.begin(), of_family.end(), std::back_inserter(done));
  }
  progress.phase("memory");
  auto rows = peer_rows(done, peers.subjects);
  for (auto& row : rows) row.bytes_a_triangle = bytes_a_triangle(row.subject);
  add_figures(rows, done, peers.absent, unsafe, report);
  return report;
}

}  // namespace assay::reports
