#include "corpus/formats/step_log.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <boost/outcome/try.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "corpus/formats/cbor_map.h"
#include "detector/mesh/mesh_checks.h"

namespace assay::corpus {
namespace {

using detector::Positions;

// A record: an array of four letters, the body as bytes of CBOR, and its checksum.
constexpr std::string_view before_length("\xD8\x18\x5B", 3);
constexpr char before_checksum = '\x1A';
constexpr std::size_t head_bytes = 17, length_bytes = 8, tail_bytes = 5;
constexpr std::size_t piece_bytes = std::size_t{1} << 20;
constexpr const char* no_record = "no record";

template <class Number>
Number big_endian(const char* bytes) {
  Number out = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    out = static_cast<Number>(out << 8 | static_cast<std::uint8_t>(bytes[i]));
  return out;
}

std::optional<Positions> positions_of(const std::vector<double>& numbers, std::int64_t vertices) {
  if (numbers.size() != static_cast<std::size_t>(vertices) * 3) return std::nullopt;
  return Eigen::Map<const Positions>(numbers.data(), vertices, 3);
}

// Reads the members of a map into those of a struct. Members that are not there stay as they are.
class Members {
 public:
  explicit Members(const CborMap& map) : map_(map) {}
  Members& operator()(const char* key, std::int32_t& value) {
    if (!map_.has(key)) return *this;
    const auto read = map_.integer(key);
    if (read && *read == static_cast<std::int32_t>(*read)) {
      value = static_cast<std::int32_t>(*read);
    } else {
      wrong_ = key;
    }
    return *this;
  }
  Members& operator()(const char* key, std::uint64_t& value) {
    if (!map_.has(key)) return *this;
    const auto read = map_.integer(key);
    if (read && *read >= 0) {
      value = static_cast<std::uint64_t>(*read);
    } else {
      wrong_ = key;
    }
    return *this;
  }
  Members& operator()(const char* key, double& value) {
    if (!map_.has(key)) return *this;
    if (const auto read = map_.number(key)) {
      value = *read;
    } else {
      wrong_ = key;
    }
    return *this;
  }
  // Each item is made of so many numbers in a row.
  template <std::size_t row, class Item, class Make>
  Members& list(const char* key, std::vector<Item>& items, const Make& make) {
    if (!map_.has(key)) return *this;
    const auto read = map_.integers(key);
    if (!read || read->size() % row != 0) {
      wrong_ = key;
      return *this;
    }
    for (std::size_t i = 0; i < read->size(); i += row) items.push_back(make(read->data() + i));
    return *this;
  }
  // The member that is wrong; empty if none is.
  const std::string& wrong() const { return wrong_; }

 private:
  const CborMap& map_;
  std::string wrong_;
};

std::string read_description(const CborMap& body, assay_description& d) {
  const auto claims = body.integer("claims");
  if (!claims || *claims != static_cast<std::uint32_t>(*claims)) return "claims";
  d.claims = static_cast<std::uint32_t>(*claims);
  return Members(body)("adjacency", d.adjacency)("coordinates", d.coordinates)("margin", d.margin)(
             "start", d.start)("start_distance", d.start_distance)(
             "least_nonzero", d.least_nonzero)("largest", d.largest)("features", d.features)(
             "time_tolerance", d.time_tolerance)("reports", d.reports)("separation", d.separation)(
             "counts", d.counts)("rings", d.rings)("rest_distance", d.rest_distance)(
             "limit_gives", d.limit_gives)("progress", d.progress)("motion", d.motion)(
             "capacity_triangles", d.capacity_triangles)("capacity_contacts", d.capacity_contacts)(
             "capacity_candidates", d.capacity_candidates)
      .wrong();
}

std::string read_counted(const CborMap& map, detector::CountedPairs& counted) {
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
  if (map.has("rest")) {
    const auto rest = map.doubles("rest");
    if (!rest || rest->size() % 3 != 0) return "rest";
    for (std::size_t i = 0; i < rest->size(); i += 3)
      counted.rest.push_back({(*rest)[i], (*rest)[i + 1], (*rest)[i + 2]});
  }
  return members.wrong();
}

// The exact sums; nothing if one of them is no double.
std::optional<Positions> exact_sum(const Positions& x, const Positions& way) {
  const Positions end = x + way;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    // What rounding took from the sum (Knuth), which is exact unless something overflows.
    const double a = x.data()[i], b = way.data()[i], sum = end.data()[i], part = sum - a;
    if (!std::isfinite(sum) || (a - (sum - part)) + (b - part) != 0) return std::nullopt;
  }
  return end;
}

}  // namespace

