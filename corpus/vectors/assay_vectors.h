// Asks a detector in C++17 all cases of a set of Assay vectors: in this process, or as a program
// that `vectors.py run` asks. Nothing but this header is needed; README.md says what is what.
//
//   struct Mine : assay_vectors::Detector {
//     assay_vectors::Answer vertex_face(const Points& t0, const Points& t1) override {
//       return my_test(t0, t1) ? Answer::collision() : Answer::free();
//     }
//   };
//   Mine mine;
//   assay_vectors::run("corpus/vectors", {"mine", "1.0", ""}, mine, "results.json");
//   assay_vectors::serve({"mine", "1.0", ""}, mine);
//
// A question that is not overridden is unsupported. What a detector throws is the answer `error`.
// In this process a crash ends everything, so a detector that may crash is better served. That the
// files of the set are whole is believed: `vectors.py check` looks.
// Numbers are read by strtod: a program that calls setlocale has to leave LC_NUMERIC at "C".
#ifndef ASSAY_VECTORS_H
#define ASSAY_VECTORS_H

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace assay_vectors {

using Point = std::array<double, 3>;
using Points = std::vector<Point>;  // of a query the four points, in the order of README.md
using Triangles = std::vector<std::array<int, 3>>;
using Pairs = std::vector<std::array<int, 2>>;

struct Product {
  std::string name, version, settings;
};

struct Answer {
  std::string word;  // as in the line protocol
  bool has_time = false, has_pairs = false;
  double lo = 0, hi = 0;  // the first time lies between them
  double share = 0;
  Pairs pairs{};  // of triangles, in any order

  static Answer free() { return {"free"}; }
  static Answer collision() { return {"collision"}; }
  static Answer collision(double time) { return collision(time, time); }
  static Answer collision(double lo, double hi) { return {"collision", true, false, lo, hi}; }
  static Answer undecided() { return {"undecided"}; }
  static Answer unsupported() { return {"unsupported"}; }
  static Answer error() { return {"error"}; }
  static Answer safe_share(double share) { return {"share", false, false, 0, 0, share}; }
  Answer with_pairs(Pairs all) && {
    has_pairs = true;
    pairs = std::move(all);
    return std::move(*this);
  }
};

class Detector {
 public:
  using Answer = assay_vectors::Answer;
  using Points = assay_vectors::Points;
  using Triangles = assay_vectors::Triangles;

  virtual ~Detector() = default;
  virtual Answer vertex_face(const Points&, const Points&) { return Answer::unsupported(); }
  virtual Answer edge_edge(const Points&, const Points&) { return Answer::unsupported(); }
  virtual Answer vertex_face_within(double, const Points&, const Points&) {
    return Answer::unsupported();
  }
  virtual Answer edge_edge_within(double, const Points&, const Points&) {
    return Answer::unsupported();
  }
  // A new mesh begins, with its points at the start of its first step. False: no mesh like this.
  virtual bool mesh(const Triangles&, const Points&) { return true; }
  virtual Answer step(const Triangles&, const Points&, const Points&) {
    return Answer::unsupported();
  }
  virtual Answer limit(const Triangles&, const Points&, const Points&) {
    return Answer::unsupported();
  }
};

namespace inside {

// A JSON value, as far as a set needs it.
struct Json {
  enum Kind { null, boolean, number, text, list, object } kind = null;
  double value = 0;
  std::string word{};
  std::vector<Json> items{};
  std::map<std::string, Json> fields{};

  const Json& at(const std::string& key) const {
    const auto found = fields.find(key);
    if (found == fields.end()) throw std::runtime_error("no field " + key);
    return found->second;
  }
  double as_number() const { return wanted(number, "a number").value; }
  const std::string& as_text() const { return wanted(text, "a text").word; }
  const std::vector<Json>& as_list() const { return wanted(list, "a list").items; }
  std::size_t as_index(std::size_t end) const {
    const double i = as_number();
    if (!(i >= 0 && i < static_cast<double>(end))) throw std::runtime_error("an index is wrong");
    return static_cast<std::size_t>(i);
  }
  const Json& wanted(Kind wanted_kind, const char* name) const {
    if (kind != wanted_kind) throw std::runtime_error(std::string("not ") + name);
    return *this;
  }
};

class JsonReader {
 public:
  explicit JsonReader(const std::string& text) : at_(text.c_str()), end_(at_ + text.size()) {}

  Json read() {
    Json json = value(0);
    skip();
    if (at_ != end_) fail();
    return json;
  }

 private:
  [[noreturn]] static void fail() { throw std::runtime_error("no JSON"); }
  void skip() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
  }
  bool take(char c) {
    skip();
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }
  void want(const char* word) {
    for (; *word; ++word, ++at_)
      if (at_ == end_ || *at_ != *word) fail();
  }
  Json value(int depth) {
    if (depth > 64) fail();
    skip();
    if (at_ == end_) fail();
    Json json;
    if (*at_ == '{') {
      ++at_;
      json.kind = Json::object;
      for (bool more = !take('}'); more; more = take(',') || !closed('}')) {
        skip();
        const std::string key = text();
        if (!take(':')) fail();
        json.fields[key] = value(depth + 1);
      }
    } else if (*at_ == '[') {
      ++at_;
      json.kind = Json::list;
      for (bool more = !take(']'); more; more = take(',') || !closed(']'))
        json.items.push_back(value(depth + 1));
    } else if (*at_ == '"') {
      json.kind = Json::text;
      json.word = text();
    } else if (*at_ == 't' || *at_ == 'f') {
      json.kind = Json::boolean;
      json.value = *at_ == 't' ? 1 : 0;
      want(*at_ == 't' ? "true" : "false");
    } else if (*at_ == 'n') {
      want("null");
    } else {
      json.kind = Json::number;
      if (*at_ != '-' && (*at_ < '0' || *at_ > '9')) fail();
      char* behind = nullptr;
      json.value = std::strtod(at_, &behind);
      if (behind == at_ || !std::isfinite(json.value)) fail();
      at_ = behind;
    }
    return json;
  }
  bool closed(char c) {
    if (!take(c)) fail();
    return true;
  }
  std::string text() {
    if (at_ == end_ || *at_ != '"') fail();
    std::string word;
    for (++at_; at_ != end_ && *at_ != '"'; ++at_) {
      // What stands behind a backslash is needed by nobody here: ids and words have none.
      if (*at_ == '\\' && ++at_ == end_) fail();
      word += *at_;
    }
    if (at_ == end_) fail();
    ++at_;
    return word;
  }

  const char *at_, *end_;
};

inline Json read_json(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot be opened");
  const std::string text(std::istreambuf_iterator<char>(in), {});
  return JsonReader(text).read();
}

inline Points points_of(const Json& json, std::size_t wanted) {
  Points points;
  if (json.as_list().size() != wanted) throw std::runtime_error("another number of points");
  for (const auto& point : json.as_list()) {
    if (point.as_list().size() != 3) throw std::runtime_error("a point has three coordinates");
    points.push_back(
        {point.items[0].as_number(), point.items[1].as_number(), point.items[2].as_number()});
  }
  return points;
}

inline std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    char code[8];
    std::snprintf(code, sizeof code, "\\u%04x", byte);
    out += byte < 0x20 ? code : c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return out + "\"";
}

