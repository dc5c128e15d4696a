#include "properties/vectors/set_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cmath>
#include <set>

#include "corpus/digest.h"
#include "corpus/file_bytes.h"
#include "properties/reducer/case_edits.h"
#include "properties/vectors/set_files.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

using corpus::JsonField;

Expected<std::string> text_at(const JsonField& object, std::string_view key) {
  BOOST_OUTCOME_TRY(field, object.at(key));
  return field.text();
}

Expected<void> want_schema(const JsonField& object, std::string_view schema) {
  BOOST_OUTCOME_TRY(word, text_at(object, "schema"));
  if (word == schema) return boost::outcome_v2::success();
  return object.problem(fmt::format("schema '{}' is not {}", word, schema));
}

Expected<detector::TimeEnclosure> read_interval(const JsonField& field) {
  const auto read = [](const JsonField& item) { return item.number(); };
  BOOST_OUTCOME_TRY(times, corpus::read_list<double>(field, read));
  if (times.size() != 2 || times[0] > times[1])
    return field.problem("two numbers expected, the lesser one first");
  return detector::TimeEnclosure{times[0], times[1]};
}

Expected<detector::TrianglePair> read_pair(const JsonField& field, std::int64_t triangles) {
  BOOST_OUTCOME_TRY(size, field.size());
  if (size < 2) return field.problem("two triangles expected");
  BOOST_OUTCOME_TRY(a, field.item(0).integer(0, triangles));
  BOOST_OUTCOME_TRY(b, field.item(1).integer(0, triangles));
  if (a >= b) return field.problem("two triangles expected, the lesser one first");
  return detector::TrianglePair{a, b};
}

