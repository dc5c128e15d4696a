#include "corpus/formats/step_log.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/outcome/try.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "detector/mesh/mesh_checks.h"

namespace assay::corpus {
namespace {

using detector::Positions;

using Json = nlohmann::json;

// A record: an array of four letters, the body as bytes of CBOR, and its checksum.
constexpr std::string_view mark_of_record("\x83\x44\x41\x53\x52\x31\xD8\x18\x5B", 9);
constexpr char before_checksum = '\x1A';
constexpr std::size_t head_bytes = 17, length_bytes = 8, tail_bytes = 5;
constexpr std::size_t piece_bytes = std::size_t{1} << 20;

template <class Number>
Number big_endian(const char* bytes) {
  Number out = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    out = static_cast<Number>(out << 8 | static_cast<std::uint8_t>(bytes[i]));
  return out;
}

// Returns the value of a key. Null if it is not there.
const Json& value_of(const Json& map, const char* key) {
  static const Json none;
  const auto found = map.find(key);
  return found == map.end() ? none : *found;
}

std::optional<std::int64_t> integer(const Json& value) {
  const bool is_too_large =
      value.is_number_unsigned() && !std::in_range<std::int64_t>(value.get<std::uint64_t>());
  if (!value.is_number_integer() || is_too_large) return std::nullopt;
  return value.get<std::int64_t>();
}

std::string text(const Json& value) { return value.is_string() ? value.get<std::string>() : ""; }

// Returns a typed array of RFC 8746. Its tag is `big` if its numbers begin with their highest byte,
// and big + 4 if with their lowest. Returns nothing if the value is no such array.
template <class Number>
std::optional<std::vector<Number>> typed_array(const Json& value, std::uint64_t big) {
  if (!value.is_binary()) return std::nullopt;
  const auto& bytes = value.get_binary();
  const bool is_big = bytes.subtype() == big;
  if ((!is_big && bytes.subtype() != big + 4) || bytes.size() % sizeof(Number) != 0)
    return std::nullopt;
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  if (is_big == (std::endian::native == std::endian::big)) return numbers;
  for (Number& number : numbers) {
    auto raw = std::bit_cast<std::array<std::uint8_t, sizeof(Number)>>(number);
    std::ranges::reverse(raw);
    number = std::bit_cast<Number>(raw);
  }
  return numbers;
}

std::optional<std::vector<double>> doubles(const Json& value) {
  constexpr std::uint64_t float32_big = 81, float64_big = 82;
  const auto floats = typed_array<float>(value, float32_big);
  if (floats) return std::vector<double>(floats->begin(), floats->end());
  return typed_array<double>(value, float64_big);
}

std::optional<std::vector<std::int32_t>> integers(const Json& value) {
  constexpr std::uint64_t int32_big = 74;
  return typed_array<std::int32_t>(value, int32_big);
}

std::optional<Positions> positions_of(const std::vector<double>& numbers, std::int64_t vertices) {
  if (numbers.size() != static_cast<std::size_t>(vertices) * 3) return std::nullopt;
  return Eigen::Map<const Positions>(numbers.data(), vertices, 3);
}

// Reads the members of a map into those of a struct. Members that are not there stay as they are.
class Members {
 public:
  explicit Members(const Json& map) : map_(map) {}
  template <class Number>
  Members& operator()(const char* key, Number& value) {
    if (!map_.contains(key)) return *this;
    const Json& read = map_[key];
    if constexpr (std::is_floating_point_v<Number>) {
      if (!read.is_number()) return is_wrong(key);
      value = read.get<Number>();
    } else {
      const auto whole = integer(read);
      if (!whole || !std::in_range<Number>(*whole)) return is_wrong(key);
      value = static_cast<Number>(*whole);
    }
    return *this;
  }
  // Reads a list. Each item is made of `row` consecutive numbers.
  template <std::size_t row, class Item, class Make>
  Members& list(const char* key, std::vector<Item>& items, const Make& make) {
    if (!map_.contains(key)) return *this;
    const auto read = integers(map_[key]);
    if (!read || read->size() % row != 0) return is_wrong(key);
    for (std::size_t i = 0; i < read->size(); i += row) items.push_back(make(read->data() + i));
    return *this;
  }
  // Returns the member that is wrong; empty if none is.
  const std::string& wrong() const { return wrong_; }

 private:
  Members& is_wrong(const char* key) {
    wrong_ = key;
    return *this;
  }