inline std::string number_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

// What is no answer to the question becomes an error.
inline Answer checked(Answer answer, bool is_limit, std::size_t triangles) {
  const bool is_said = answer.word == "free" || answer.word == "collision";
  bool holds = is_said ? !is_limit : answer.word == "share" ? is_limit : !answer.has_pairs;
  if (answer.word == "share") holds = holds && answer.share >= 0 && answer.share <= 1;
  if (answer.has_time) {
    holds = holds && answer.word == "collision" && std::isfinite(answer.lo) &&
            std::isfinite(answer.hi) && answer.lo <= answer.hi;
  }
  if (answer.word == "free") holds = holds && answer.pairs.empty();
  for (auto& [a, b] : answer.pairs) {
    if (b < a) std::swap(a, b);
    holds = holds && a >= 0 && a < b && static_cast<std::size_t>(b) < triangles;
  }
  return holds ? answer : Answer::error();
}

template <class Ask>
Answer asked(Ask ask, bool is_limit, std::size_t triangles) {
  try {
    return checked(ask(), is_limit, triangles);
  } catch (const std::exception&) {
    return Answer::error();
  }
}

inline Answer ask_query(Detector& detector, const std::string& features, const double* distance,
                        const Points& t0, const Points& t1) {
  return asked(
      [&] {
        if (features == "vertex-face")
          return distance ? detector.vertex_face_within(*distance, t0, t1)
                          : detector.vertex_face(t0, t1);
        return distance ? detector.edge_edge_within(*distance, t0, t1) : detector.edge_edge(t0, t1);
      },
      false, 0);
}