bool StepLog::read(std::uint64_t offset, std::size_t count, std::string& bytes) {
  if (offset > size_ || count > size_ - offset) return false;
  bytes.resize(count);
  return fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) == 0 &&
         std::fread(bytes.data(), 1, count, file_.get()) == count;
}

std::optional<StepLog::Record> StepLog::record_at(std::uint64_t offset) {
  std::string head;
  if (!read(offset, head_bytes, head) || !head.starts_with(mark_of_log) ||
      head.compare(mark_of_log.size(), before_length.size(), before_length) != 0)
    return std::nullopt;
  const auto length = big_endian<std::uint64_t>(head.data() + head_bytes - length_bytes);
  auto body = body_at(offset + head_bytes, length);
  if (!body) return std::nullopt;
  return Record{std::move(*body), offset + head_bytes + length + tail_bytes};
}

// The body of this length, if its checksum stands behind it.
std::optional<std::string> StepLog::body_at(std::uint64_t offset, std::uint64_t length) {
  const auto left = size_ - offset;
  if (left < tail_bytes || length > left - tail_bytes) return std::nullopt;
  // Most places in damaged bytes end here, and little was read.
  std::string tail;
  if (!read(offset + length, tail_bytes, tail) || tail[0] != before_checksum) return std::nullopt;
  // A length that is wrong may be any, so the body is summed before it is kept as a whole.
  uLong sum = 0;
  std::string piece;
  for (std::uint64_t done = 0; done < length; done += piece.size()) {
    const auto count = std::min<std::uint64_t>(length - done, piece_bytes);
    if (!read(offset + done, count, piece)) return std::nullopt;
    sum = ::crc32_z(sum, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
  }
  summed_ += length;
  if (sum != big_endian<std::uint32_t>(tail.data() + 1)) return std::nullopt;
  if (length > piece_bytes && !read(offset, length, piece)) return std::nullopt;
  return piece;
}

// Whether all that is left is the beginning of one record. If a whole body and its checksum are
// there, the length alone is wrong.
bool StepLog::begins_record(std::uint64_t offset) {
  const auto left = size_ - offset;
  std::string head;
  if (!read(offset, std::min<std::uint64_t>(left, head_bytes), head)) return false;
  const auto form = std::string(mark_of_log).append(before_length);
  if (!form.starts_with(std::string_view(head).substr(0, form.size()))) return false;
  if (left < head_bytes) return true;
  const auto body = left - head_bytes;
  const auto length = big_endian<std::uint64_t>(head.data() + form.size());
  if (length <= body && body - length >= tail_bytes) return false;
  return body < tail_bytes || !body_at(offset + head_bytes, body - tail_bytes);
}

// Where the next whole record begins, behind this place.
std::optional<std::uint64_t> StepLog::next_record(std::uint64_t offset) {
  std::string piece;
  for (std::uint64_t from = offset + 1; from + head_bytes <= size_;) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(piece_bytes, size_ - from));
    if (!read(from, count, piece)) return std::nullopt;
    for (auto at = piece.find(mark_of_log); at != std::string::npos;
         at = piece.find(mark_of_log, at + 1)) {
      if (record_at(from + at)) return from + at;
      if (summed_ > most_summed()) return std::nullopt;
    }
    if (count < piece_bytes) break;
    from += count - mark_of_log.size();  // a mark may lie across both pieces
  }
  return std::nullopt;
}

