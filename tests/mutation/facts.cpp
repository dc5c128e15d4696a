#include "tests/mutation/facts.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <type_traits>

namespace assay::mutation {
namespace {

// One walk over the fields serves both directions: a writer or a reader is `io`. The file is read
// on the machine that wrote it: bytes as they lie in memory.
class Writer {
 public:
  void bytes(const void* data, std::size_t size) {
    text_.append(static_cast<const char*>(data), size);
  }
  template <class Vector>
  void size_of(const Vector& v) {
    const std::uint64_t size = v.size();
    bytes(&size, sizeof size);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

class Reader {
 public:
  explicit Reader(std::string text) : text_(std::move(text)) {}
  void bytes(void* data, std::size_t size) {
    if (size > text_.size() - at_) throw std::runtime_error("facts: the file ends too early");
    std::memcpy(data, text_.data() + at_, size);
    at_ += size;
  }
  template <class Vector>
  void size_of(Vector& v) {
    std::uint64_t size = 0;
    bytes(&size, sizeof size);
    if (size > text_.size() - at_) throw std::runtime_error("facts: a length is wrong");
    v.resize(size);
  }

 private:
  std::string text_;
  std::size_t at_ = 0;
};

template <class Io, class T>
void walk(Io& io, T& value) requires std::is_trivially_copyable_v<std::remove_const_t<T>> {
  io.bytes(&value, sizeof value);
}

template <class Io, class Matrix>
void walk_rows(Io& io, Matrix& rows) {
  Eigen::Index count = rows.rows();
  walk(io, count);
  if constexpr (!std::is_const_v<Matrix>) rows.resize(count, 3);
  io.bytes(rows.data(), static_cast<std::size_t>(rows.size()) * sizeof *rows.data());
}

template <class Io, class Vector>
void walk_plain(Io& io, Vector& v) {
  io.size_of(v);
  for (auto& element : v) walk(io, element);
}

template <class Io, class View>
void walk_view(Io& io, View& view) {
  walk(io, view.known);
  walk_plain(io, view.primitives);
  walk_plain(io, view.apexes);
  walk_plain(io, view.signs);
  walk_plain(io, view.doubts);
}

template <class Io, class Step>
void walk_step(Io& io, Step& step) {
  walk(io, step.from);
  walk(io, step.to);
  walk(io, step.commit);
  walk(io, step.view);
  walk_plain(io, step.pairs);
  walk(io, step.first);
  io.size_of(step.views);
  for (auto& view : step.views) walk_view(io, view);
}

template <class Io, class AnyFacts>
void walk_facts(Io& io, AnyFacts& facts) {
  walk_plain(io, facts.queries);
  io.size_of(facts.cases);
  for (auto& c : facts.cases) {
    walk_plain(io, c.id);
    walk_rows(io, c.triangles);
    io.size_of(c.frames);
    for (auto& frame : c.frames) walk_rows(io, frame);
    walk(io, c.starts_clean);
    io.size_of(c.steps);
    for (auto& step : c.steps) walk_step(io, step);
  }
}

}  // namespace

void write_facts(const std::string& path, const Facts& facts) {
  Writer writer;
  walk_facts(writer, facts);
  std::ofstream out(path, std::ios::binary);
  out << writer.text();
  if (!out.flush()) throw std::runtime_error("facts: cannot write " + path);
}

Facts read_facts(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("facts: cannot read " + path);
  Reader reader({std::istreambuf_iterator<char>(in), {}});
  Facts facts;
  walk_facts(reader, facts);
  return facts;
}

}  // namespace assay::mutation