inline bool begin_mesh(Detector& detector, const Triangles& triangles, const Points& points) {
  try {
    return detector.mesh(triangles, points);
  } catch (const std::exception&) {
    return false;
  }
}

inline Answer ask_step(Detector& detector, bool is_limit, const Triangles& triangles,
                       const Points& t0, const Points& t1) {
  return asked(
      [&] {
        return is_limit ? detector.limit(triangles, t0, t1) : detector.step(triangles, t0, t1);
      },
      is_limit, triangles.size());
}

inline std::string json_of(const Answer& answer) {
  std::string text = "{\"answer\": " + quoted(answer.word);
  if (answer.has_time)
    text += ", \"time\": [" + number_text(answer.lo) + ", " + number_text(answer.hi) + "]";
  if (answer.word == "share") text += ", \"share\": " + number_text(answer.share);
  if (answer.has_pairs) {
    text += ", \"pairs\": [";
    for (std::size_t i = 0; i < answer.pairs.size(); ++i) {
      text += std::string(i ? ", [" : "[") + std::to_string(answer.pairs[i][0]) + ", " +
              std::to_string(answer.pairs[i][1]) + "]";
    }
    text += "]";
  }
  return text + "}";
}

inline std::string line_of(const Answer& answer) {
  std::string line = answer.word;
  if (answer.has_time) line += " " + number_text(answer.lo) + " " + number_text(answer.hi);
  if (answer.word == "share") line += " " + number_text(answer.share);
  if (answer.has_pairs) line += " pairs";
  for (const auto& [a, b] : answer.pairs) line += " " + std::to_string(a) + " " + std::to_string(b);
  return line;
}

inline std::string answer_case(Detector& detector, const Json& group, const Json& one) {
  const std::string& features = group.at("features").as_text();
  const std::string& question = group.at("question").as_text();
  if (features != "mesh") {
    const Points t0 = points_of(one.at("t0"), 4), t1 = points_of(one.at("t1"), 4);
    const double distance = question == "distance" ? one.at("distance").as_number() : 0;
    return json_of(
        ask_query(detector, features, question == "distance" ? &distance : nullptr, t0, t1));
  }
  std::vector<Points> frames;
  for (const auto& frame : one.at("frames").as_list())
    frames.push_back(points_of(frame, one.at("frames").items[0].as_list().size()));
  Triangles triangles;
  for (const auto& triangle : one.at("triangles").as_list()) {
    triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      triangles.back()[k] =
          static_cast<int>(triangle.as_list().at(k).as_index(frames.at(0).size()));
    }
  }
  const auto& steps = one.at("steps").as_list();
  const auto frame_of = [&](const Json& step, const char* end) {
    return frames.at(step.at(end).as_index(frames.size()));
  };
  const bool is_taken = begin_mesh(detector, triangles, frame_of(steps.at(0), "from"));
  std::string text;
  for (const auto& step : steps) {
    const Answer answer = is_taken ? ask_step(detector, question == "limit", triangles,
                                              frame_of(step, "from"), frame_of(step, "to"))
                                   : Answer::unsupported();
    text += (text.empty() ? "" : ", ") + json_of(answer);
  }
  return "{\"steps\": [" + text + "]}";
}

}  // namespace inside

