// The messages between the host and its worker: plain bytes, with lengths in front. Host and worker
// are built from the same sources, which wire_version checks, and run on the same machine. So plain
// data is sent as it lies in memory.
//
// The fields of a message are listed once for writing and reading (fields.h): in this header, or
// beside their types. The channel that carries messages is at the end of this header.
#pragma once

#include <sys/types.h>

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "detector/mesh/enum_names.h"
#include "detector/mesh/problem.h"
#include "properties/claims/claims.h"
#include "properties/fields.h"
#include "properties/worker/case_run.h"
#include "properties/worker/child_process.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

template <class T, class... Other>
inline constexpr bool is_one_of = (std::is_same_v<T, Other> || ...);

// Whether values of type T are sent as their bytes. Such types are listed by name, so that no type
// with a pointer is sent in this way by mistake.
template <class T>
inline constexpr bool travels_as_bytes =
    std::is_arithmetic_v<T> || std::is_enum_v<T> ||
    is_one_of<T, Point, MovingPoint, TimeEnclosure, TrianglePair, PairContact, ViewPrimitive,
              detector::StepCounts, detector::StepTimes, CaseStep, std::array<std::int32_t, 2>,
              detector::VertexAndFace, detector::TwoEdges>;

// Writes or reads the fields of a message. The names of fields are not sent, because writer and
// reader use the same list of fields. If a message is too short, or states more items than it has,
// complete() returns false and the remaining fields do not change. Such a message comes from a
// worker whose memory was damaged by the code that it ran.
template <bool reads>
class Wire : public NamedFields<Wire<reads>> {
 public:
  Wire() = default;
  explicit Wire(const std::string& bytes) : next_(bytes.data()), rest_(bytes.size()) {}

  template <class T>
  void field(std::string_view, T& item) {
    pass(item);
  }
  std::string take() { return std::move(bytes_); }
  // Returns whether the whole message was read, and nothing is left.
  bool complete() const { return ok_ && rest_ == 0; }

 private:
  template <class T>
  void pass(T& item) {
    if constexpr (std::is_same_v<T, bool>) {
      pass_as<std::uint8_t>(item, [](auto number) {
        return number <= 1 ? std::optional(number == 1) : std::nullopt;
      });
    } else if constexpr (std::is_enum_v<T>) {
      pass_as<std::underlying_type_t<T>>(item, from_number<T>);
    } else if constexpr (travels_as_bytes<T>) {
      pass_bytes(&item, sizeof item);
    } else {
      fields(*this, item);
    }
  }
  // Passes the number of a bool or an enum. If a number read is no value of the type, the message
  // is not complete().
  template <class Number, class T, class ValueOf>
  void pass_as(T& item, ValueOf value_of) {
    Number number = reads ? Number{0} : static_cast<Number>(item);
    pass_bytes(&number, sizeof number);
    if constexpr (reads) {
      const std::optional<T> value = value_of(number);
      ok_ = ok_ && value;
      if (ok_) item = *value;
    }
  }
  void pass(std::string& text) {
    if (const auto count = pass_count(text.size(), 1); reads) text.resize(count);
    pass_bytes(text.data(), text.size());
  }
  template <class T>
  void pass(std::vector<T>& items) {
    const auto count = pass_count(items.size(), travels_as_bytes<T> ? sizeof(T) : 1);
    if constexpr (travels_as_bytes<T>) {
      if constexpr (reads) items.resize(count);
      pass_bytes(items.data(), count * sizeof(T));
    } else {
      // Items are made one by one, and each needs bytes of the message, so that a large count
      // without items needs no memory.
      if constexpr (reads) items.clear();
      for (std::size_t i = 0; i < count && ok_; ++i) {
        if constexpr (reads) items.emplace_back();
        pass(items[i]);
      }
    }
  }
  // Writes the items as a vector, without a copy. A writer does not change them.
  template <class T>
  requires(!reads) void pass(std::span<const T>& items) {
    pass_count(items.size(), 1);
    for (const auto& item : items) pass(const_cast<T&>(item));
  }
  template <class T>
  void pass(std::optional<T>& item) {
    bool is_there = item.has_value();
    pass(is_there);
    if constexpr (reads) {
      item.reset();
      if (is_there && ok_) item.emplace();
    }
    if (item) pass(*item);
  }
  // Passes a matrix of rows x 3.
  template <class T>
  void pass(Eigen::Matrix<T, Eigen::Dynamic, 3, Eigen::RowMajor>& rows) {
    const auto count = pass_count(static_cast<std::size_t>(rows.size()), sizeof(T)) / 3 * 3;
    if constexpr (reads) rows.resize(static_cast<Eigen::Index>(count / 3), 3);
    pass_bytes(rows.data(), count * sizeof(T));
  }
  // Passes the number of items of at least `size` bytes each; 0 if the message is too short for the
  // number that it states.
  std::size_t pass_count(std::size_t of_items, std::size_t size) {
    auto count = static_cast<std::uint64_t>(of_items);
    pass_bytes(&count, sizeof count);
    if constexpr (reads) ok_ = ok_ && count <= rest_ / size;
    return ok_ ? static_cast<std::size_t>(count) : 0;
  }
  void pass_bytes(void* data, std::size_t size) {
    ok_ = ok_ && (!reads || size <= rest_);
    if (!ok_ || size == 0) return;
    if constexpr (reads) {
      std::memcpy(data, next_, size);
      next_ += size;
      rest_ -= size;
    } else {
      bytes_.append(static_cast<const char*>(data), size);
    }
  }

