#include "reports/vectors/given_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>

#include "corpus/file_bytes.h"

namespace assay::reports {
namespace {

using corpus::Expected;
using corpus::JsonField;
namespace outcome = boost::outcome_v2;

Expected<std::string> text_of(const JsonField& object, std::string_view key) {
  BOOST_OUTCOME_TRY(field, object.at(key));
  return field.text();
}

Expected<void> want_same_set(const JsonField& results, const VectorSet& set,
                             const std::filesystem::path& file) {
  BOOST_OUTCOME_TRY(given, results.at("set"));
  BOOST_OUTCOME_TRY(version, text_of(given, "version"));
  BOOST_OUTCOME_TRY(profile, text_of(given, "profile"));
  BOOST_OUTCOME_TRY(digest, text_of(given, "digest"));
  if (digest == set.digest) return outcome::success();
  return corpus::problem_in(
      file, fmt::format("results of another set ({} {}, digest {}); this one is {} {}, digest {}",
                        version, profile, digest.substr(0, 12), set.version, set.profile,
                        set.digest.substr(0, 12)));
}

bool is_statement(const std::string& word) {
  return word == "free" || word == "collision" || word == "share";
}

Expected<VectorAnswer> read_answer(const JsonField& object, const VectorCase& asked) {
  constexpr std::array words = {"free",        "collision", "share",   "undecided",
                                "unsupported", "error",     "timeout", "crash"};
  VectorAnswer answer;
  BOOST_OUTCOME_TRY(field, object.at("answer"));
  BOOST_OUTCOME_TRY(word, field.text());
  if (std::find(words.begin(), words.end(), word) == words.end())
    return field.problem(fmt::format("one of {} expected", fmt::join(words, ", ")));
  if (is_statement(word) && (word == "share") != asked.is_limit)
    return field.problem(fmt::format("{} answers another question", word));
  answer.word = word;
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
    const auto read = [&](const JsonField& item) { return read_pair(item, asked.triangles); };
    BOOST_OUTCOME_TRY(all, corpus::read_list<VectorPair>(pairs, read));
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    answer.pairs = std::move(all);
  }
  return answer;
}

Expected<std::vector<VectorAnswer>> read_answers(const JsonField& object, const VectorCase& asked) {
  const auto read = [&](const JsonField& item) { return read_answer(item, asked); };
  if (!asked.is_mesh) {
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

Expected<VectorResults> read_vector_results(const std::filesystem::path& file,
                                            const VectorSet& set) {
  BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(file));
  BOOST_OUTCOME_TRY(json, corpus::parse_json(bytes, file));
  const JsonField object(json, file);
  BOOST_OUTCOME_TRY(schema, object.at("schema"));
  BOOST_OUTCOME_TRY(word, schema.text());
  if (word != "assay-results/1") return schema.problem("\"assay-results/1\" expected");
  BOOST_OUTCOME_TRY(want_same_set(object, set, file));
  VectorResults results;
  BOOST_OUTCOME_TRY(product, object.at("product"));
  for (const auto& [key, target] : {std::pair{"name", &results.name},
                                    {"version", &results.version},
                                    {"settings", &results.settings}}) {
    BOOST_OUTCOME_TRY(text, text_of(product, key));
    *target = std::move(text);
  }
  std::map<std::string, const VectorCase*> cases;
  for (const auto& one : set.cases) cases[one.id] = &one;
  BOOST_OUTCOME_TRY(answers, object.at("answers"));
  if (!answers.json().is_object()) return answers.problem("an object expected");
  for (const auto& [id, answer] : answers.json().items()) {
    const JsonField field(answer, file, "answers." + id);
    const auto asked = cases.find(id);
    if (asked == cases.end()) return field.problem("the set has no such case");
    BOOST_OUTCOME_TRY(read, read_answers(field, *asked->second));
    results.answers[id] = std::move(read);
  }
  return results;
}

}  // namespace assay::reports