  const Json& map_;
  std::string wrong_;
};

std::string read_description(const Json& body, assay_description& d) {
  if (!body.contains("claims")) return "claims";
  Members members(body);
  members("claims", d.claims);
#define ASSAY_MEMBER(kind, name, since) members(#name, d.name);
  ASSAY_CONTRACT_MEMBERS(ASSAY_MEMBER)
#undef ASSAY_MEMBER
  return members.wrong();
}

std::string read_counted(const Json& map, detector::CountedPairs& counted) {
  std::int32_t level = ASSAY_COUNTS_TRIANGLES;
  Members members(map);
  members("level", level)("rings", counted.rings)("rest_distance", counted.rest_distance);
  members.list<1>("body", counted.body, [](const std::int32_t* x) { return *x; });
  members.list<2>("apart", counted.apart, [](const std::int32_t* x) {
    return std::array<std::int32_t, 2>{x[0], x[1]};
  });
  members.list<2>("triangle_pairs", counted.triangle_pairs, [](const std::int32_t* x) {
    return detector::TrianglePair{x[0], x[1]};
  });
  members.list<2>("vertex_faces", counted.vertex_faces, [](const std::int32_t* x) {
    return detector::VertexAndFace{x[0], x[1]};
  });
  members.list<4>("edge_pairs", counted.edge_pairs, [](const std::int32_t* x) {
    return detector::TwoEdges{{x[0], x[1]}, {x[2], x[3]}};
  });
  if (level != ASSAY_COUNTS_TRIANGLES && level != ASSAY_COUNTS_FEATURES) return "level";
  counted.level = level == ASSAY_COUNTS_FEATURES ? detector::CountedLevel::features
                                                 : detector::CountedLevel::triangles;
  if (map.contains("rest")) {
    const auto rest = doubles(map["rest"]);
    if (!rest || rest->size() % 3 != 0) return "rest";
    for (std::size_t i = 0; i < rest->size(); i += 3)
      counted.rest.push_back({(*rest)[i], (*rest)[i + 1], (*rest)[i + 2]});
  }
  return members.wrong();
}

// Returns the exact sums; nothing if one of them is no double.
std::optional<Positions> exact_sum(const Positions& x, const Positions& way) {
  const Positions end = x + way;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    // The rounding error of the sum (Knuth), which is exact unless something overflows.
    const double a = x.data()[i], b = way.data()[i], sum = end.data()[i], part = sum - a;
    if (!std::isfinite(sum) || (a - (sum - part)) + (b - part) != 0) return std::nullopt;
  }
  return end;
}

std::optional<Positions> places(const Json& value, Eigen::Index vertices) {
  const auto numbers = doubles(value);
  return numbers ? positions_of(*numbers, vertices) : std::nullopt;
}

// Returns where a step ended. The next step starts there if it states no start.
std::optional<Positions> end_of(const Json& body, Eigen::Index vertices) {
  return places(value_of(body, body.contains("committed") ? "committed" : "x1"), vertices);
}

// Returns the number of keys in all maps of the bytes. Nothing unless they are one item of definite
// lengths, nested so little that the recursion of from_cbor stays in its stack. Tags must stand
// before bytes, as in typed arrays, and negative numbers must fit into 64 bits.
std::optional<std::uint64_t> keys_of(std::string_view bytes) {
  enum Major : unsigned { negative = 1, byte_text = 2, text = 3, array = 4, map = 5, tag = 6 };
  constexpr std::size_t deepest = 64;
  constexpr auto most_negative =
      static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  std::vector<std::uint64_t> left = {1};  // items that are to come, by level
  std::uint64_t keys = 0;
  while (!left.empty()) {
    if (left.back() == 0) {
      left.pop_back();
      continue;
    }
    --left.back();
    if (bytes.empty()) return std::nullopt;
    const auto head = static_cast<std::uint8_t>(bytes[0]);
    const unsigned major = head >> 5, info = head & 31;
    const std::size_t more = info < 24 ? 0 : std::size_t{1} << (info - 24);
    if (info > 27 || 1 + more > bytes.size()) return std::nullopt;
    std::uint64_t argument = more == 0 ? info : 0;
    for (std::size_t i = 1; i <= more; ++i)
      argument = argument << 8 | static_cast<std::uint8_t>(bytes[i]);
    bytes.remove_prefix(1 + more);
    // Each part of an item takes at least one byte.
    if (major >= byte_text && major <= map && argument > bytes.size()) return std::nullopt;
    if (major == negative && argument > most_negative) return std::nullopt;
    if (major == byte_text || major == text) bytes.remove_prefix(argument);
    if (major == array || major == map) {
      if (left.size() > deepest) return std::nullopt;
      keys += major == map ? argument : 0;
      left.push_back(major == map ? 2 * argument : argument);
    }
    if (major == tag) {
      if (bytes.empty() || static_cast<std::uint8_t>(bytes[0]) >> 5 != byte_text)
        return std::nullopt;
      ++left.back();
    }
  }
  return bytes.empty() ? std::optional(keys) : std::nullopt;
}

std::uint64_t keys_of(const Json& value) {
  std::uint64_t keys = value.is_object() ? value.size() : 0;
  if (value.is_structured()) {
    for (const auto& member : value) keys += keys_of(member);
  }
  return keys;
}

// Returns the body as a map, each array with its tag. Null if the bytes are no such map, or if a
// map names a key twice.
Json parse(const std::string& body) {
  const auto keys = keys_of(std::string_view(body));
  if (!keys) return nullptr;
  try {
    auto map = Json::from_cbor(body, true, true, Json::cbor_tag_handler_t::store);
    return map.is_object() && keys_of(map) == *keys ? map : Json(nullptr);
  } catch (const Json::exception&) {
    return nullptr;
  }
}

}  // namespace

