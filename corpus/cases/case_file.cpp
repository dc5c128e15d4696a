// The fields of a case are listed once; the code that reads and the code that writes both use the
// list.
#include "corpus/cases/case_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cmath>
#include <new>

#include "corpus/files.h"
#include "corpus/json_fields.h"
#include "detector/mesh/mesh_checks.h"

namespace assay::corpus {

namespace {

using detector::Point;

// A rule: triangles name vertices below `vertices`. A triangle names a vertex twice only if
// `may_repeat` is set.
struct Corners {
  std::int64_t vertices;
  bool may_repeat;
};
// A rule: as many steps as the case has, or none.
struct StepsOrNone {
  const Case& of;
};

std::int64_t vertices_of(const Case& c) { return c.frames.empty() ? 0 : c.frames[0].rows(); }

template <class Archive>
void fields(Archive& archive, CaseView& view, const Items& frames) {
  archive.must("q0", view.q0, frames);
  archive.may("q1", view.q1, frames);
}

template <class Archive>
void fields(Archive& archive, CaseGhosts& ghosts, const Case& c) {
  archive.must("apexes", ghosts.apexes, Items{c.frames.size()});
  const auto apexes = ghosts.apexes.empty() ? 0 : ghosts.apexes[0].size();
  archive.must("triangles", ghosts.triangles,
               Corners{vertices_of(c) + static_cast<std::int64_t>(apexes), true});
}

template <class Archive>
void fields(Archive& archive, ExpectedStep& step, const Case& c) {
  const auto ghosts = c.ghosts ? c.ghosts->triangles.rows() : 0;
  archive.must("answer", step.answer);
  archive.may("first_time", step.first_time);
  archive.may("pairs", step.pairs, Below{c.triangles.rows()});
  archive.may("view_signs", step.view_signs, Items{static_cast<std::size_t>(c.triangles.rows())});
  archive.may("ghost_view_signs", step.ghost_view_signs, Items{static_cast<std::size_t>(ghosts)});
}

// The answer alone, without the steps.
struct AnswerOf {
  ExpectedFacts& facts;
};
template <class Archive>
void fields(Archive& archive, AnswerOf& of) {
  archive.may("answer", of.facts.answer);
}
template <class Archive>
void fields(Archive& archive, ExpectedFacts& facts, const Case& c) {
  archive.may("answer", facts.answer);
  archive.must("steps", facts.steps, StepsOrNone{c}, c);
}

// Returns the runs of consecutive vertices of one body: how many vertices, and the body.
std::vector<std::array<std::int32_t, 2>> runs_of(const std::vector<std::int32_t>& body) {
  std::vector<std::array<std::int32_t, 2>> runs;
  for (const std::int32_t b : body) {
    if (runs.empty() || runs.back()[1] != b) runs.push_back({0, b});
    ++runs.back()[0];
  }
  return runs;
}

template <class Archive>
void fields(Archive& archive, CaseRelation& relation, const Case& c) {
  auto& pairs = relation.pairs;
  const std::int64_t vertices = vertices_of(c), triangles = c.triangles.rows();
  auto bodies = runs_of(pairs.body);
  archive.must("level", pairs.level);
  archive.may("bodies", bodies, Below{vertices + 1});
  if constexpr (Archive::reads) {
    for (const auto& [count, body] : bodies) {
      if (static_cast<std::int64_t>(pairs.body.size()) + count > vertices)
        archive.refuse("bodies", fmt::format("more than {} vertices", vertices));
      pairs.body.insert(pairs.body.end(), static_cast<std::size_t>(count), body);
    }
  }
  archive.may("apart", pairs.apart, Below{vertices});
  archive.may("rings", pairs.rings, Below{std::int64_t{1} << 31});
  archive.may("rest_distance", pairs.rest_distance);
  const auto usual = pairs.rest_distance != 0 ? points_of(c.frames[0]) : std::vector<Point>();
  if (Archive::reads) pairs.rest = usual;
  if (Archive::reads || pairs.rest != usual) archive.may("rest", pairs.rest);
  archive.may("triangle_pairs", pairs.triangle_pairs, Below{triangles});
  archive.may("vertex_faces", pairs.vertex_faces, Below{std::max(vertices, triangles)});
  archive.may("edge_pairs", pairs.edge_pairs, Below{vertices});
  if constexpr (Archive::reads) {
    if (const auto problem = detector::check_counted_pairs(pairs, c.triangles, vertices))
      throw Refused{archive.object().problem(
          fmt::format("{}: {}", name_of(problem->error), problem->message))};
  }
  archive.may("steps", relation.steps, Items{steps_of(c).size()}, c);
}

template <class Archive>
void fields(Archive& archive, Case& c) {
  archive.must("id", c.id);
  archive.must("about", c.about);
  archive.must("source", c.source);
  // Fields behind the triangles say which triangles are allowed.
  if constexpr (Archive::reads) {
    archive.must("frames", c.frames);
    archive.must("expected", AnswerOf{c.expected});
  }
  const bool may_repeat = c.expected.answer == detector::Answer::error;
  archive.must("triangles", c.triangles, Corners{vertices_of(c), may_repeat});
  if constexpr (Archive::reads) {
    if (c.triangles.rows() == 0) archive.refuse("triangles", "none");
  } else {
    archive.must("frames", c.frames);
  }
  archive.may("script", c.script, Below{static_cast<std::int64_t>(c.frames.size())});
  archive.may("view", c.view, Items{c.frames.size()});
  archive.may("ghosts", c.ghosts, c);
  archive.must("options", c.options);
  archive.must("expected", c.expected, c);
  archive.may("counted", c.counted, c);
}

class CaseReader : public JsonReader<CaseReader> {
 public:
  using JsonReader::JsonReader, JsonReader::read;

