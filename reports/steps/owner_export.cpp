#include "reports/steps/owner_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "reports/steps/opened_plugin.h"
#include "reports/terminal/joined.h"

namespace assay::reports {
namespace {

// The contacts that a detector has to find under the contract, each with its first time.
std::vector<detector::PairContact> contacts_that_count(const corpus::Case& c,
                                                       const properties::Contract& contract,
                                                       const oracle::StepJudgement& truth) {
  const bool all_features = contract.features == properties::TestedFeatures::both;
  auto contacts = all_features ? truth.pairs : truth.asked_pairs;
  std::erase_if(contacts, [&](const auto& contact) {
    return properties::leaves_out(contract, c.triangles, contact.pair);
  });
  return contacts;
}

template <class Matrix>
std::string rows_text(const Matrix& matrix) {
  std::string out;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    out += fmt::format("    {{{}, {}, {}}},\n", matrix(i, 0), matrix(i, 1), matrix(i, 2));
  return out;
}

std::string step_rows(const corpus::Case& c, const properties::Contract& contract,
                      const std::vector<oracle::StepJudgement>& truth, std::string& pairs) {
  std::string out;
  const auto script = corpus::steps_of(c);
  std::size_t first_pair = 0;
  for (std::size_t s = 0; s < script.size(); ++s) {
    const auto contacts = contacts_that_count(c, contract, truth[s]);
    const auto first =
        std::min_element(contacts.begin(), contacts.end(),
                         [](const auto& a, const auto& b) { return a.time < b.time; });
    const bool is_collision = first != contacts.end();
    const detector::TimeEnclosure time = is_collision ? first->time : detector::TimeEnclosure{};
    out += fmt::format("    {{{}, {}, {}, {}, {}, \"{}\", \"{}\", {}, {}}},\n", script[s].from,
                       script[s].to, is_collision, time.lo, time.hi, fraction_of(time.lo),
                       fraction_of(time.hi), first_pair, contacts.size());
    for (const auto& contact : contacts)
      pairs += fmt::format("    {{{}, {}, {}, {}}},\n", contact.pair.a, contact.pair.b,
                           contact.time.lo, contact.time.hi);
    first_pair += contacts.size();
  }
  return out;
}

constexpr const char* plain_head = R"(#include <cstdio>

// The mesh: vertex indices of each triangle, counter-clockwise seen from outside.
static const int triangles[][3] = {{
{}}};
static const int triangle_count = {}, vertex_count = {};

// Where the vertices are; within a step they move along straight lines.
static const double frames[][{}][3] = {{
{}}};

// From frame `from` to frame `to`. The first contact time t* is `lo` where lo and hi are one
// number, else strictly between the two, which are adjacent doubles. Pairs that meet, with their
// first times, begin at `first_pair`.
struct Step {{
  int from, to;
  bool collision;
  double lo, hi;
  const char *lo_as_fraction, *hi_as_fraction;
  int first_pair, pair_count;
}};
static const Step steps[] = {{
{}}};
static const int step_count = {};

struct Pair {{
  int a, b;
  double lo, hi;
}};
static const Pair pairs[] = {{
{}    {{-1, -1, 0, 0}},  // the end
}};
)";

constexpr const char* plain_tail = R"(
#ifndef CASE_ARRAYS_ONLY

struct Found {
  bool filled_in, collision;
  double time;  // its lower end, where it is an interval
};

// To be filled in: your detector's answer to a step. x_t0 and x_t1 are the vertices at its ends.
static Found ask_your_detector(const double (*x_t0)[3], const double (*x_t1)[3]) {
  (void)x_t0, (void)x_t1, (void)triangles, (void)triangle_count, (void)vertex_count;
  return {false, false, 0};
}

int main() {
  int wrong = 0;
  for (int s = 0; s < step_count; ++s) {
    const Step& step = steps[s];
    const Found found = ask_your_detector(frames[step.from], frames[step.to]);
    if (!found.filled_in) {
      std::printf("fill in ask_your_detector()\n");
      return 2;
    }
    const bool is_late = step.collision && found.collision && found.time > step.lo + time_tolerance;
    if (found.collision != step.collision || is_late) {
      std::printf("step %d: answered %s at %.17g, exact %s at %.17g (%s)\n", s + 1,
                  found.collision ? "collision" : "free", found.time,
                  step.collision ? "collision" : "free", step.lo, step.lo_as_fraction);
      for (int p = step.first_pair; p < step.first_pair + step.pair_count; ++p)
        std::printf("  triangles %d and %d meet at %.17g\n", pairs[p].a, pairs[p].b, pairs[p].lo);
      ++wrong;
    }
  }
  return wrong ? 1 : 0;
}

#endif
)";