std::optional<Positions> StepLog::places(const CborMap& body, const char* key) const {
  const auto numbers = body.doubles(key);
  return numbers ? positions_of(*numbers, head_.positions.rows()) : std::nullopt;
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
    return problem_in(path_, is_log ? "its first record is damaged, so it is not known of which "
                                      "mesh and detector it is"
                                    : "it is no log of steps");
  }
  const auto wrong = [&](std::string_view what) {
    return problem_in(path_, fmt::format("its first record: {}", what));
  };
  const auto body = CborMap::parse(record->body);
  if (!body || body->text("type") != "begin") return wrong("it is none that begins a log");
  if (const auto version = body->integer("log"); version != 1)
    return wrong(version ? fmt::format("log version {}, this program reads 1", *version)
                         : "log is missing or no number");
  head_.name = body->text("name").value_or("");
  head_.version = body->text("version").value_or("");
  if (const auto field = read_description(*body, head_.description); !field.empty())
    return wrong(field + " is none");
  const auto vertices = body->integer("vertices");
  const auto triangles = body->integers("triangles");
  const auto positions = body->doubles("positions");
  if (!vertices || !triangles || !positions || triangles->size() % 3 != 0 || *vertices < 0 ||
      *vertices > std::numeric_limits<std::int32_t>::max())
    return wrong("vertices, triangles or positions are missing");
  head_.triangles = Eigen::Map<const detector::Triangles>(
      triangles->data(), static_cast<Eigen::Index>(triangles->size() / 3), 3);
  const auto placed = positions_of(*positions, *vertices);
  if (!placed) return wrong(fmt::format("positions are not those of {} vertices", *vertices));
  head_.positions = *placed;
  if (const auto bad = detector::check_positions(head_.positions, *vertices))
    return wrong(bad->message);
  if (const auto bad = detector::check_triangles(head_.triangles, *vertices))
    return wrong(bad->message);
  if (body->has("counted") && !body->map("counted")) return wrong("counted is none");
  if (const auto* map = body->map("counted")) {
    if (const auto field = read_counted(*map, head_.counted.emplace()); !field.empty())
      return wrong(fmt::format("counted.{} is none", field));
    if (const auto bad = detector::check_counted_pairs(*head_.counted, head_.triangles, *vertices))
      return wrong(bad->message);
  }
  scanned_ = record->end;
  next_record_ = 1;
  return boost::outcome_v2::success();
}

// What is whole is summed once. Where many heads are damaged, each with a length that fits, the
// search for the next record would take time by the square of their number.
std::uint64_t StepLog::most_summed() const {
  constexpr std::uint64_t times = 20, least = std::uint64_t{1} << 30;
  return times * size_ + least;
}

Expected<void> StepLog::go_on() {
  std::error_code error;
  size_ = std::filesystem::file_size(path_, error);
  if (error) return problem_in(path_, error.message());
  struct stat named {
  }, opened{};
  if (::stat(path_.c_str(), &named) != 0 || ::fstat(::fileno(file_.get()), &opened) != 0 ||
      named.st_ino != opened.st_ino)
    return problem_in(path_, "another file is in its place now, as where a ring turns");
  if (size_ < scanned_) return problem_in(path_, "it was cut while it was read");
  while (scanned_ < size_) {
    if (const auto record = record_at(scanned_)) {
      const auto offset = scanned_;
      scanned_ = record->end;
      take(*record, offset);
      continue;
    }
    const auto next = next_record(scanned_);
    if (!next && summed_ > most_summed()) {
      damages_.push_back({scanned_, size_, "so many lengths are wrong that it is not searched"});
      scanned_ = size_;
    }
    if (!next) break;
    damages_.push_back({scanned_, *next, no_record});
    scanned_ = *next;
  }
  rest_is_cut_record_ = begins_record(scanned_);
  return boost::outcome_v2::success();
}

std::vector<LogDamage> StepLog::damages() const {
  auto damages = damages_;
  if (scanned_ < size_ && !rest_is_cut_record_) damages.push_back({scanned_, size_, no_record});
  return damages;
}

std::optional<LogDamage> StepLog::cut_record() const {
  if (scanned_ == size_ || !rest_is_cut_record_) return std::nullopt;
  return LogDamage{scanned_, size_, "the beginning of a record"};
}

