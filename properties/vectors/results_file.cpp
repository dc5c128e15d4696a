#include "properties/vectors/results_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "corpus/file_bytes.h"

namespace assay::properties {
namespace {

using corpus::JsonField;
namespace outcome = boost::outcome_v2;

constexpr std::string_view results_schema = "assay-results/1";

std::string answer_text(const VectorAnswer& a) {
  std::string out = fmt::format("{{\"answer\":\"{}\"", a.answer);
  if (a.time) out += fmt::format(",\"time\":[{},{}]", a.time->lo, a.time->hi);
  if (a.share) out += fmt::format(",\"share\":{}", *a.share);
  if (a.pairs) {
    out += ",\"pairs\":[";
    for (const auto& pair : *a.pairs)
      out += fmt::format("{}[{},{}]", out.back() == '[' ? "" : ",", pair.a, pair.b);
    out += "]";
  }
  return out + "}";
}

Expected<void> want_same_set(const JsonField& results, const ReadSet& read,
                             const std::filesystem::path& file) {
  BOOST_OUTCOME_TRY(given, results.at("set"));
  BOOST_OUTCOME_TRY(version, text_at(given, "version"));
  BOOST_OUTCOME_TRY(profile, text_at(given, "profile"));
  BOOST_OUTCOME_TRY(digest, text_at(given, "digest"));
  if (digest == read.digest) return outcome::success();
  return corpus::problem_in(
      file, fmt::format("results of another set ({} {}, digest {}); this one is {} {}, digest {}",
                        version, profile, digest.substr(0, 12), read.version, read.set.profile,
                        read.digest.substr(0, 12)));
}

bool is_statement(const std::string& word) {
  return word == "free" || word == "collision" || word == "share";
}

Expected<VectorAnswer> read_answer(const JsonField& object, const Vector& asked, bool is_mesh) {
  constexpr std::array words = {"free",        "collision", "share",   "undecided",
                                "unsupported", "error",     "timeout", "crash"};
  VectorAnswer answer;
  BOOST_OUTCOME_TRY(field, object.at("answer"));
  BOOST_OUTCOME_TRY(word, field.text());
  if (std::find(words.begin(), words.end(), word) == words.end())
    return field.problem(fmt::format("one of {} expected", fmt::join(words, ", ")));
  if (is_statement(word) && (word == "share") != (asked.question == VectorQuestion::limit))
    return field.problem(fmt::format("{} answers another question", word));
  answer.answer = word;
  if (word == "share") {
    BOOST_OUTCOME_TRY(share, object.at("share"));
    BOOST_OUTCOME_TRY(number, share.number());
    if (number < 0 || number > 1) return share.problem("a number from 0 to 1 expected");
    answer.share = number;
  }
  if (object.has("time")) {
    BOOST_OUTCOME_TRY(time, object.at("time"));
    BOOST_OUTCOME_TRY(interval, read_interval(time));
    answer.time = interval;
  }
  if (object.has("pairs")) {
    BOOST_OUTCOME_TRY(pairs, object.at("pairs"));
    const auto triangles = is_mesh ? asked.c.triangles.rows() : 0;
    const auto read = [&](const JsonField& item) { return read_pair(item, triangles); };
    BOOST_OUTCOME_TRY(all, corpus::read_list<detector::TrianglePair>(pairs, read));
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    answer.pairs = std::move(all);
  }
  return answer;
}

Expected<std::vector<VectorAnswer>> read_answers(const JsonField& object, const Vector& asked,
                                                 bool is_mesh) {
  const auto read = [&](const JsonField& item) { return read_answer(item, asked, is_mesh); };
  if (!is_mesh) {
    BOOST_OUTCOME_TRY(answer, read(object));
    return std::vector{std::move(answer)};
  }
  BOOST_OUTCOME_TRY(steps, object.at("steps"));
  BOOST_OUTCOME_TRY(answers, corpus::read_list<VectorAnswer>(steps, read));
  if (answers.size() != asked.steps.size())
    return steps.problem(fmt::format("{} steps expected", asked.steps.size()));
  return answers;
}

}  // namespace

std::string results_text(const VectorResults& results, const ReadSet& read) {
  const auto word = [](const std::string& text) { return corpus::json_text(corpus::Json(text)); };
  std::string out = fmt::format(
      "{{\"schema\":\"{}\",\"set\":{{\"version\":{},\"profile\":{},\"digest\":{}}},\n"
      "\"product\":{{\"name\":{},\"version\":{},\"settings\":{}}},\"seconds\":{:.1f},\n"
      "\"answers\":{{\n",
      results_schema, word(read.version), word(read.set.profile), word(read.digest),
      word(results.product), word(results.version), word(results.settings), results.seconds);
  std::size_t i = 0;
  for (const auto& group : read.set.groups) {
    for (const auto& v : group.cases) {
      if (i == results.answers.size() || results.answers[i].first != v.c.id) continue;
      std::string text;
      for (const auto& one : results.answers[i++].second)
        text.append(text.empty() ? "" : ",").append(answer_text(one));
      if (group.features == VectorFeatures::mesh) text = "{\"steps\":[" + text + "]}";
      out += fmt::format("{}:{}{}\n", word(v.c.id), text, i < results.answers.size() ? "," : "");
    }
  }
  return out + "}}\n";
}

Expected<VectorResults> read_results(const std::filesystem::path& file, const ReadSet& read) {
  BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(file));
  BOOST_OUTCOME_TRY(json, corpus::parse_json(bytes, file));
  const JsonField object(json, file);
  BOOST_OUTCOME_TRYV(want_schema(object, results_schema));
  BOOST_OUTCOME_TRYV(want_same_set(object, read, file));
  VectorResults results;
  BOOST_OUTCOME_TRY(product, object.at("product"));
  for (const auto& [key, target] : {std::pair{"name", &results.product},
                                    {"version", &results.version},
                                    {"settings", &results.settings}}) {
    BOOST_OUTCOME_TRY(text, text_at(product, key));
    *target = std::move(text);
  }
  BOOST_OUTCOME_TRY(answers, object.at("answers"));
  if (!answers.json().is_object()) return answers.problem("an object expected");
  std::set<std::string> ids;
  for (const auto& group : read.set.groups) {
    for (const auto& v : group.cases) {
      ids.insert(v.c.id);
      if (!answers.has(v.c.id)) continue;
      BOOST_OUTCOME_TRY(answer, answers.at(v.c.id));
      BOOST_OUTCOME_TRY(all, read_answers(answer, v, group.features == VectorFeatures::mesh));
      results.answers.emplace_back(v.c.id, std::move(all));
    }
  }
  for (const auto& item : answers.json().items()) {
    if (!ids.contains(item.key()))
      return answers.problem(fmt::format("the set has no such case: {}", item.key()));
  }
  return results;
}

}  // namespace assay::properties