  template <class T, class... Rules>
  requires requires(CaseReader& reader, T& x, const Rules&... rules) {
    fields(reader, x, rules...);
  }
  static void read(const JsonField& field, T& x, const Rules&... rules) {
    CaseReader reader(field);
    fields(reader, x, rules...);
  }
  template <class... Numbers>
  static void read_row(const JsonField& field, const Below& end, Numbers&... numbers) {
    expect_size(field, sizeof...(numbers));
    std::size_t i = 0;
    (read(field.item(i++), numbers, end), ...);
  }
  static void read(const JsonField& field, std::array<std::int32_t, 2>& x, const Below& end) {
    read_row(field, end, x[0], x[1]);
  }
  static void read(const JsonField& field, Point& x) {
    expect_size(field, 3);
    for (std::size_t k = 0; k < 3; ++k) read(field.item(k), x[k]);
  }
  static void read(const JsonField& field, detector::Positions& x) {
    std::vector<Point> points;
    read(field, points);
    x.resize(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
      x.row(static_cast<Eigen::Index>(i)) << points[i][0], points[i][1], points[i][2];
  }
  static void read(const JsonField& field, std::vector<detector::Positions>& frames) {
    const auto size = want(field.size());
    for (std::size_t i = 0; i < size; ++i) read(field.item(i), frames.emplace_back());
    if (size == 0) throw Refused{field.problem("at least one frame expected")};
    for (std::size_t i = 1; i < size; ++i) {
      if (frames[i].rows() != frames[0].rows())
        throw Refused{field.item(i).problem(
            fmt::format("{} vertices, but frame 0 has {}", frames[i].rows(), frames[0].rows()))};
    }
  }
  static void read(const JsonField& field, std::vector<std::vector<Point>>& apexes,
                   const Items& frames) {
    expect_size(field, frames.count);
    apexes.resize(frames.count);
    for (std::size_t i = 0; i < frames.count; ++i) read(field.item(i), apexes[i]);
    for (std::size_t i = 1; i < frames.count; ++i) expect_size(field.item(i), apexes[0].size());
  }
  static void read(const JsonField& field, detector::Triangles& triangles, const Corners& corners) {
    const auto size = want(field.size());
    triangles.resize(static_cast<Eigen::Index>(size), 3);
    for (std::size_t i = 0; i < size; ++i) {
      std::array<std::int32_t, 3> t{};
      read_row(field.item(i), Below{corners.vertices}, t[0], t[1], t[2]);
      if (!corners.may_repeat && (t[0] == t[1] || t[1] == t[2] || t[0] == t[2]))
        throw Refused{field.item(i).problem("the triangle names a vertex twice")};
      triangles.row(static_cast<Eigen::Index>(i)) << t[0], t[1], t[2];
    }
  }
  static void read(const JsonField& field, std::vector<CaseStep>& script, const Below& frames) {
    const auto size = want(field.size());
    for (std::size_t i = 0; i < size; ++i) {
      CaseStep& step = script.emplace_back();
      const auto item = field.item(i);
      std::string action;
      expect_size(item, 3);
      read(item.item(0), step.from, frames);
      read(item.item(1), step.to, frames);
      read(item.item(2), action);
      step.commit = action == "commit";
      if (!step.commit && action != "evaluate")
        throw Refused{item.item(2).problem("\"commit\" or \"evaluate\" expected")};
    }
    if (size == 0) throw Refused{field.problem("at least one step expected")};
  }
  static void read(const JsonField& field, std::map<std::string, std::string, std::less<>>& map) {
    if (!field.json().is_object()) throw Refused{field.problem("an object expected")};
    for (const auto& [key, value] : field.json().items()) read(want(field.at(key)), map[key]);
  }
  static void read(const JsonField& field, std::vector<ExpectedStep>& steps,
                   const StepsOrNone& rule, const Case& c) {
    read(field, steps, c);
    if (!steps.empty()) expect_size(field, steps_of(rule.of).size());
  }
  // Returns two numbers of an array, from the item `from` on.
  static detector::TimeEnclosure time_at(const JsonField& field, std::size_t from) {
    detector::TimeEnclosure time;
    read(field.item(from), time.lo);
    read(field.item(from + 1), time.hi);
    if (!(0 <= time.lo && time.lo <= time.hi && time.hi <= 1))
      throw Refused{field.item(from).problem("times with 0 <= lo <= hi <= 1 expected")};
    return time;
  }
  static void read(const JsonField& field, detector::TimeEnclosure& time) {
    expect_size(field, 2);
    time = time_at(field, 0);
  }
  static void read(const JsonField& field, ExpectedPair& x, const Below& triangles) {
    expect_size(field, 4);
    x.pair.b = want(field.item(1).integer(1, triangles.end));
    read(field.item(0), x.pair.a, Below{x.pair.b});
    x.time = time_at(field, 2);
  }
  static void read(const JsonField& field, detector::ViewSign& sign) {
    sign = static_cast<detector::ViewSign>(want(field.integer(-1, 2)));
  }
  static void read(const JsonField& field, detector::TrianglePair& x, const Below& end) {
    read_row(field, end, x.a, x.b);
  }
  static void read(const JsonField& field, detector::VertexAndFace& x, const Below& end) {
    read_row(field, end, x.vertex, x.face);
  }
  static void read(const JsonField& field, detector::TwoEdges& x, const Below& end) {
    read_row(field, end, x.a[0], x.a[1], x.b[0], x.b[1]);
  }
};

// Writes the canonical text by hand, because a JSON library either breaks no lines or breaks every
// number onto its own.
class CaseWriter {
 public:
  static constexpr bool reads = false;
  CaseWriter(std::string& out, std::size_t indent) : out_(out), indent_(indent) { out_ += "{"; }

