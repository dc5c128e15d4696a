#include <fmt/format.h>

#include <boost/outcome/try.hpp>

#include "corpus/formats/mesh_reader.h"
#include "corpus/formats/text_lines.h"

namespace assay::corpus {
namespace {

using Words = std::vector<std::string_view>;

// Returns whether this is a header word: OFF behind some of the letters ST, C, N, 4, n, capital or
// not.
bool is_header(std::string_view word) {
  constexpr std::string_view letters = "STCN4nOFstcof";
  if (word.size() < 3 || word.find_first_not_of(letters) != std::string_view::npos) return false;
  const auto end = word.substr(word.size() - 3);
  return end == "OFF" || end == "off";
}

class OffReader {
 public:
  OffReader(std::string_view text, const std::filesystem::path& file)
      : lines_(text, '#', false), builder_(file), size_(text.size()) {}

  Expected<Mesh> read() {
    BOOST_OUTCOME_TRY(read_header());
    for (std::int64_t i = 0; i < vertices_; ++i) {
      BOOST_OUTCOME_TRY(read_vertex());
    }
    for (std::int64_t i = 0; i < faces_; ++i) {
      BOOST_OUTCOME_TRY(read_face());
    }
    if (lines_.next()) return wrong("text after the last face");
    return builder_.finish();
  }

 private:
  Problem wrong(std::string_view detail) const {
    return builder_.problem({"line", lines_.number()}, detail);
  }

  // Splits the next line into words. If there is none, the message names `expected`.
  Expected<void> next_line(std::string_view expected) {
    const auto line = lines_.next();
    if (!line) {
      return wrong(fmt::format("the file ends where {} should follow", expected));
    }
    split_words(*line, words_);
    return boost::outcome_v2::success();
  }

  Expected<std::int64_t> integer(std::size_t i, std::string_view name) const {
    const auto value = i < words_.size() ? parse_integer(words_[i]) : std::nullopt;
    if (value) return *value;
    return wrong(
        fmt::format("{} expected{}", name, i < words_.size() ? ", not " + excerpt(words_[i]) : ""));
  }

  Expected<void> read_header() {
    BOOST_OUTCOME_TRY(next_line("the header word OFF"));
    const bool has_header = is_header(words_[0]);
    if (!has_header && !parse_integer(words_[0]))
      return wrong("the header word OFF expected, not " + excerpt(words_[0]));
    if (has_header && words_[0].find_first_of("4n") != std::string_view::npos) {
      return wrong("vertices of more than three dimensions are not read");
    }
    // Some writers put the counts behind the header word, or leave the header word out.
    if (!has_header) {
    } else if (words_.size() == 1) {
      BOOST_OUTCOME_TRY(next_line("the counts"));
    } else if (words_[1] == "BINARY") {
      return wrong("binary OFF files are not read: write the file as text");
    } else {
      words_.erase(words_.begin());
    }
    BOOST_OUTCOME_TRY(vertices, integer(0, "the number of vertices"));
    BOOST_OUTCOME_TRY(faces, integer(1, "the number of faces"));
    // Each vertex and face takes a line, so a count beyond the file's size is wrong. Nothing is
    // reserved for it.
    const auto most = static_cast<std::int64_t>(size_);
    if (vertices < 0 || faces < 0) return wrong("a negative count");
    if (vertices > most || faces > most) {
      return wrong(
          fmt::format("{} vertices and {} faces do not fit into {} bytes", vertices, faces, size_));
    }
    vertices_ = vertices;
    faces_ = faces;
    return boost::outcome_v2::success();
  }

  Expected<void> read_vertex() {
    BOOST_OUTCOME_TRY(next_line(fmt::format("vertex {}", builder_.vertex_count())));
    std::array<double, 3> x{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = k < words_.size() ? parse_double(words_[k]) : std::nullopt;
      if (!value) {
        return wrong(k < words_.size() ? excerpt(words_[k]) + " is no number"
                                       : "a vertex has fewer than 3 coordinates");
      }
      x[k] = *value;
    }
    return builder_.add_vertex(x[0], x[1], x[2], {"line", lines_.number()});
  }

  Expected<void> read_face() {
    BOOST_OUTCOME_TRY(next_line("a face"));
    BOOST_OUTCOME_TRY(count, integer(0, "the number of corners"));
    // The line may go on with a colour.
    if (count < 0 || static_cast<std::size_t>(count) > words_.size() - 1) {
      return wrong(fmt::format("a face of {} corners lists {} vertices", count, words_.size() - 1));
    }
    corners_.clear();
    for (std::size_t i = 1; i <= static_cast<std::size_t>(count); ++i) {
      BOOST_OUTCOME_TRY(vertex, integer(i, "a vertex index"));
      corners_.push_back(vertex);
    }
    if (count == 1 || count == 2) {
      builder_.skip("face of fewer than 3 corners");
      return boost::outcome_v2::success();
    }
    return builder_.add_polygon(corners_, {"line", lines_.number()});
  }

  Lines lines_;
  MeshBuilder builder_;
  std::size_t size_;
  std::int64_t vertices_ = 0, faces_ = 0;
  Words words_;
  std::vector<std::int64_t> corners_;
};

}  // namespace

bool looks_like_off(std::string_view text) {
  Lines lines(text.substr(0, 4096), '#', false);
  const auto line = lines.next();
  Words words;
  if (line) split_words(*line, words);
  return !words.empty() && is_header(words[0]);
}

Expected<Mesh> read_off(std::string_view text, const std::filesystem::path& file) {
  return OffReader(text, file).read();
}

}  // namespace assay::corpus
