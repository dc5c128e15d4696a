#include "corpus/cases/case_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cmath>

#include "corpus/atomic_file.h"
#include "corpus/file_bytes.h"
#include "corpus/json_fields.h"

namespace assay::corpus {
namespace {

// Canonical text of a case. It is written by hand because a JSON library either breaks no lines or
// breaks every number onto its own.

std::string number(double value) {
  // JSON readers take "-0" for the integer 0 and lose the sign.
  if (value == 0 && std::signbit(value)) return "-0.0";
  return fmt::format("{}", value);
}

std::string text(std::string_view value) {
  // A file name or a message need not be valid UTF-8.
  return json_text(Json(value));
}

std::string text(const detector::Point& x) {
  return fmt::format("[{}, {}, {}]", number(x[0]), number(x[1]), number(x[2]));
}

std::string text(const detector::TimeEnclosure& time) {
  return fmt::format("{}, {}", number(time.lo), number(time.hi));
}

std::string text(const std::vector<detector::ViewSign>& signs) {
  std::string line = "[";
  for (const detector::ViewSign sign : signs) {
    fmt::format_to(std::back_inserter(line), "{}{}", line.size() > 1 ? ", " : "",
                   static_cast<int>(sign));
  }
  return line + "]";
}

// Appends `count` items, one a line, as a JSON array at `indent`.
template <class ItemText>
void append_rows(std::string& out, std::size_t count, std::size_t indent, ItemText item) {
  if (count == 0) {
    out += "[]";
    return;
  }
  out += "[\n";
  for (std::size_t i = 0; i < count; ++i) {
    out.append(indent + 2, ' ').append(item(i)).append(i + 1 < count ? ",\n" : "\n");
  }
  out.append(indent, ' ').append("]");
}

void append_triangles(std::string& out, const detector::Triangles& triangles, std::size_t indent) {
  append_rows(out, static_cast<std::size_t>(triangles.rows()), indent, [&](std::size_t i) {
    const auto row = triangles.row(static_cast<Eigen::Index>(i));
    return fmt::format("[{}, {}, {}]", row(0), row(1), row(2));
  });
}

void append_points(std::string& out, const std::vector<detector::Point>& points,
                   std::size_t indent) {
  append_rows(out, points.size(), indent, [&](std::size_t i) { return text(points[i]); });
}

void append_frames(std::string& out, const Case& c) {
  append_rows(out, c.frames.size(), 2, [&](std::size_t f) {
    const detector::Positions& x = c.frames[f];
    std::string frame;
    append_rows(frame, static_cast<std::size_t>(x.rows()), 4, [&](std::size_t i) {
      return text(detector::point_of(x, static_cast<std::int32_t>(i)));
    });
    return frame;
  });
}

void append_script(std::string& out, const std::vector<CaseStep>& script) {
  out += ",\n  \"script\": ";
  append_rows(out, script.size(), 2, [&](std::size_t i) {
    return fmt::format("[{}, {}, \"{}\"]", script[i].from, script[i].to,
                       script[i].commit ? "commit" : "evaluate");
  });
}

void append_view(std::string& out, const CaseView& view) {
  out += ",\n  \"view\": {\n    \"q0\": ";
  append_points(out, view.q0, 4);
  if (!view.q1.empty()) {
    out += ",\n    \"q1\": ";
    append_points(out, view.q1, 4);
  }
  out += "\n  }";
}

void append_ghosts(std::string& out, const CaseGhosts& ghosts) {
  out += ",\n  \"ghosts\": {\n    \"apexes\": ";
  append_rows(out, ghosts.apexes.size(), 4, [&](std::size_t f) {
    std::string frame;
    append_points(frame, ghosts.apexes[f], 6);
    return frame;
  });
  out += ",\n    \"triangles\": ";
  append_triangles(out, ghosts.triangles, 4);
  out += "\n  }";
}

std::string step_text(const ExpectedStep& step) {
  std::string out = fmt::format("{{\n        \"answer\": \"{}\"", name_of(step.answer));
  if (step.first_time) {
    out += fmt::format(",\n        \"first_time\": [{}]", text(*step.first_time));
  }
  if (step.pairs) {
    out += ",\n        \"pairs\": ";
    append_rows(out, step.pairs->size(), 8, [&](std::size_t i) {
      const ExpectedPair& pair = (*step.pairs)[i];
      return fmt::format("[{}, {}, {}]", pair.pair.a, pair.pair.b, text(pair.time));
    });
  }
  if (step.view_signs) out += ",\n        \"view_signs\": " + text(*step.view_signs);
  if (step.ghost_view_signs) {
    out += ",\n        \"ghost_view_signs\": " + text(*step.ghost_view_signs);
  }
  return out + "\n      }";
}

// A list of rows under a key, if there are any.
template <class Item, class ItemText>
void append_list(std::string& out, std::string_view key, const std::vector<Item>& items,
                 ItemText item_text) {
  if (items.empty()) return;
  out += fmt::format(",\n    \"{}\": ", key);
  append_rows(out, items.size(), 4, [&](std::size_t i) { return item_text(items[i]); });
}

// Numbers of vertices that follow each other and are of one body, each with that body.
std::vector<std::array<std::int32_t, 2>> runs_of(const std::vector<std::int32_t>& body) {
  std::vector<std::array<std::int32_t, 2>> runs;
  for (const std::int32_t b : body) {
    if (runs.empty() || runs.back()[1] != b) runs.push_back({0, b});
    ++runs.back()[0];
  }
  return runs;
}

void append_counted(std::string& out, const Case& c) {
  const auto& [pairs, steps] = *c.counted;
  const auto two = [](const auto& pair) { return fmt::format("[{}, {}]", pair[0], pair[1]); };
  out += fmt::format(",\n  \"counted\": {{\n    \"level\": \"{}\"", name_of(pairs.level));
  append_list(out, "bodies", runs_of(pairs.body), two);
  append_list(out, "apart", pairs.apart, two);
  if (pairs.rings != 0) out += fmt::format(",\n    \"rings\": {}", pairs.rings);
  if (pairs.rest_distance != 0)
    out += fmt::format(",\n    \"rest_distance\": {}", number(pairs.rest_distance));
  if (pairs.rest_distance == 0 || pairs.rest != points_of(c.frames.front()))
    append_list(out, "rest", pairs.rest, [](const detector::Point& x) { return text(x); });
  append_list(out, "triangle_pairs", pairs.triangle_pairs,
              [](const auto& pair) { return fmt::format("[{}, {}]", pair.a, pair.b); });
  append_list(out, "vertex_faces", pairs.vertex_faces,
              [](const auto& pair) { return fmt::format("[{}, {}]", pair.vertex, pair.face); });
  append_list(out, "edge_pairs", pairs.edge_pairs, [](const auto& pair) {
    return fmt::format("[{}, {}, {}, {}]", pair.a[0], pair.a[1], pair.b[0], pair.b[1]);
  });
  append_list(out, "steps", steps, [](const ExpectedStep& step) { return step_text(step); });
  out += "\n  }";
}

// One key a line, the values as they came.
void append_pending(std::string& out, const std::string& pending) {
  const Json facts = Json::parse(pending, nullptr, false);
  out += ",\n  \"pending\": {";
  const char* separator = "\n";
  if (facts.is_object()) {
    for (const auto& [key, value] : facts.items()) {
      out += fmt::format("{}    {}: {}", separator, text(key), json_text(value));
      separator = ",\n";
    }
  }
  out += facts.is_object() && !facts.empty() ? "\n  }" : "}";
}

}  // namespace

std::string case_text(const Case& c) {
  std::string out =
      fmt::format("{{\n  \"schema\": {},\n  \"id\": {},\n  \"about\": {},\n  \"source\": {},\n",
                  text(case_schema), text(c.id), text(c.about), text(c.source));
  out += "  \"triangles\": ";
  append_triangles(out, c.triangles, 2);
  out += ",\n  \"frames\": ";
  append_frames(out, c);
  if (!c.script.empty()) append_script(out, c.script);
  if (c.view) append_view(out, *c.view);
  if (c.ghosts) append_ghosts(out, *c.ghosts);
  out += ",\n  \"options\": {";
  const char* separator = "";
  for (const auto& [key, value] : c.options) {
    out += fmt::format("{}{}: {}", separator, text(key), text(value));
    separator = ", ";
  }
  out += "},\n  \"expected\": {\n";
  if (c.expected.answer)
    out += fmt::format("    \"answer\": \"{}\",\n", name_of(*c.expected.answer));
  out += "    \"steps\": ";
  append_rows(out, c.expected.steps.size(), 4,
              [&](std::size_t i) { return step_text(c.expected.steps[i]); });
  out += "\n  }";
  if (c.counted) append_counted(out, c);
  append_pending(out, c.pending);
  return out + "\n}\n";
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