  std::string bytes_;
  const char* next_ = nullptr;
  std::size_t rest_ = 0;
  bool ok_ = true;
};

// The messages, field by field. A new field of a result or an option does not compile until it is
// named here.

// Lists the fields of the options. Options::counted is not sent, because the relation of the case
// is used, and is sent with the case.
template <class Archive>
void fields(Archive& archive, Options& options) {
  auto& [culling, start, pairs, arithmetic, threads, relation, separation, keeps_near] = options;
  archive("culling", culling, "start", start, "pairs", pairs, "arithmetic", arithmetic, "threads",
          threads, "separation", separation, "keeps_near", keeps_near);
}
ASSAY_FIELDS(detector::Problem, error, message)
ASSAY_FIELDS(StepResult, answer, problem, first, pairs, view_positive, view_negative, view_zero,
             against_all, violated, dirty, views, doubts, signs, primitives, apexes, counts, times)
ASSAY_FIELDS(RunTimes, create, steps, peak_bytes)
ASSAY_FIELDS(LimitAnswer, share, positions)

template <class Archive>
void fields(Archive& archive, CaseRun& run) {
  // The host sets the last three members, so they are not sent.
  auto& [end, explanation, steps, candidates, limits, errors, over_capacity, has_answers, times,
         disturbances, processor_seconds, output] = run;
  archive("end", end, "explanation", explanation, "steps", steps, "candidates", candidates,
          "limits", limits, "errors", errors, "over_capacity", over_capacity, "has_answers",
          has_answers, "times", times);
}

ASSAY_FIELDS(Configuration, name, options, fault, is_timed, asks_limits)
ASSAY_FIELDS(CaseView, q0, q1)
ASSAY_FIELDS(corpus::CaseGhosts, apexes, triangles)
ASSAY_FIELDS(CountedPairs, level, body, apart, rings, rest_distance, rest, triangle_pairs,
             vertex_faces, edge_pairs)

// Lists the fields of a case and of its relation. Only facts that a detector may know are sent, and
// never the expected facts.
template <class Archive>
void fields(Archive& archive, corpus::CaseRelation& relation) {
  archive("pairs", relation.pairs);
}
template <class Archive>
void fields(Archive& archive, Case& c) {
  std::string query = query_word(c);
  archive("id", c.id, "triangles", c.triangles, "frames", c.frames, "script", c.script, "view",
          c.view, "counted", c.counted, "query", query);
  if (query != query_word(c)) say_query(c, query);  // false in a writer, which changes nothing
}

template <class Archive>
void fields(Archive& archive, Claims& claims) {
  std::uint32_t bits = claims.bits();
  archive("bits", bits);
  claims = Claims::of_bits(bits);
}

ASSAY_FIELDS(PluginParts, steps, query, candidates, limit, takes_threads)
ASSAY_FIELDS(PluginDescription, name, version, claims, contract, parts)