  template <class T, class... Rules>
  void must(const char* key, const T& x, const Rules&... rules) {
    out_ += fmt::format("{}\n{:{}}\"{}\": ", is_first_ ? "" : ",", "", indent_, key);
    is_first_ = false;
    write(x, rules...);
  }
  template <class T, class... Rules>
  void may(const char* key, const T& x, const Rules&... rules) {
    if (x != T{}) must(key, x, rules...);
  }
  template <class T, class... Rules>
  void may(const char* key, const std::vector<T>& x, const Rules&... rules) {
    if (!x.empty()) must(key, x, rules...);
  }
  template <class T, class... Rules>
  void may(const char* key, const std::optional<T>& x, const Rules&... rules) {
    if (x) must(key, *x, rules...);
  }
  void end() { out_ += fmt::format("\n{:{}}}}", "", indent_ - 2); }

 private:
  static std::string number(double value) {
    // JSON readers take "-0" for the integer 0 and lose the sign.
    if (value == 0 && std::signbit(value)) return "-0.0";
    return fmt::format("{}", value);
  }
  template <class... Numbers>
  void row(const Numbers&... numbers) {
    const char* separator = "[";
    ((out_ += separator, write(numbers), separator = ", "), ...);
    out_ += "]";
  }
  // Items, one a line.
  template <class WriteItem>
  void rows(std::size_t count, WriteItem write_item) {
    out_ += "[";
    indent_ += 2;
    for (std::size_t i = 0; i < count; ++i) {
      out_ += fmt::format("{}\n{:{}}", i == 0 ? "" : ",", "", indent_);
      write_item(i);
    }
    indent_ -= 2;
    out_ += count == 0 ? "]" : fmt::format("\n{:{}}]", "", indent_);
  }