// A whole record, and where it ends.
struct StepLog::Record {
  Json body;
  std::uint64_t end = 0;
};

bool StepLog::read(std::uint64_t offset, std::size_t count, std::string& bytes) {
  if (offset > size_ || count > size_ - offset) return false;
  bytes.resize(count);
  return fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) == 0 &&
         std::fread(bytes.data(), 1, count, file_.get()) == count;
}

std::optional<StepLog::Record> StepLog::record_at(std::uint64_t offset) {
  std::string head;
  if (!read(offset, head_bytes, head) || !head.starts_with(mark_of_record)) return std::nullopt;
  const auto length = big_endian<std::uint64_t>(head.data() + head_bytes - length_bytes);
  const auto body = body_at(offset + head_bytes, length);
  if (!body) return std::nullopt;
  return Record{parse(*body), offset + head_bytes + length + tail_bytes};
}

// Returns the body of this length, if its checksum stands behind it.
std::optional<std::string> StepLog::body_at(std::uint64_t offset, std::uint64_t length) {
  const auto left = size_ - offset;
  if (left < tail_bytes || length > left - tail_bytes) return std::nullopt;
  std::string tail, piece;
  if (!read(offset + length, tail_bytes, tail) || tail[0] != before_checksum) return std::nullopt;
  // A wrong length may be huge, so the checksum is computed before the body is kept as a whole.
  uLong sum = 0;
  for (std::uint64_t done = 0; done < length; done += piece.size()) {
    const auto count = std::min<std::uint64_t>(length - done, piece_bytes);
    if (!read(offset + done, count, piece)) return std::nullopt;
    sum = ::crc32_z(sum, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
  }
  if (sum != big_endian<std::uint32_t>(tail.data() + 1)) return std::nullopt;
  if (length > piece_bytes && !read(offset, length, piece)) return std::nullopt;
  return piece;
}

// Returns whether all that is left is the beginning of one record. If a whole body with its
// checksum is there, or further records are, the length alone is wrong.
bool StepLog::begins_record(std::uint64_t offset) {
  const auto left = size_ - offset;
  std::string piece;
  if (!read(offset, std::min<std::uint64_t>(left, head_bytes), piece) ||
      !mark_of_record.starts_with(std::string_view(piece).substr(0, mark_of_record.size())))
    return false;
  if (left < head_bytes) return true;
  const auto body = left - head_bytes;
  const auto length = big_endian<std::uint64_t>(piece.data() + mark_of_record.size());
  if (length <= body && body - length >= tail_bytes) return false;
  if (body >= tail_bytes && body_at(offset + head_bytes, body - tail_bytes)) return false;
  for (auto from = offset + 1; from + mark_of_record.size() <= size_;) {
    if (!read(from, std::min<std::uint64_t>(piece_bytes, size_ - from), piece)) return false;
    if (piece.find(mark_of_record) != std::string::npos) return false;
    from += piece.size() - mark_of_record.size() + 1;  // a mark may lie across both pieces
  }
  return true;
}

Expected<StepLog> StepLog::open(const std::filesystem::path& path) {
  StepLog log(path);
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    return problem_in(path, "it is no regular file");
  log.file_.reset(std::fopen(path.c_str(), "rb"));
  if (!log.file_)
    return problem_in(path, std::error_code(errno, std::generic_category()).message());
  BOOST_OUTCOME_TRYV(log.begin());
  BOOST_OUTCOME_TRYV(log.go_on());
  return log;
}

Expected<void> StepLog::begin() {
  std::error_code error;
  size_ = std::filesystem::file_size(path_, error);
  if (error) return problem_in(path_, error.message());
  const auto record = record_at(0);
  if (!record) {
    std::string start;
    const bool is_log = read(0, mark_of_log.size(), start) && start == mark_of_log;
    if (start.starts_with("\x1f\x8b"))
      return problem_in(path_, "it is compressed, but only uncompressed logs are read: gunzip it");
    return problem_in(path_,
                      is_log ? "its first record is damaged, so its mesh and detector are unknown"
                             : "it is no log of steps");
  }
  const auto wrong = [&](std::string_view what) {
    return problem_in(path_, fmt::format("its first record: {}", what));
  };
  const Json& body = record->body;
  if (text(value_of(body, "type")) != "begin") return wrong("it does not begin a log");
  if (const auto version = integer(value_of(body, "log")); version != 1)
    return wrong(version ? fmt::format("log version {}, but this program reads version 1", *version)
                         : "its field `log` is missing or no number");
  head_.name = text(value_of(body, "name"));
  head_.version = text(value_of(body, "version"));
  if (const auto field = read_description(body, head_.description); !field.empty())
    return wrong(field + " is missing or wrong");
  const auto vertices = integer(value_of(body, "vertices"));
  const auto triangles = integers(value_of(body, "triangles"));
  const auto positions = doubles(value_of(body, "positions"));
  if (!vertices || !triangles || !positions || triangles->size() % 3 != 0 || *vertices < 0 ||
      *vertices > std::numeric_limits<std::int32_t>::max())
    return wrong("vertices, triangles or positions are missing");
  head_.triangles = Eigen::Map<const detector::Triangles>(
      triangles->data(), static_cast<Eigen::Index>(triangles->size() / 3), 3);
  const auto placed = positions_of(*positions, *vertices);
  if (!placed) return wrong(fmt::format("the positions do not fit {} vertices", *vertices));
  head_.positions = *placed;
  if (const auto bad = detector::check_positions(head_.positions, *vertices))
    return wrong(bad->message);
  if (const auto bad = detector::check_triangles(head_.triangles, *vertices))
    return wrong(bad->message);
  if (const Json& counted = value_of(body, "counted"); body.contains("counted")) {
    if (!counted.is_object()) return wrong("its field `counted` is no object");
    if (const auto field = read_counted(counted, head_.counted.emplace()); !field.empty())
      return wrong(fmt::format("counted.{} is invalid", field));
    if (const auto bad = detector::check_counted_pairs(*head_.counted, head_.triangles, *vertices))
      return wrong(bad->message);
  }
  scanned_ = record->end;
  next_record_ = 1;
  return boost::outcome_v2::success();
}

Expected<void> StepLog::go_on() {
  std::error_code error;
  size_ = std::filesystem::file_size(path_, error);
  if (error) return problem_in(path_, error.message());
  struct stat named {
  }, opened{};
  if (::stat(path_.c_str(), &named) != 0 || ::fstat(::fileno(file_.get()), &opened) != 0 ||
      named.st_ino != opened.st_ino)
    return problem_in(path_, "it was replaced while it was read");
  if (size_ < scanned_) return problem_in(path_, "it became shorter while it was read");
  why_damaged_.clear();
  while (scanned_ < size_ && why_damaged_.empty()) {
    const auto record = record_at(scanned_);
    why_damaged_ = record ? take(record->body) : "no record";
    if (why_damaged_.empty()) scanned_ = record->end;
  }
  is_cut_ = scanned_ < size_ && begins_record(scanned_);
  return boost::outcome_v2::success();
}

std::optional<LogDamage> StepLog::damage() const {
  if (scanned_ == size_) return std::nullopt;
  return LogDamage{scanned_, size_, is_cut_ ? "the beginning of a record" : why_damaged_, is_cut_};
}

// Returns why the log cannot go on with this record; empty if it can.
std::string StepLog::take(const Json& body) {
  const auto type = text(value_of(body, "type"));
  const auto number = integer(value_of(body, "record"));
  if (type.empty() || !number) return "a record of an unknown kind";
  if (type == "begin") return "another log begins; check it by itself";
  if (*number != next_record_)
    return fmt::format("record {} instead of record {}", *number, next_record_);
  const auto step = integer(value_of(body, "step"));
  const bool is_end = type == "end";
  if (!is_end && (!step || *step < 0)) return "a record without the number of its step";
  const auto place = static_cast<std::uint64_t>(step.value_or(0));
  if (type == "note") notes_.emplace(place, text(value_of(body, "text")));
  if (type == "step") {
    if (!steps_.empty() && place <= steps_.back().number) return "a step number out of order";
    steps_.push_back({scanned_, place});
  }  // records of later versions are passed over
  is_ended_ |= is_end;
  ++next_record_;
  return "";
}

std::optional<std::size_t> StepLog::place_of(std::uint64_t number) const {
  const auto found = std::ranges::lower_bound(steps_, number, {}, &Place::number);
  if (found == steps_.end() || found->number != number) return std::nullopt;
  return static_cast<std::size_t>(found - steps_.begin());
}

// Returns why it is not known which step this is; empty if it is known.
std::string StepLog::read_motion(const Json& body, std::size_t i, LogStep& step) {
  const auto vertices = head_.positions.rows();
  std::optional<Positions> start;
  if (body.contains("x0")) {
    start = places(body["x0"], vertices);
  } else if (i > 0 && steps_[i - 1].number + 1 == step.number) {
    if (ended_step_ != i - 1) {
      const auto before = record_at(steps_[i - 1].offset);
      end_ = before ? end_of(before->body, vertices) : std::nullopt;
    }
    start = end_;
    if (!start) return "it starts at the end of the step before it, and that end is unknown";
  } else {
    return "it starts at the end of the step before it, and that step is lost";
  }
  const auto end = places(value_of(body, "x1"), vertices),
             way = places(value_of(body, "dx"), vertices);
  if (!start || end.has_value() == way.has_value()) return "its positions do not fit the mesh";
  step.x_t0 = *start;
  if (end) {
    step.x_t1 = *end;
  } else if (const auto sum = exact_sum(*start, *way)) {
    step.x_t1 = *sum;
  } else {
    return "its start plus its displacement is no double";
  }
  for (const auto* x : {&step.x_t0, &step.x_t1}) {
    if (detector::check_positions(*x, head_.positions.rows())) return "a coordinate is not finite";
  }
  return "";
}

Expected<LogStep> StepLog::step(std::size_t i) {
  const auto record = record_at(steps_[i].offset);
  if (!record || record->body.is_null())
    return problem_in(path_, "it was changed while it was read");
  const Json& body = record->body;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto number = [&](const char* key, double otherwise) {
    const Json& value = value_of(body, key);
    return value.is_number() ? value.get<double>() : otherwise;
  };
  LogStep step;
  step.number = steps_[i].number;
  step.why_unknown = read_motion(body, i, step);
  end_ = end_of(body, head_.positions.rows());
  ended_step_ = i;
  if (body.contains("answer")) {
    LoggedAnswer& logged = step.answer.emplace();
    if (!Members(body)("answer", logged.answer).wrong().empty()) logged.answer = -1;
    logged.first_lo = number("first_lo", none);
    logged.first_hi = number("first_hi", none);
    const auto pairs = integers(value_of(body, "pairs"));
    const auto times = doubles(value_of(body, "pair_times"));
    if ((!pairs && body.contains("pairs")) || (!times && body.contains("pair_times")))
      logged.answer = -1;
    if (pairs) logged.pairs = *pairs;
    if (times) logged.pair_times = *times;
    logged.message = text(value_of(body, "message"));
  }
  if (body.contains("share") || body.contains("positions")) {
    LoggedLimit& limit = step.limit.emplace();
    limit.share = number("share", -1);
    limit.positions = places(value_of(body, "positions"), head_.positions.rows());
    // If the positions cannot be read, the limit gets positions that no limiter may give.
    if (body.contains("positions") && !limit.positions)
      limit.positions = Positions::Constant(head_.positions.rows(), 3, none);
  }
  return step;
}

}  // namespace assay::corpus
