#include "reports/campaign_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/statistics.h"

namespace assay::reports {

using properties::Counts;
using properties::FaultResult;
using properties::FaultStatus;

double bound_of(const properties::StratumTally::Outcomes& outcomes,
                const properties::CampaignRequest& request) {
  // Every claim is counted (certificate/strata_section.cpp).
  std::uint64_t claims = 0;
  for (const auto& configuration : request.detector.configurations)
    claims += properties::list_of(request.detector.claims_in(configuration)).size();
  const auto bounds = request.plan.strata.size() * claims;
  const auto trials = outcomes.holds + outcomes.defects + outcomes.undecided + outcomes.errors;
  return upper_bound(trials - outcomes.holds, trials, risk_of_each(bounds));
}

namespace {

bool same(const properties::StratumTally::Outcomes& a,
          const properties::StratumTally::Outcomes& b) {
  return a.holds == b.holds && a.defects == b.defects && a.undecided == b.undecided &&
         a.errors == b.errors;
}

}  // namespace

std::string strata_text(const properties::Tally& tally,
                        const properties::CampaignRequest& request) {
  const auto& configurations = request.detector.configurations;
  std::string out = fmt::format("{:24} {:18} {:>7} {:>7} {:>7} {:>9} {:>9} {:>9} {:>13}\n",
                                "stratum", "configuration", "n", "holds", "defects", "undecided",
                                "bound", "wanted", "steps/s/core");
  for (const auto& stratum : request.plan.strata) {
    const auto found = tally.strata.find(stratum.family);
    if (found == tally.strata.end()) continue;
    const auto& t = found->second;
    const double seconds = 1e-6 * static_cast<double>(t.oracle_us + t.detector_us);
    const auto row = [&](std::size_t c, const std::string& name) {
      const auto& outcomes = t.by_configuration[c];
      return fmt::format(
          "{:24} {:18} {:>7} {:>7} {:>7} {:>9} {:>9.2e} {:>9} {:>13}\n",
          c == 0 ? stratum.family : "", name,
          outcomes.holds + outcomes.defects + outcomes.undecided + outcomes.errors, outcomes.holds,
          outcomes.defects, outcomes.undecided + outcomes.errors, bound_of(outcomes, request),
          stratum.wanted_bound > 0 ? fmt::format("{:.0e}", stratum.wanted_bound) : "-",
          c == 0 && seconds > 0 ? fmt::format("{:.0f}", static_cast<double>(t.steps) / seconds)
                                : "");
    };
    const bool all_same =
        std::all_of(t.by_configuration.begin(), t.by_configuration.end(),
                    [&](const auto& outcomes) { return same(outcomes, t.by_configuration[0]); });
    if (all_same && configurations.size() > 1) {
      out += row(0, fmt::format("each of {}", configurations.size()));
      continue;
    }
    for (std::size_t c = 0; c < t.by_configuration.size(); ++c)
      out += row(c, configurations[c].name);
  }
  return out;
}

namespace {

std::string range_text(int log2) {
  if (log2 < 0) return "none";
  const std::uint64_t lo = std::uint64_t{1} << log2, hi = 2 * lo - 1;
  return lo == hi ? fmt::format("{}", lo) : fmt::format("{}-{}", lo, hi);
}

std::string histogram(const std::map<int, std::uint64_t>& counts) {
  std::string out;
  for (const auto& [log2, count] : counts) {
    out += fmt::format("{}{}: {}", out.empty() ? "" : ", ", range_text(log2), count);
  }
  return out;
}

}  // namespace

std::string distribution_text(const properties::Tally& tally) {
  std::string out;
  for (const auto& [family, t] : tally.strata) {
    out += fmt::format(
        "{}: {} steps of {} cases ({} distinct, {} discarded), {:.0f} % collide\n  triangles {}\n  "
        "pairs in "
        "contact {}\n",
        family, t.steps, t.trials, t.meshes.size(), t.discards,
        t.steps ? 100.0 * static_cast<double>(t.collisions) / static_cast<double>(t.steps) : 0.0,
        histogram(t.sizes), histogram(t.contacts));
  }
  return out;
}

namespace {

// Names and counts behind a prefix.
std::vector<std::pair<std::string, std::uint64_t>> with_prefix(const Counts& counts,
                                                               std::string_view prefix) {
  std::vector<std::pair<std::string, std::uint64_t>> list;
  for (auto it = counts.lower_bound(prefix); it != counts.end() && it->first.starts_with(prefix);
       ++it) {
    list.emplace_back(it->first.substr(prefix.size()), it->second);
  }
  return list;
}

std::uint64_t count_of(const Counts& counts, const std::string& name) {
  const auto found = counts.find(name);
  return found == counts.end() ? 0 : found->second;
}

}  // namespace

std::string tags_text(const Counts& counts) {
  std::string out =
      fmt::format("{:16} {:>12} {:>14}\n", "sets of a pair", "in contact", "first contact");
  for (const auto& [block, count] : with_prefix(counts, "block:")) {
    out += fmt::format("{:16} {:>12} {:>14}\n", block, count, count_of(counts, "first:" + block));
  }
  out += "cases by tag:\n";
  std::string line;
  for (const auto& [tag, count] : with_prefix(counts, "tag:")) {
    const std::string word = fmt::format("{} {}", tag, count);
    constexpr std::size_t width = 100;
    if (!line.empty() && line.size() + word.size() + 2 > width) {
      out += "  " + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : ", ") + word;
  }
  return line.empty() ? out : out + "  " + line + "\n";
}

std::string laws_text(const Counts& counts, std::uint64_t wanted_premises) {
  std::string out = fmt::format("{:52} {:>9} {:>7} {:>7}\n", "law", "premise", "close", "broken");
  for (const auto& [name, premise] : with_prefix(counts, "law:")) {
    if (!name.ends_with("/premise")) continue;
    const std::string law = name.substr(0, name.size() - std::string("/premise").size());
    out += fmt::format(
        "{:52} {:>9} {:>6.0f}% {:>7}{}\n", law, premise,
        premise ? 100.0 * static_cast<double>(count_of(counts, "law:" + law + "/close")) /
                      static_cast<double>(premise)
                : 0.0,
        count_of(counts, "law:" + law + "/broken"), premise < wanted_premises ? "  too few" : "");
  }
  return out;
}

std::string faults_text(const std::vector<FaultResult>& results) {
  std::string out = fmt::format("{:44} {:18} {:>10} {:>12} {:>9}  {}\n", "fault", "law", "cases",
                                "curated", "vertices", "verdict");
  for (const auto& r : results) {
    const auto median = r.median();
    std::string verdict;
    switch (r.fault->status) {
      case FaultStatus::planted:
        verdict = r.found() ? "found" : "NOT FOUND";
        break;
      case FaultStatus::open:
        verdict = r.found() ? "found: no longer open" : "open";
        break;
      case FaultStatus::equivalent:
        verdict = r.found() ? "FOUND, but registered as equivalent" : "survives, rightly";
        break;
    }
    out += fmt::format(
        "{:44} {:18} {:>10} {:>12} {:>9}  {}\n", r.fault->name, r.fault->law,
        median ? fmt::format("{}", *median) : "-",
        r.fault->curated.empty() ? "-" : (r.by_curated ? "yes" : "no"),
        r.fault->smallest_vertices ? fmt::format("{}", r.fault->smallest_vertices) : "-", verdict);
  }
  return out;
}

std::string worlds_text(const WorldResults& worlds) {
  std::string out = "every motion of a tetrahedron on a grid, up to symmetry:\n";
  for (const auto& [world, result] : worlds) {
    out += fmt::format("  {:18} {} classes proved, of {} motions (of {}){}; {} collide; {:.1f} s\n",
                       world->name, result.classes, result.motions, result.all,
                       result.counterexample ? "; COUNTEREXAMPLE: " + result.what
                       : result.complete     ? ", all of it"
                                             : ", the time was over",
                       result.collisions, result.seconds);
  }
  return out;
}

std::string shrinking_text(const std::vector<FaultResult>& results) {
  std::string out = fmt::format("{:44} {:>22} {:>14} {:>7} {:>8} {:>8}\n", "fault",
                                "triangles, steps from", "to", "known", "calls", "seconds");
  std::size_t tried = 0, reached = 0;
  std::vector<double> seconds;
  for (const auto& r : results) {
    if (!r.reduction || !r.shown_by || r.fault->status != FaultStatus::planted) continue;
    const auto vertices = r.reduction->smallest.frames[0].rows();
    const bool near = vertices <= r.fault->smallest_vertices + 1;
    if (r.fault->smallest_vertices > 0) {
      ++tried;
      reached += near ? 1 : 0;
    }
    seconds.push_back(r.reduction->seconds);
    out += fmt::format(
        "{:44} {:>22} {:>14} {:>7} {:>8} {:>8.1f}{}\n", r.fault->name,
        fmt::format("{}, {}", r.shown_by->triangles.rows(), corpus::steps_of(*r.shown_by).size()),
        fmt::format("{} vertices", vertices),
        r.fault->smallest_vertices ? fmt::format("{}", r.fault->smallest_vertices) : "-",
        r.reduction->calls, r.reduction->seconds,
        near || r.fault->smallest_vertices == 0 ? "" : "  larger");
  }
  if (seconds.empty()) return "";
  std::sort(seconds.begin(), seconds.end());
  return out +
         fmt::format(
             "{} of {} within one vertex of the smallest known mesh; median {:.1f} s, at most "
             "{:.1f} s\n",
             reached, tried, seconds[seconds.size() / 2], seconds.back());
}

}  // namespace assay::reports
