#include "tests/plugins/forged_replies.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <vector>

#include "properties/worker/channel.h"
#include "properties/worker/messages.h"

namespace assay::tests {
namespace {

using namespace assay::properties;
using assay::detector::Answer;

constexpr int most_descriptors = 1024;

int find_channel() {
  for (int d = 3; d < most_descriptors; ++d) {
    struct stat seen;
    if (fstat(d, &seen) == 0 && S_ISSOCK(seen.st_mode)) return d;
  }
  return -1;
}

RunReply all_free(const RunRequest& request, std::uint64_t place) {
  RunReply reply;
  reply.number = request.number;
  reply.place = place;
  reply.run.steps.resize(assay::corpus::steps_of(request.cases.front()).size());
  for (auto& step : reply.run.steps) step.answer = Answer::free;
  return reply;
}

using Forgery = std::function<std::string(RunReply)>;

Forgery changed(const std::function<void(RunReply&)>& change) {
  return [change](RunReply reply) {
    change(reply);
    return encode(reply);
  };
}
Forgery ending(RunEnd end) {
  return changed([end](RunReply& r) {
    r.run.steps.clear();
    r.run.end = end;
  });
}
Forgery colliding(assay::detector::PairContact contact, int times = 1) {
  return changed([contact, times](RunReply& r) {
    r.run.steps[0].answer = Answer::collision;
    r.run.steps[0].pairs.assign(static_cast<std::size_t>(times), contact);
  });
}

Forgery with_candidates(const std::vector<assay::detector::TrianglePair>& pairs) {
  return changed([pairs](RunReply& r) { r.run.candidates = {pairs}; });
}

Eigen::Index vertices_asked = 0;  // of the mesh of the last request

// With positions at `place` of all vertices, of which there are `more` than the mesh has.
Forgery with_limit(double share, double place, int more = 0) {
  return [=](RunReply reply) {
    reply.run.limits = {
        {{share, assay::detector::Positions::Constant(vertices_asked + more, 3, place)}}};
    return encode(reply);
  };
}

const std::map<std::string, Forgery>& forgeries() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  static const std::map<std::string, Forgery> all = {
      {"forge-no-steps", changed([](RunReply& r) { r.run.steps.clear(); })},
      {"forge-more-steps", changed([](RunReply& r) { r.run.steps.resize(9); })},
      {"forge-not-run", ending(RunEnd::not_run)},
      {"forge-hung", ending(RunEnd::hung)},
      {"forge-crashed", ending(RunEnd::crashed)},
      {"forge-refused-with-steps", changed([](RunReply& r) { r.run.end = RunEnd::refused; })},
      {"forge-end", changed([](RunReply& r) { r.run.end = static_cast<RunEnd>(77); })},
      {"forge-answer",
       changed([](RunReply& r) { r.run.steps[0].answer = static_cast<Answer>(9); })},
      {"forge-number", changed([](RunReply& r) { ++r.number; })},
      {"forge-place", changed([](RunReply& r) { ++r.place; })},
      {"forge-text", changed([](RunReply& r) { r.run.explanation = "fine\n\033[2Jcertified"; })},
      {"forge-control", changed([](RunReply& r) { r.run.explanation = "\u009b2Jcertified"; })},
      {"forge-bytes", changed([](RunReply& r) { r.run.explanation = "\xff"; })},
      {"forge-long-text", changed([](RunReply& r) { r.run.explanation.assign(1 << 20, 'x'); })},
      {"forge-no-interval", changed([](RunReply& r) {
         r.run.steps[0].first = {nan, nan};
       })},
      {"forge-pair-beyond", colliding({{0, 1 << 30}, {0, 1}, {}})},
      {"forge-pair-of-one", colliding({{1, 1}, {0, 1}, {}})},
      {"forge-pair-twice", colliding({{0, 1}, {0, 1}, {}}, 2)},
      {"forge-pair-time", colliding({{0, 1}, {2, 3}, {}})},
      {"forge-free-with-pairs", changed([](RunReply& r) {
         r.run.steps[0].pairs.push_back({{0, 1}, {0, 1}, {}});
       })},
      {"forge-views", changed([](RunReply& r) { r.run.steps[0].signs.resize(4); })},
      {"forge-counts", changed([](RunReply& r) { r.run.steps[0].counts.closure_rounds = 1; })},
      {"forge-bool",
       [](RunReply r) {
         std::string bytes = encode(r);
         // Behind two numbers, an end, an empty text, the number of steps and an answer: whether
         // the first step has a problem.
         constexpr std::size_t place = 8 + 8 + 1 + 8 + 8 + 1;
         bytes[place] = 2;
         return bytes;
       }},
      {"forge-count-of-steps",
       [](RunReply r) {
         std::string bytes = encode(r);
         const std::uint64_t many = std::uint64_t{1} << 60;
         std::memcpy(bytes.data() + 25, &many, sizeof many);
         return bytes;
       }},
      {"forge-candidates", changed([](RunReply& r) { r.run.candidates.emplace_back(); })},
      {"forge-no-answers", changed([](RunReply& r) {
         r.run.has_answers = false;
         r.run.steps[0].answer = Answer::undecided;
       })},
      // Of one that claims candidates.
      {"forge-candidate-none", changed([](RunReply&) {})},
      {"forge-candidate-missing", changed([](RunReply& r) { r.run.candidates.resize(1); })},
      {"forge-candidate-beyond", with_candidates({{0, 1 << 30}})},
      {"forge-candidate-of-one", with_candidates({{1, 1}})},
      {"forge-candidate-negative", with_candidates({{-1, 1}})},
      {"forge-candidate-twice", with_candidates({{0, 1}, {0, 1}})},
      {"forge-candidate-lies", with_candidates({{0, 1}})},
      // Of one that claims limits.
      {"forge-limit-none", changed([](RunReply&) {})},
      {"forge-limit-missing", changed([](RunReply& r) { r.run.limits.resize(1); })},
      {"forge-limit-share", with_limit(1.5, 0)},
      {"forge-limit-no-share", with_limit(-1, 0)},
      {"forge-limit-not-a-number", with_limit(nan, 0)},
      {"forge-limit-short", with_limit(0.5, 0, -1)},
      {"forge-limit-infinite", with_limit(0.5, std::numeric_limits<double>::infinity())},
      // Of a query.
      {"forge-query-count", changed([](RunReply& r) { r.run.steps.resize(2); })},
      {"forge-query-none", changed([](RunReply& r) { r.run.steps.clear(); })},
      {"forge-query-nan", changed([](RunReply& r) {
         r.run.steps[0].first = {nan, nan};
       })},
      {"forge-query-time", changed([](RunReply& r) {
         r.run.steps[0].first = {0, 2};
       })},
      {"forge-query-answer",
       changed([](RunReply& r) { r.run.steps[0].answer = static_cast<Answer>(9); })},
      {"forge-query-text",
       changed([](RunReply& r) { r.run.explanation = "fine\n\033[2Jcertified"; })},
      {"forge-query-long", changed([](RunReply& r) { r.run.explanation.assign(1 << 20, 'x'); })},
      {"forge-query-number", changed([](RunReply& r) { ++r.number; })},
      {"forge-query-pairs", colliding({{0, 1}, {0, 1}, {}})},
      {"forge-query-candidates", with_candidates({{0, 1}})},
      {"forge-query-lies", changed([](RunReply&) {})},
      {"forge-garbage", [](RunReply) { return std::string(4096, '\x5a'); }},
      {"forge-nothing", [](RunReply) { return std::string(); }},
      {"forge-lies", changed([](RunReply&) {})},  // legal, and judged as answers are
  };
  return all;
}

[[noreturn]] void answer_with(const Forgery& forgery, const std::string& mode) {
  const int descriptor = find_channel();
  Channel channel(descriptor);
  Hello hello;
  hello.wire_version = wire_version();
  hello.description = {"forger", mode, {}, {}};
  const bool has_candidates = mode.starts_with("forge-candidate-");
  const bool has_limit = mode.starts_with("forge-limit-");
  auto& claims = hello.description.claims;
  claims = has_limit ? claims_from_outside : claims_from_outside.without(claims_on_limits);
  claims.set(Claim::candidates, has_candidates);
  hello.description.parts.limit = has_limit;
  if (has_limit) hello.description.contract.progress = 0.5;
  hello.description.parts.query = mode.starts_with("forge-query");
  hello.description.parts.candidates = has_candidates;
  channel.send(encode(hello));
  std::string message;
  while (channel.receive(message) == Transfer::done) {
    RunRequest request;
    if (!decode(message, request)) break;
    vertices_asked = request.cases.front().frames.front().rows();
    for (std::uint64_t i = 0; i < request.configurations.size(); ++i) {
      channel.send(forgery(all_free(request, i)));
    }
  }
  _exit(0);
}

[[noreturn]] void forge_length() {
  const std::uint64_t length = std::uint64_t{1} << 60;
  if (send(find_channel(), &length, sizeof length, MSG_NOSIGNAL) < 0) _exit(1);
  for (;;) pause();
}

// A description, or, with `refusal`, what the library says instead of one.
[[noreturn]] void forge_hello(const std::string& name, double margin = 0,
                              const std::string& refusal = "") {
  Channel channel(find_channel());
  Hello hello;
  hello.wire_version = wire_version();
  hello.serves = refusal.empty();
  hello.refusal = refusal;
  hello.description.name = name;
  hello.description.contract.margin = margin;
  channel.send(encode(hello));
  for (;;) pause();
}

}  // namespace

void forge(const std::string& mode) {
  constexpr std::size_t longest = 10'000;
  const auto forgery = forgeries().find(mode);
  if (forgery != forgeries().end()) answer_with(forgery->second, mode);
  if (mode == "forge-length") forge_length();
  if (mode == "forge-refusal") forge_hello("", 0, "a\n\033[2Jcertified");
  if (mode == "forge-long-refusal") forge_hello("", 0, std::string(longest, 'x'));
  if (mode == "forge-name") forge_hello("a\nb");
  if (mode == "forge-built-in") forge_hello("Built-in");
  if (mode == "forge-built-in-1") forge_hello("built in 1");
  if (mode == "forge-turned-name") forge_hello("fine \u202e");
  if (mode == "forge-space") forge_hello(" ");
  if (mode == "forge-long-name") forge_hello(std::string(101, 'x'));
  if (mode == "forge-margin") forge_hello("x", std::numeric_limits<double>::infinity());
}

}  // namespace assay::tests
