#include "reports/vectors/vector_set.h"

#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <limits>
#include <set>

#include "corpus/digest.h"
#include "corpus/file_bytes.h"

namespace assay::reports {

using corpus::Expected;
using corpus::JsonField;
using corpus::Problem;
namespace outcome = boost::outcome_v2;

Expected<TimeInterval> read_interval(const JsonField& field) {
  BOOST_OUTCOME_TRY(
      times, corpus::read_list<double>(field, [](const JsonField& item) { return item.number(); }));
  if (times.size() != 2 || times[0] > times[1])
    return field.problem("two numbers expected, the lesser one first");
  return TimeInterval{times[0], times[1]};
}

Expected<VectorPair> read_pair(const JsonField& field, std::int32_t triangles) {
  BOOST_OUTCOME_TRY(size, field.size());
  if (size < 2) return field.problem("two triangles expected");
  BOOST_OUTCOME_TRY(a, field.item(0).integer(0, triangles));
  BOOST_OUTCOME_TRY(b, field.item(1).integer(0, triangles));
  if (a >= b) return field.problem("two triangles expected, the lesser one first");
  return VectorPair{a, b};
}

namespace {

Expected<std::string> text_at(const JsonField& object, std::string_view key) {
  BOOST_OUTCOME_TRY(field, object.at(key));
  return field.text();
}

Expected<void> want_schema(const JsonField& object) {
  BOOST_OUTCOME_TRY(field, object.at("schema"));
  BOOST_OUTCOME_TRY(schema, field.text());
  if (schema != "assay-vectors/1") return field.problem("\"assay-vectors/1\" expected");
  return outcome::success();
}

Expected<VectorStep> read_step(const JsonField& object, std::int32_t triangles) {
  VectorStep step;
  BOOST_OUTCOME_TRY(field, object.at("result"));
  BOOST_OUTCOME_TRY(word, field.text());
  if (word == "collision") {
    step.result = VectorResult::collision;
  } else if (word == "acceptable") {
    step.result = VectorResult::acceptable;
  } else if (word != "free") {
    return field.problem("free, collision or acceptable expected");
  }
  if (object.has("first_time")) {
    BOOST_OUTCOME_TRY(time, object.at("first_time"));
    BOOST_OUTCOME_TRY(interval, read_interval(time));
    step.first_time = interval;
  }
  if (object.has("pairs")) {
    BOOST_OUTCOME_TRY(pairs, object.at("pairs"));
    const auto read = [&](const JsonField& item) { return read_pair(item, triangles); };
    BOOST_OUTCOME_TRY(all, corpus::read_list<VectorPair>(pairs, read));
    step.pairs = std::move(all);
  }
  return step;
}

Expected<VectorCase> read_case(const JsonField& object, const VectorCase& of_group) {
  VectorCase one = of_group;
  BOOST_OUTCOME_TRY(id, text_at(object, "id"));
  BOOST_OUTCOME_TRY(about, text_at(object, "about"));
  BOOST_OUTCOME_TRY(flags, object.at("flags"));
  BOOST_OUTCOME_TRY(names, corpus::read_list<std::string>(
                               flags, [](const JsonField& item) { return item.text(); }));
  one.id = std::move(id);
  one.about = std::move(about);
  one.flags = std::move(names);
  if (!one.is_mesh) {
    BOOST_OUTCOME_TRY(step, read_step(object, 0));
    one.steps.push_back(std::move(step));
    return one;
  }
  BOOST_OUTCOME_TRY(triangles, object.at("triangles"));
  BOOST_OUTCOME_TRY(count, triangles.size());
  one.triangles = static_cast<std::int32_t>(count);
  BOOST_OUTCOME_TRY(steps, object.at("steps"));
  const auto read = [&](const JsonField& item) { return read_step(item, one.triangles); };
  BOOST_OUTCOME_TRY(all, corpus::read_list<VectorStep>(steps, read));
  if (all.empty()) return steps.problem("at least one step expected");
  one.steps = std::move(all);
  return one;
}

Expected<VectorFlag> read_flag(const std::string& name, const JsonField& flags) {
  BOOST_OUTCOME_TRY(flag, flags.at(name));
  BOOST_OUTCOME_TRY(about, text_at(flag, "about"));
  BOOST_OUTCOME_TRY(wrong, text_at(flag, "wrong"));
  return VectorFlag{name, about, wrong};
}

class SetReader {
 public:
  explicit SetReader(const std::filesystem::path& folder) : folder_(folder) {}