// Asks all cases of the set in `folder`, and writes results that `vectors.py score` reads. Throws
// std::runtime_error, with one line, for a set that cannot be read and a file that cannot be
// written.
inline void run(const std::string& folder, const Product& product, Detector& detector,
                const std::string& out) {
  using namespace inside;
  const auto started = std::chrono::steady_clock::now();
  std::string file = folder + "/set.json", answers;
  try {
    const Json set = read_json(file);
    if (set.at("schema").as_text() != "assay-vectors/1") throw std::runtime_error("another schema");
    for (const auto& entry : set.at("groups").as_list()) {
      file = folder + "/" + entry.at("file").as_text();
      const Json group = read_json(file);
      for (const auto& one : group.at("cases").as_list()) {
        answers += (answers.empty() ? "" : ",\n") + quoted(one.at("id").as_text()) + ": " +
                   answer_case(detector, group, one);
      }
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - started;
    std::string text = "{\"schema\": \"assay-results/1\", \"set\": {";
    for (const char* key : {"version", "profile", "digest"})
      text += quoted(key) + ": " + quoted(set.at(key).as_text()) + (*key == 'd' ? "" : ", ");
    text += "}, \"product\": {\"name\": " + quoted(product.name) +
            ", \"version\": " + quoted(product.version) +
            ", \"settings\": " + quoted(product.settings) +
            "}, \"seconds\": " + number_text(seconds.count()) + ", \"answers\": {\n" + answers +
            "\n}}\n";
    file = out;
    std::ofstream written(out, std::ios::binary);
    written << text << std::flush;
    if (!written) throw std::runtime_error("cannot be written");
  } catch (const std::exception& problem) {
    throw std::runtime_error(file + ": " + problem.what());
  }
}

// Answers the line protocol until the input ends. Returns what main should return: 0, or 2 after a
// line that is no question.
inline int serve(const Product& product, Detector& detector, std::istream& in = std::cin,
                 std::ostream& out = std::cout) {
  using namespace inside;
  Triangles triangles;
  std::size_t vertices = 0;
  bool is_taken = false, is_asked = false;
  for (std::string line; std::getline(in, line);) {
    const auto blank = line.find(' ');
    const std::string word = line.substr(0, blank);
    const char* at = line.c_str() + (blank == std::string::npos ? line.size() : blank);
    bool is_cut = false;
    const auto number = [&] {
      char* behind = nullptr;
      const double x = std::strtod(at, &behind);
      is_cut = is_cut || behind == at;
      at = behind;
      return x;
    };
    // A whole number below `end`. What the line counts cannot be more than it has characters.
    const auto count = [&](std::size_t end) {
      const double x = number();
      const bool is_count = x >= 0 && x < static_cast<double>(end) && x == std::floor(x);
      is_cut = is_cut || !is_count;
      return is_count ? static_cast<std::size_t>(x) : 0;
    };
    const auto points = [&](std::size_t n) {
      Points all(n);
      for (auto& point : all)
        for (auto& x : point) x = number();
      return all;
    };
    std::string answer;
    if (word == "assay-vectors") {
      answer = product.name + " " + product.version + " " + product.settings;
    } else if (word == "mesh") {
      vertices = count(std::size_t{1} << 31);
      triangles.assign(count(line.size()), {});
      for (auto& triangle : triangles)
        for (auto& i : triangle) i = static_cast<int>(count(vertices));
      is_asked = false;
      answer = "ok";
    } else if (word == "step" || word == "limit") {
      if (vertices > line.size()) return 2;
      const Points t0 = points(vertices), t1 = points(vertices);
      if (!is_asked && !is_cut) is_taken = begin_mesh(detector, triangles, t0);
      is_asked = true;
      answer = is_taken && !is_cut ? line_of(ask_step(detector, word == "limit", triangles, t0, t1))
                                   : "unsupported";
    } else {
      const bool is_within = word.size() > 7 && word.substr(word.size() - 7) == "-within";
      const std::string features = is_within ? word.substr(0, word.size() - 7) : word;
      if (features != "vertex-face" && features != "edge-edge") return 2;
      const double distance = is_within ? number() : 0;
      const Points t0 = points(4), t1 = points(4);
      answer = line_of(ask_query(detector, features, is_within ? &distance : nullptr, t0, t1));
    }
    if (is_cut) return 2;
    out << answer << "\n" << std::flush;
  }
  return 0;
}

}  // namespace assay_vectors

#endif  // ASSAY_VECTORS_H