namespace {

template <class T>
Expected<void> put(T& place, Expected<T> value) {
  BOOST_OUTCOME_TRY(read, std::move(value));
  place = std::move(read);
  return boost::outcome_v2::success();
}

template <class Enum>
Expected<Enum> word_at(const JsonField& object, const char* key) {
  BOOST_OUTCOME_TRY(field, object.at(key));
  BOOST_OUTCOME_TRY(word, field.text());
  const auto named = from_name<Enum>(word);
  if (!named) return field.problem(fmt::format("'{}' is none of: {}", word, all_names<Enum>()));
  return *named;
}

Expected<std::string> text_if_any(const JsonField& object, std::string_view key) {
  if (!object.has(key)) return std::string();
  return text_at(object, key);
}

Expected<double> number_at(const JsonField& object, const char* key) {
  BOOST_OUTCOME_TRY(field, object.at(key));
  return field.number();
}

// Calls use(item) for each item of an array, until one of them fails.
template <class Use>
Expected<void> for_each_item(const JsonField& array, const Use& use) {
  BOOST_OUTCOME_TRY(size, array.size());
  for (std::size_t i = 0; i < size; ++i) {
    BOOST_OUTCOME_TRYV(use(array.item(i)));
  }
  return boost::outcome_v2::success();
}

Expected<std::vector<std::string>> texts_at(const JsonField& object, const char* key) {
  if (!object.has(key)) return std::vector<std::string>();
  BOOST_OUTCOME_TRY(field, object.at(key));
  return corpus::read_list<std::string>(field, [](const JsonField& item) { return item.text(); });
}

Expected<detector::Positions> points_of(const JsonField& field) {
  BOOST_OUTCOME_TRY(size, field.size());
  detector::Positions points(static_cast<Eigen::Index>(size), 3);
  for (std::size_t i = 0; i < size; ++i) {
    const auto point = field.item(i);
    BOOST_OUTCOME_TRY(numbers, point.size());
    if (numbers != 3) return point.problem("wants 3 numbers");
    for (int k = 0; k < 3; ++k) {
      BOOST_OUTCOME_TRYV(put(points(static_cast<Eigen::Index>(i), k),
                             point.item(static_cast<std::size_t>(k)).number()));
    }
  }
  return points;
}

Expected<corpus::ExpectedPair> read_contact(const JsonField& item, std::int64_t triangles) {
  corpus::ExpectedPair contact;
  BOOST_OUTCOME_TRYV(put(contact.pair, read_pair(item, triangles)));
  BOOST_OUTCOME_TRY(size, item.size());
  if (size != 4) return item.problem("wants 4 numbers");
  BOOST_OUTCOME_TRYV(put(contact.time.lo, item.item(2).number()));
  BOOST_OUTCOME_TRYV(put(contact.time.hi, item.item(3).number()));
  if (contact.time.lo > contact.time.hi)
    return item.problem("its first time ends before it begins");
  return contact;
}

Expected<VectorFacts> facts_of(const JsonField& object, std::int64_t triangles) {
  VectorFacts facts;
  BOOST_OUTCOME_TRYV(put(facts.result, word_at<VectorResult>(object, "result")));
  if (object.has("first_time")) {
    BOOST_OUTCOME_TRY(field, object.at("first_time"));
    BOOST_OUTCOME_TRYV(put(facts.first.emplace(), read_interval(field)));
  }
  BOOST_OUTCOME_TRYV(put(facts.polynomial, texts_at(object, "polynomial")));
  if (object.has("least_distance")) {
    BOOST_OUTCOME_TRYV(put(facts.least_distance.emplace(), number_at(object, "least_distance")));
  }
  if (object.has("pairs")) {
    BOOST_OUTCOME_TRY(pairs, object.at("pairs"));
    const auto read = [&](const JsonField& item) { return read_contact(item, triangles); };
    BOOST_OUTCOME_TRYV(
        put(facts.pairs.emplace(), corpus::read_list<corpus::ExpectedPair>(pairs, read)));
  }
  return facts;
}

Expected<void> read_query(const JsonField& object, VectorFeatures features, Vector& v) {
  BOOST_OUTCOME_TRY(t0, object.at("t0"));
  BOOST_OUTCOME_TRY(t1, object.at("t1"));
  BOOST_OUTCOME_TRY(start, points_of(t0));
  BOOST_OUTCOME_TRY(end, points_of(t1));
  if (start.rows() != 4 || end.rows() != 4) return object.problem("a query has four points");
  detector::FourPoints query;
  query.first_group = features == VectorFeatures::vertex_face ? 1 : 2;
  const detector::SteppedMesh motion{start, end};
  for (std::int32_t i = 0; i < 4; ++i) query.points[detector::at(i)] = motion.path(i);
  auto c = case_of_query(query, v.c.id);
  c.about = v.c.about;
  c.source = v.c.source;
  v.c = std::move(c);
  BOOST_OUTCOME_TRY(facts, facts_of(object, 0));
  v.steps.push_back(std::move(facts));
  if (v.question == VectorQuestion::distance) {
    BOOST_OUTCOME_TRYV(put(v.distance, number_at(object, "distance")));
    if (!v.steps[0].least_distance) v.steps[0].least_distance = INFINITY;
  }
  return boost::outcome_v2::success();
}

Expected<void> read_mesh(const JsonField& object, Vector& v) {
  constexpr std::int64_t most = 1 << 24;
  BOOST_OUTCOME_TRY(frames, object.at("frames"));
  BOOST_OUTCOME_TRYV(put(v.c.frames, corpus::read_list<detector::Positions>(frames, points_of)));
  if (v.c.frames.empty()) return object.problem("has no frames");
  const auto vertices = v.c.frames[0].rows();
  BOOST_OUTCOME_TRY(list, object.at("triangles"));
  BOOST_OUTCOME_TRY(triangles, list.size());
  v.c.triangles.resize(static_cast<Eigen::Index>(triangles), 3);
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto item = list.item(t);
    BOOST_OUTCOME_TRY(corners, item.size());
    if (corners != 3) return item.problem("a triangle has three corners");
    for (int k = 0; k < 3; ++k) {
      BOOST_OUTCOME_TRYV(put(v.c.triangles(static_cast<Eigen::Index>(t), k),
                             item.item(static_cast<std::size_t>(k)).integer(0, vertices)));
    }
  }
  BOOST_OUTCOME_TRY(steps, object.at("steps"));
  const auto read_steps = [&](const JsonField& item) -> Expected<void> {
    corpus::CaseStep step;
    BOOST_OUTCOME_TRY(from, item.at("from"));
    BOOST_OUTCOME_TRYV(put(step.from, from.integer(0, most)));
    BOOST_OUTCOME_TRY(to, item.at("to"));
    BOOST_OUTCOME_TRYV(put(step.to, to.integer(0, most)));
    BOOST_OUTCOME_TRY(commit, item.at("commit"));
    step.commit = commit.json() == true;
    const auto end = static_cast<std::int32_t>(v.c.frames.size());
    if (step.from >= end || step.to >= end) return item.problem("names no frame");
    v.c.script.push_back(step);
    BOOST_OUTCOME_TRY(facts, facts_of(item, v.c.triangles.rows()));
    v.steps.push_back(std::move(facts));
    return boost::outcome_v2::success();
  };
  BOOST_OUTCOME_TRYV(for_each_item(steps, read_steps));
  if (v.c.script == corpus::consecutive_steps(v.c.frames.size())) v.c.script.clear();
  if (v.steps.empty() || !is_valid(v.c)) return object.problem("is no mesh with steps");
  return boost::outcome_v2::success();
}