// The worker's first message: the description of the detector, or why the worker cannot run cases.
struct Hello {
  std::uint64_t wire_version = 0;
  PluginDescription description;
  bool serves = true;
  std::string refusal;  // why the worker cannot run cases; empty if it can
};
ASSAY_FIELDS(Hello, wire_version, description, serves, refusal)

// Cases and the configurations in which they run. The worker sends a RunReply for each
// configuration of the first case, in order, then for each configuration of the next case, and so
// on.
struct RunRequest {
  std::uint64_t number = 0;  // drawn for this request
  std::vector<Case> cases;
  std::vector<Configuration> configurations;
};
ASSAY_FIELDS(RunRequest, number, cases, configurations)

struct RunReply {
  std::uint64_t number = 0;  // that of the request
  std::uint64_t place = 0;   // the place of the run in the request
  CaseRun run;
};
ASSAY_FIELDS(RunReply, number, place, run)

template <class... T>
std::string encode(const T&... messages) {
  Wire<false> writer;
  // A writer does not change the messages. The functions `fields` take objects that are not const,
  // because readers call these functions too.
  (writer.field("", const_cast<T&>(messages)), ...);
  return writer.take();
}

template <class T>
bool decode(const std::string& bytes, T& message) {
  Wire<true> reader(bytes);
  reader.field("", message);
  return reader.complete();
}

// Returns a hash of the sizes of the plain types. Host and worker compare their hashes, to notice
// that they were built from different sources.
constexpr std::uint64_t wire_version() {
  std::uint64_t hash = 1;
  for (const std::size_t size :
       {sizeof(Options), sizeof(StepResult), sizeof(PairContact), sizeof(detector::StepCounts),
        sizeof(detector::StepTimes), sizeof(Claims), sizeof(Contract), sizeof(Case),
        sizeof(CountedPairs)})
    hash = hash * 1099511628211u + size;
  return hash;
}

// The results of a plug-in are checked in the plug-in's own process (plugin_reading.cpp). If that
// process damages its own memory, its reply can be malformed, which counts as a crash.

// The length in bytes of the longest line of text in a reply.
inline constexpr std::size_t longest_reply_text = 4096;

// Returns the length in bytes of the longest valid reply to this case, in which every pair of
// triangles is in contact in each step, and each step has positions.
std::uint64_t longest_reply(const Case& c);
// The most bytes that the first message of a worker may have.
inline constexpr std::uint64_t longest_hello = 4 * longest_reply_text;

// Returns whether all results of a run fit the case: its steps, triangles and vertices.
bool fits(const CaseRun& run, const Case& c);

// The end of one transfer of a message. too_long: the other end began a message of more bytes than
// are allowed.
enum class Transfer { done, closed, timed_out, too_long };

// Is called before each wait, and returns the longest time to wait before the next call. If it
// returns nothing, waiting ends; if it returns 0, waiting ends unless there is something to read.
// If the function is empty, waiting has no limit.
using Patience = std::function<std::optional<std::chrono::milliseconds>()>;

// A stream socket that carries whole messages: 8 bytes of length, then the bytes. Never raises
// SIGPIPE.
class Channel {
 public:
  explicit Channel(int descriptor) : descriptor_(descriptor) {}
  // Returns two connected channels, both closed on exec; nothing if the system gives no more
  // sockets. Only the first channel knows the senders of its messages.
  static std::optional<std::pair<Channel, Channel>> connected();

  int descriptor() const { return descriptor_; }
  // Returns the process id, as this process sees it, of the sender of the last received bytes; 0:
  // unknown.
  pid_t sender() const { return sender_; }
  Transfer send(const std::string& message, const Patience& patience = {});
  // Receives a message of at most `most` bytes. Memory is allocated only for bytes that have
  // arrived, not for the length that a message announces.
  Transfer receive(std::string& message, const Patience& patience = {},
                   std::uint64_t most = ~std::uint64_t{0});
  // Returns whether the other end has closed, without waiting.
  bool is_closed() const;

 private:
  Transfer wait_for(short events, const Patience& patience) const;

  ssize_t read_some(char* bytes, std::size_t size);

  Descriptor descriptor_;
  pid_t sender_ = 0;
  std::string received_;  // bytes received after the end of the last message
};

}  // namespace assay::properties