  template <class T, class... Rules>
  requires requires(CaseWriter& writer, T& x, const Rules&... rules) {
    fields(writer, x, rules...);
  }
  void write(const T& x, const Rules&... rules) {
    CaseWriter writer(out_, indent_ + 2);
    // A writer changes nothing; readers use the list too.
    fields(writer, const_cast<T&>(x), rules...);
    writer.end();
  }
  // Writes text, such as a file name or a message, which need not be valid UTF-8.
  void write(const std::string& text) { out_ += json_text(Json(text)); }
  void write(double x) { out_ += number(x); }
  template <class... Rules>
  void write(std::int32_t x, const Rules&...) {
    out_ += fmt::format("{}", x);
  }
  template <Listed Enum>
  void write(Enum x) {
    out_ += fmt::format("\"{}\"", name_of(x));
  }
  void write(const Point& x) { row(x[0], x[1], x[2]); }
  void write(const detector::TimeEnclosure& time) { row(time.lo, time.hi); }
  void write(const ExpectedPair& x, const Below&) { row(x.pair.a, x.pair.b, x.time.lo, x.time.hi); }
  void write(const CaseStep& x, const Below&) {
    row(x.from, x.to, std::string(x.commit ? "commit" : "evaluate"));
  }
  void write(const std::array<std::int32_t, 2>& x, const Below&) { row(x[0], x[1]); }
  void write(const detector::TrianglePair& x, const Below&) { row(x.a, x.b); }
  void write(const detector::VertexAndFace& x, const Below&) { row(x.vertex, x.face); }
  void write(const detector::TwoEdges& x, const Below&) { row(x.a[0], x.a[1], x.b[0], x.b[1]); }
  void write(const detector::Positions& x) { write(points_of(x)); }
  void write(const detector::Triangles& triangles, const Corners&) {
    rows(static_cast<std::size_t>(triangles.rows()), [&](std::size_t i) {
      const auto t = triangles.row(static_cast<Eigen::Index>(i));
      row(t[0], t[1], t[2]);
    });
  }
  void write(const std::vector<detector::ViewSign>& signs, const Items&) {
    out_ += "[";
    for (std::size_t i = 0; i < signs.size(); ++i)
      out_ += fmt::format("{}{}", i == 0 ? "" : ", ", static_cast<int>(signs[i]));
    out_ += "]";
  }
  void write(const std::map<std::string, std::string, std::less<>>& options) {
    out_ += "{";
    const char* separator = "";
    for (const auto& [key, value] : options) {
      out_ += separator + json_text(Json(key)) + ": " + json_text(Json(value));
      separator = ", ";
    }
    out_ += "}";
  }
  template <class T, class... Rules>
  void write(const std::vector<T>& list, const Rules&... rules) {
    rows(list.size(), [&](std::size_t i) { write(list[i], rules...); });
  }
  template <class T, class... Rules>
  void write(const std::vector<T>& list, const Items&, const Rules&... rules) {
    write(list, rules...);
  }
  template <class T, class... Rules>
  void write(const std::vector<T>& list, const StepsOrNone&, const Rules&... rules) {
    write(list, rules...);
  }

  std::string& out_;
  std::size_t indent_;
  bool is_first_ = true;
};

// Returns one key a line, the values as they came.
std::string pending_text(const std::string& pending) {
  const Json facts = Json::parse(pending, nullptr, false);
  if (!facts.is_object() || facts.empty()) return "{}";
  std::string out;
  for (const auto& [key, value] : facts.items())
    out += fmt::format("{}\n    {}: {}", out.empty() ? "{" : ",", json_text(Json(key)),
                       json_text(value));
  return out + "\n  }";
}

}  // namespace

std::string case_text(const Case& c) {
  std::string out;
  CaseWriter writer(out, 2);
  writer.must("schema", std::string(case_schema));
  fields(writer, const_cast<Case&>(c));
  return out + ",\n  \"pending\": " + pending_text(c.pending) + "\n}\n";
}

Expected<Case> parse_case(std::string_view text, std::string_view name) try {
  const std::filesystem::path file(name);
  const Json json = want(parse_json(text, file));
  CaseReader reader(JsonField(json, file));
  const auto schema = want(reader.object().at("schema"));
  if (schema.json() != case_schema) return schema.problem(fmt::format("{} expected", case_schema));
  Case c;
  fields(reader, c);
  const auto pending = want(reader.object().at("pending"));
  if (!pending.json().is_object()) return pending.problem("an object expected");
  c.pending = pending.json().dump();
  return c;
} catch (const Refused& refused) {
  return refused.problem;
} catch (const std::bad_alloc&) {
  return problem_in(name, "larger than the memory at hand");
}

Expected<Case> read_case(const std::filesystem::path& path) {
  BOOST_OUTCOME_TRY(bytes, read_bytes(path));
  return parse_case(bytes, path.string());
}

Expected<void> write_case(const std::filesystem::path& path, const Case& c) {
  const std::string text = case_text(c);
  // A case that cannot be replayed must be noticed now.
  BOOST_OUTCOME_TRY(parse_case(text, path.string()));
  return write_file_atomically(path, text);
}

Expected<std::vector<std::filesystem::path>> case_files(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> paths;
  std::filesystem::directory_iterator file(folder, error);
  for (const std::filesystem::directory_iterator end; !error && file != end;
       file.increment(error)) {
    if (file->path().extension() == ".json") paths.push_back(file->path());
  }
  if (error) return problem_in(folder, error.message());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace assay::corpus