  Expected<VectorSet> read() {
    const auto file = folder_ / "set.json";
    BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(file));
    BOOST_OUTCOME_TRY(json, corpus::parse_json(bytes, file));
    const JsonField object(json, file);
    BOOST_OUTCOME_TRY(want_schema(object));
    for (const auto& [key, target] : {std::pair{"version", &set_.version},
                                      {"profile", &set_.profile},
                                      {"digest", &set_.digest}}) {
      BOOST_OUTCOME_TRY(text, text_at(object, key));
      *target = std::move(text);
    }
    BOOST_OUTCOME_TRY(flags, object.at("flags"));
    for (const auto& [name, unused] : flags.json().items()) {
      BOOST_OUTCOME_TRY(flag, read_flag(name, flags));
      set_.flags.push_back(std::move(flag));
    }
    BOOST_OUTCOME_TRY(groups, object.at("groups"));
    BOOST_OUTCOME_TRY(count, groups.size());
    for (std::size_t i = 0; i < count; ++i) {
      BOOST_OUTCOME_TRY(read_group(groups.item(i)));
    }
    if (corpus::sha256_of(digested_) != set_.digest)
      return corpus::problem_in(file, "its digest is not that of its groups");
    return std::move(set_);
  }

 private:
  Expected<void> read_group(const JsonField& entry) {
    BOOST_OUTCOME_TRY(name, text_at(entry, "file"));
    BOOST_OUTCOME_TRY(sha256, text_at(entry, "sha256"));
    // A name that leads out of the folder names no file of the set.
    if (std::filesystem::path(name).filename() != name)
      return entry.problem("file is not the name of a file beside set.json");
    const auto file = folder_ / name;
    BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(file));
    const auto digest = corpus::sha256_of(bytes);
    if (digest != sha256) {
      return corpus::problem_in(
          file, fmt::format("changed: its SHA-256 is {}, and set.json has another", digest));
    }
    digested_ += fmt::format("{}  {}\n", digest, name);
    BOOST_OUTCOME_TRY(json, corpus::parse_json(bytes, file));
    const JsonField group(json, file);
    BOOST_OUTCOME_TRY(want_schema(group));
    BOOST_OUTCOME_TRY(title, text_at(group, "group"));
    BOOST_OUTCOME_TRY(features, text_at(group, "features"));
    BOOST_OUTCOME_TRY(question, text_at(group, "question"));
    VectorCase of_group;
    of_group.group = title;
    of_group.is_mesh = features == "mesh";
    of_group.is_limit = question == "limit";
    set_.groups.push_back(title);
    BOOST_OUTCOME_TRY(cases, group.at("cases"));
    BOOST_OUTCOME_TRY(count, cases.size());
    for (std::size_t i = 0; i < count; ++i) {
      BOOST_OUTCOME_TRY(one, read_case(cases.item(i), of_group));
      if (!ids_.insert(one.id).second)
        return cases.item(i).problem(fmt::format("case {} is there twice", one.id));
      set_.cases.push_back(std::move(one));
    }
    return outcome::success();
  }

  const std::filesystem::path& folder_;
  VectorSet set_;
  std::string digested_;  // the text that the digest of the set is of
  std::set<std::string> ids_;
};

}  // namespace

Expected<VectorSet> read_vector_set(const std::filesystem::path& folder) {
  return SetReader(folder).read();
}

}  // namespace assay::reports