constexpr const char* plugin_text =
    R"(  const unsigned claims = api->describe()->claims;
  assay_handle* handle = nullptr;
  const char* message = "";
  if (api->create(&triangles[0][0], triangle_count, &frames[steps[0].from][0][0], vertex_count,
                  &handle, &message) != ASSAY_OK) {
    std::printf("create: %s\n", message ? message : "refused");
    return 1;
  }
  int wrong = 0;
  for (int s = 0; s < step_count; ++s) {
    const Step& step = steps[s];
    assay_result found = {};
    if (api->evaluate(handle, &frames[step.from][0][0], &frames[step.to][0][0]) != ASSAY_OK ||
        api->result(handle, &found) != ASSAY_OK) {
      std::printf("step %d: a call failed\n", s + 1);
      ++wrong;
      continue;
    }
    const bool collision = found.answer == ASSAY_COLLISION;
    const bool is_missed = (claims & ASSAY_CLAIM_FREE_SOUND) && step.collision && !collision;
    const bool is_alarm = (claims & ASSAY_CLAIM_NO_SPURIOUS) && !step.collision && collision;
    const bool is_late = (claims & ASSAY_CLAIM_NOT_LATE) && step.collision && collision &&
                         found.first_lo > step.lo + time_tolerance;
    if (is_missed || is_alarm || is_late) {
      std::printf("step %d: answered %s at [%.17g, %.17g], exact %s at %.17g (%s)\n", s + 1,
                  collision ? "collision" : "free", found.first_lo, found.first_hi,
                  step.collision ? "collision" : "free", step.lo, step.lo_as_fraction);
      for (int p = step.first_pair; p < step.first_pair + step.pair_count; ++p)
        std::printf("  triangles %d and %d meet at %.17g\n", pairs[p].a, pairs[p].b, pairs[p].lo);
      ++wrong;
    }
    api->commit(handle);
  }
  api->destroy(handle);
  return wrong ? 1 : 0;
}
)";

}  // namespace

std::string fraction_of(double share) {
  if (share == 0) return "0";
  int exponent = 0;
  constexpr int mantissa_bits = 53;
  auto numerator =
      static_cast<std::uint64_t>(std::ldexp(std::frexp(share, &exponent), mantissa_bits));
  int halvings = mantissa_bits - exponent;
  for (; numerator % 2 == 0 && halvings > 0; numerator /= 2) --halvings;
  constexpr int most_written_out = 63;
  if (halvings == 0) return fmt::format("{}", numerator);
  return halvings <= most_written_out
             ? fmt::format("{}/{}", numerator, std::uint64_t{1} << halvings)
             : fmt::format("{}/2^{}", numerator, halvings);
}

std::string plain_case_text(const corpus::Case& c, const properties::Contract& contract,
                            const std::vector<oracle::StepJudgement>& truth) {
  std::string frames, pairs;
  for (const auto& frame : c.frames) frames += fmt::format("  {{\n{}  }},\n", rows_text(frame));
  const std::string steps = step_rows(c, contract, truth, pairs);
  const auto phrases = phrases_of(contract);
  std::string out =
      fmt::format("// Case {}, with the exact answer to each step.\n// Contract: {}.\n", c.id,
                  phrases.empty() ? "leaves nothing out" : joined(phrases, ", "));
  out += fmt::format(fmt::runtime(plain_head), rows_text(c.triangles), c.triangles.rows(),
                     c.frames[0].rows(), c.frames[0].rows(), frames, steps, truth.size(), pairs);
  out += fmt::format("static const double time_tolerance = {};\n", contract.time_tolerance);
  return out + plain_tail;
}

std::string plugin_case_text() { return opened_plugin("case") + plugin_text; }

}  // namespace assay::reports