// What a whole record holds may still be anything.
void StepLog::take(const Record& record, std::uint64_t offset) {
  const auto damaged = [&](std::string what) {
    damages_.push_back({offset, record.end, std::move(what)});
  };
  const auto body = CborMap::parse(record.body);
  const auto type = body ? body->text("type") : std::nullopt;
  const auto number = body ? body->integer("record") : std::nullopt;
  if (!type || !number || *number < 0) return damaged("a record that nothing is known of");
  const auto counted = static_cast<std::uint64_t>(*number);
  if (*type == "begin") return damaged("another log begins; read it by itself");
  if (counted < next_record_) return damaged("a record that was there before");
  if (counted > next_record_ && (damages_.empty() || damages_.back().to != offset)) {
    damages_.push_back(
        {offset, offset, fmt::format("{} records are missing", counted - next_record_)});
  }
  next_record_ = counted + 1;
  if (*type == "end") {
    is_ended_ = true;
    return;
  }
  const auto step = body->integer("step");
  if (!step || *step < 0) return damaged("a record without the number of its step");
  if (*type == "note") {
    notes_.emplace(*step, body->text("text").value_or(""));
  } else if (*type == "step") {
    const auto place = static_cast<std::uint64_t>(*step);
    if (!steps_.empty() && place <= steps_.back().number)
      return damaged("a step that was there before");
    steps_.push_back({offset, place});
  }  // records of later versions are passed over
}

std::optional<std::size_t> StepLog::place_of(std::uint64_t number) const {
  const auto found = std::ranges::lower_bound(steps_, number, {}, &Place::number);
  if (found == steps_.end() || found->number != number) return std::nullopt;
  return static_cast<std::size_t>(found - steps_.begin());
}

std::optional<Positions> StepLog::end_of(const CborMap& body) const {
  return body.has("committed") ? places(body, "committed") : places(body, "x1");
}

// Returns why it is not known which step this is; empty if it is known.
std::string StepLog::read_motion(const CborMap& body, std::size_t i, LogStep& step) {
  std::optional<Positions> start;
  if (body.has("x0")) {
    start = places(body, "x0");
  } else if (i > 0 && steps_[i - 1].number + 1 == step.number) {
    if (ended_step_ != i - 1) {
      end_.reset();
      const auto before = record_at(steps_[i - 1].offset);
      const auto map = before ? CborMap::parse(before->body) : std::nullopt;
      if (map) end_ = end_of(*map);
    }
    start = end_;
    if (!start) return "it starts where the step before it ended, and that is not known";
  } else {
    return "it starts where the step before it ended, and that one is lost";
  }
  const auto end = places(body, "x1"), way = places(body, "dx");
  if (!start || end.has_value() == way.has_value())
    return "its positions are not those of the mesh";
  step.x_t0 = *start;
  if (end) {
    step.x_t1 = *end;
  } else if (const auto sum = exact_sum(*start, *way)) {
    step.x_t1 = *sum;
  } else {
    return "the exact end of its displacement is no double";
  }
  for (const auto* x : {&step.x_t0, &step.x_t1}) {
    if (detector::check_positions(*x, head_.positions.rows())) return "a coordinate is not finite";
  }
  return "";
}

Expected<LogStep> StepLog::step(std::size_t i) {
  const auto record = record_at(steps_[i].offset);
  const auto body = record ? CborMap::parse(record->body) : std::nullopt;
  if (!body) return problem_in(path_, "it was changed while it was read");
  LogStep step;
  step.number = steps_[i].number;
  step.why_unknown = read_motion(*body, i, step);
  end_ = end_of(*body);
  ended_step_ = i;
  if (body->has("answer")) {
    LoggedAnswer& logged = step.answer.emplace();
    const auto answer = body->integer("answer").value_or(-1);
    // What is no int32 is no answer either.
    logged.answer =
        answer == static_cast<std::int32_t>(answer) ? static_cast<std::int32_t>(answer) : -1;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    logged.first_lo = body->number("first_lo").value_or(none);
    logged.first_hi = body->number("first_hi").value_or(none);
    const auto pairs = body->integers("pairs");
    const auto times = body->doubles("pair_times");
    if ((!pairs && body->has("pairs")) || (!times && body->has("pair_times"))) logged.answer = -1;
    if (pairs) logged.pairs = *pairs;
    if (times) logged.pair_times = *times;
    logged.message = body->text("message").value_or("");
  }
  if (body->has("share") || body->has("positions")) {
    LoggedLimit& limit = step.limit.emplace();
    limit.share = body->number("share").value_or(-1);
    limit.positions = places(*body, "positions");
    // What are no positions are none that a limiter may give.
    if (body->has("positions") && !limit.positions) {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      limit.positions = Positions::Constant(head_.positions.rows(), 3, none);
    }
  }
  return step;
}

}  // namespace assay::corpus