Expected<Vector> read_vector(const JsonField& object, const VectorGroup& group) {
  Vector v;
  v.question = group.question;
  BOOST_OUTCOME_TRYV(put(v.c.id, text_at(object, "id")));
  BOOST_OUTCOME_TRYV(put(v.c.about, text_if_any(object, "about")));
  BOOST_OUTCOME_TRYV(put(v.c.source, text_if_any(object, "source")));
  BOOST_OUTCOME_TRYV(group.features == VectorFeatures::mesh
                         ? read_mesh(object, v)
                         : read_query(object, group.features, v));
  BOOST_OUTCOME_TRY(flags, texts_at(object, "flags"));
  for (const auto& word : flags) {
    const auto flag = from_name<VectorFlag>(word);
    if (!flag) return object.problem(fmt::format("has an unknown flag '{}'", word));
    v.flags.push_back(*flag);
  }
  if (object.has("hard")) {
    BOOST_OUTCOME_TRY(hard, object.at("hard"));
    BOOST_OUTCOME_TRYV(put(v.hard.kind, text_at(hard, "kind")));
    BOOST_OUTCOME_TRY(bits, hard.at("bits"));
    BOOST_OUTCOME_TRYV(put(v.hard.bits, bits.integer(0, 10'000)));
  }
  BOOST_OUTCOME_TRYV(put(v.open, texts_at(object, "open")));
  BOOST_OUTCOME_TRYV(put(v.breaks, texts_at(object, "breaks")));
  BOOST_OUTCOME_TRYV(put(v.split_of, text_if_any(object, "split_of")));
  return v;
}

Expected<VectorGroup> read_group(const JsonField& object) {
  VectorGroup group;
  BOOST_OUTCOME_TRYV(want_schema(object, vectors_schema));
  BOOST_OUTCOME_TRYV(put(group.features, word_at<VectorFeatures>(object, "features")));
  BOOST_OUTCOME_TRYV(put(group.question, word_at<VectorQuestion>(object, "question")));
  BOOST_OUTCOME_TRYV(put(group.precision, word_at<VectorPrecision>(object, "precision")));
  BOOST_OUTCOME_TRY(cases, object.at("cases"));
  const auto read = [&](const JsonField& item) { return read_vector(item, group); };
  BOOST_OUTCOME_TRYV(put(group.cases, corpus::read_list<Vector>(cases, read)));
  return group;
}

Expected<std::vector<ReadFlag>> read_flags(const JsonField& flags) {
  std::vector<ReadFlag> read;
  if (!flags.json().is_object()) return flags.problem("an object expected");
  for (const auto& item : flags.json().items()) {
    const auto flag = from_name<VectorFlag>(item.key());
    if (!flag) return flags.problem(fmt::format("has an unknown flag '{}'", item.key()));
    BOOST_OUTCOME_TRY(text, flags.at(item.key()));
    BOOST_OUTCOME_TRY(wrong, text_at(text, "wrong"));
    read.push_back({*flag, std::move(wrong)});
  }
  return read;
}

}  // namespace

Expected<ReadSet> read_set(const std::filesystem::path& folder) {
  const auto path = folder / "set.json";
  BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(path));
  BOOST_OUTCOME_TRY(json, corpus::parse_json(bytes, path));
  const JsonField object(json, path);
  BOOST_OUTCOME_TRYV(want_schema(object, vectors_schema));
  ReadSet read;
  BOOST_OUTCOME_TRYV(put(read.version, text_at(object, "version")));
  BOOST_OUTCOME_TRYV(put(read.set.profile, text_at(object, "profile")));
  BOOST_OUTCOME_TRYV(put(read.digest, text_at(object, "digest")));
  BOOST_OUTCOME_TRY(flags, object.at("flags"));
  BOOST_OUTCOME_TRYV(put(read.flags, read_flags(flags)));
  BOOST_OUTCOME_TRY(groups, object.at("groups"));
  std::string digested;
  std::set<std::string> ids;
  const auto read_groups = [&](const JsonField& item) -> Expected<void> {
    BOOST_OUTCOME_TRY(name, text_at(item, "file"));
    BOOST_OUTCOME_TRY(wanted, text_at(item, "sha256"));
    const bool is_name = std::filesystem::path(name).filename() == name;
    if (!is_name) return item.problem(fmt::format("'{}' is no file of this folder", name));
    const auto file = folder / name;
    BOOST_OUTCOME_TRY(text, corpus::read_bytes(file));
    if (corpus::sha256_of(text) != wanted)
      return corpus::problem_in(file, "changed: its SHA-256 is not that of set.json");
    digested += fmt::format("{}  {}\n", wanted, name);
    BOOST_OUTCOME_TRY(of_group, corpus::parse_json(text, file));
    const JsonField field(of_group, file);
    BOOST_OUTCOME_TRYV(put(read.titles.emplace_back(), text_at(field, "group")));
    BOOST_OUTCOME_TRY(group, read_group(field));
    for (const auto& v : group.cases) {
      if (!ids.insert(v.c.id).second)
        return corpus::problem_in(file, fmt::format("case {} is there twice", v.c.id));
    }
    read.set.groups.push_back(std::move(group));
    return boost::outcome_v2::success();
  };
  BOOST_OUTCOME_TRYV(for_each_item(groups, read_groups));
  if (corpus::sha256_of(digested) != read.digest)
    return object.problem("its digest is not that of its groups");
  return read;
}

}  // namespace assay::properties
