#include "properties/campaign/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace assay::properties {
namespace {

using Json = nlohmann::ordered_json;

// The kinds of rows.
constexpr const char* canary_kind = "canary";
constexpr const char* problem_kind = "problem";
constexpr const char* fault_kind = "fault";
constexpr const char* power_kind = "power";
constexpr const char* world_kind = "world";
constexpr const char* asked_kind = "asked";
constexpr const char* subject_kind = "subject";
constexpr const char* digest_kind = "digest";
constexpr const char* waiver_kind = "waiver";
constexpr const char* corpus_kind = "corpus";
constexpr const char* self_test_kind = "self-test";
constexpr const char* times_kind = "times";

// The names of rows whose kind has few of them.
constexpr const char* trials_name = "trials";
constexpr const char* versions_name = "versions";
constexpr const char* paths_name = "paths";
constexpr const char* inputs_name = "inputs";
constexpr const char* issued_name = "issued";

// The keys of the facts, once for both directions. What a row's name or shard says is no fact.
template <class Io>
void fields(Io& io, Canary& x) {
  io("found_after", x.found_after);
}
template <class Io>
void fields(Io& io, HarnessProblem& x) {
  io("what", x.what);
}
template <class Io>
void fields(Io& io, MeshCounts& x) {
  io("triangles", x.triangles), io("vertices", x.vertices), io("steps", x.steps);
}
template <class Io>
void fields(Io& io, ShrunkFault& x) {
  io("before", x.before), io("after", x.after), io("calls", x.calls);
}
template <class Io>
void fields(Io& io, FaultProof& x) {
  io("law", x.law), io("status", x.status), io("curated", x.by_curated), io("needed", x.needed);
  io("cases", x.cases), io("time_over", x.time_over), io("known_vertices", x.known_vertices);
  io("shrunk", x.shrunk);
}
template <class Io>
void fields(Io& io, PowerSource& x) {
  io("campaign", x.campaign), io("detector", x.detector), io("seed", x.seed);
  io("program", x.program), io("worker", x.worker), io("generator", x.generator);
  io("rows", x.rows);
}
template <class Io>
void fields(Io& io, World& x) {
  io("classes", x.classes), io("motions", x.motions), io("all", x.all);
  io("collisions", x.collisions), io("complete", x.complete);
  io("counterexample", x.counterexample);
}
template <class Io>
void fields(Io& io, AskedGates& x) {
  io("gates", x.gates), io("certificate", x.certificate);
}
template <class Io>
void fields(Io& io, Versions& x) {
  io("assay", x.assay), io("commit", x.commit), io("libraries", x.libraries);
}
template <class Io>
void fields(Io& io, Paths& x) {
  io("out", x.out), io("detector", x.detector);
}
template <class Io>
void fields(Io& io, InputDigests& x) {
  io("corpus", x.corpus), io("waivers", x.waivers);
}
template <class Io>
void fields(Io& io, StoredWaiver& x) {
  io("reason", x.reason), io("link", x.link), io("expires", x.expires), io("expired", x.expired);
}
template <class Io>
void fields(Io& io, CorpusRow::Failed& x) {
  io("case", x.id), io("signature", x.signature), io("what", x.what);
}
template <class Io>
void fields(Io& io, CorpusRow& x) {
  io("input", x.input), io("configuration", x.configuration), io("cases", x.cases);
  io("left_out", x.left_out), io("steps", x.steps), io("collisions", x.collisions);
  io("pairs", x.pairs), io("defects", x.defects), io("failed", x.failed);
}
template <class Io>
void fields(Io& io, SelfTestRow& x) {
  io("queries", x.queries), io("contacts", x.contacts), io("contradictions", x.contradictions);
  io("open", x.open), io("complete", x.complete);
}
template <class Io>
void fields(Io& io, SpeedFigure& x) {
  io("median", x.median), io("lo", x.lo), io("hi", x.hi), io("samples", x.samples);
}
template <class Io>
void fields(Io& io, Issued& x) {
  io("at", x.at), io("seconds", x.seconds);
}

class Writer {
 public:
  template <class T>
  void operator()(const char* key, T& value) {
    json_[key] = json_of(value);
  }
  template <class T>
  static Json json_of(T& value) {
    if constexpr (std::is_same_v<T, FaultStatus>) {
      return name_of(value);
    } else if constexpr (std::is_constructible_v<Json, T>) {
      return value;
    } else {
      Writer writer;
      fields(writer, value);
      return std::move(writer.json_);
    }
  }
  template <class T>
  static Json json_of(std::optional<T>& value) {
    return value ? json_of(*value) : Json(nullptr);
  }
  template <class T>
  static Json json_of(std::vector<T>& values) {
    Json list = Json::array();
    for (auto& value : values) list.push_back(json_of(value));
    return list;
  }

 private:
  Json json_ = Json::object();
};

class Reader {
 public:
  explicit Reader(const Json& json) : json_(json) {}
  template <class T>
  void operator()(const char* key, T& value) {
    read(json_.at(key), value);
  }
  template <class T>
  static void read(const Json& json, T& value) {
    if constexpr (std::is_constructible_v<Json, T>) {
      json.get_to(value);
    } else {
      Reader reader(json);
      fields(reader, value);
    }
  }
  static void read(const Json& json, FaultStatus& status) {
    for (const auto one : {FaultStatus::planted, FaultStatus::open, FaultStatus::equivalent}) {
      if (json == name_of(one)) return void(status = one);
    }
    throw StoreProblem("no status of a fault: " + json.dump());
  }
  template <class T>
  static void read(const Json& json, std::optional<T>& value) {
    if (!json.is_null()) read(json, value.emplace());
  }
  template <class T>
  static void read(const Json& json, std::vector<T>& values) {
    for (const auto& item : json) read(item, values.emplace_back());
  }

 private:
  const Json& json_;
};

template <class T>
Evidence row(const char* kind, const std::string& name, const std::string& shard, T facts,
             std::uint64_t progress = 1) {
  return {kind, name, shard, progress, Writer::json_of(facts).dump()};
}

// `facts` with what the row's facts say.
template <class T>
T told(const Evidence& row, T facts = {}) {
  Reader::read(Json::parse(row.facts), facts);
  return facts;
}

}  // namespace

bool FaultProof::found() const {
  return by_curated ||
         std::any_of(needed.begin(), needed.end(), [](const auto& n) { return n.has_value(); });
}

std::optional<std::uint64_t> FaultProof::median() const {
  if (needed.empty()) return std::nullopt;
  auto sorted = needed;
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a && (!b || *a < *b); });
  return sorted[(sorted.size() - 1) / 2];
}

Evidence to_row(const Canary& x) { return row(canary_kind, x.fault, x.shard, x); }
Evidence to_row(const HarnessProblem& x) { return row(problem_kind, trials_name, x.shard, x); }
Evidence to_row(const FaultProof& x) {
  // A hunt that had its time is farther than any that was ended by it.
  const auto all = static_cast<std::uint64_t>(x.needed.size()) + 1;
  const auto found = static_cast<std::uint64_t>(
      std::count_if(x.needed.begin(), x.needed.end(), [](const auto& n) { return n.has_value(); }));
  return row(fault_kind, x.fault, x.shard, x, x.time_over ? found : all);
}
Evidence to_row(const PowerSource& x) { return row(power_kind, x.campaign, power_shard, x); }
Evidence to_row(const World& x) {
  // A counterexample is farther than any number of classes that hold.
  constexpr std::uint64_t farthest = std::numeric_limits<std::int64_t>::max();
  return row(world_kind, x.world, x.shard, x, x.counterexample ? farthest : x.classes);
}
Evidence to_row(const AskedGates& x) { return row(asked_kind, "gates", checks_shard, x); }
Evidence to_row(const Versions& x) { return row(subject_kind, versions_name, checks_shard, x); }
Evidence to_row(const Paths& x) { return row(subject_kind, paths_name, checks_shard, x); }
Evidence to_row(const InputDigests& x) { return row(digest_kind, inputs_name, checks_shard, x); }
Evidence to_row(const StoredWaiver& x) { return row(waiver_kind, x.signature, checks_shard, x); }
Evidence to_row(const CorpusRow& x) {
  return row(corpus_kind, x.input + ", " + x.configuration, checks_shard, x);
}
Evidence to_row(const SelfTestRow& x) { return row(self_test_kind, x.family, checks_shard, x); }
Evidence to_row(const SpeedFigure& x) { return row(times_kind, x.what, checks_shard, x); }
Evidence to_row(const Issued& x) { return row(times_kind, issued_name, checks_shard, x); }

void EvidenceFacts::take(const Evidence& r) try {
  if (r.kind == canary_kind) {
    canaries.push_back(told<Canary>(r, {r.name, r.shard, {}}));
  } else if (r.kind == problem_kind) {
    problems.push_back(told<HarnessProblem>(r, {r.shard, ""}));
  } else if (r.kind == fault_kind) {
    faults.push_back(told<FaultProof>(r));
    faults.back().fault = r.name;
    faults.back().shard = r.shard;
  } else if (r.kind == power_kind) {
    power.push_back(told<PowerSource>(r));
  } else if (r.kind == world_kind) {
    worlds.push_back(told<World>(r));
    worlds.back().world = r.name;
    worlds.back().shard = r.shard;
  } else if (r.kind == asked_kind) {
    asked = told<AskedGates>(r);
  } else if (r.kind == subject_kind && r.name == versions_name) {
    versions = told<Versions>(r);
  } else if (r.kind == subject_kind && r.name == paths_name) {
    paths = told<Paths>(r);
  } else if (r.kind == digest_kind) {
    inputs = told<InputDigests>(r);
  } else if (r.kind == waiver_kind) {
    waivers.push_back(told<StoredWaiver>(r));
    waivers.back().signature = r.name;
  } else if (r.kind == corpus_kind) {
    corpus.push_back(told<CorpusRow>(r));
  } else if (r.kind == self_test_kind) {
    self_test.push_back(told<SelfTestRow>(r));
    self_test.back().family = r.name;
  } else if (r.kind == times_kind && r.name == issued_name) {
    issued = told<Issued>(r);
  } else if (r.kind == times_kind) {
    speed.push_back(told<SpeedFigure>(r));
    speed.back().what = r.name;
  } else {
    throw StoreProblem(fmt::format("no run stores evidence {} {}", r.kind, r.name));
  }
} catch (const nlohmann::json::exception& wrong) {
  throw StoreProblem(fmt::format("evidence {} {}: {}", r.kind, r.name, wrong.what()));
}

void drop(Store& store, DroppedKind kind) {
  switch (kind) {
    case DroppedKind::problem:
      return store.drop_evidence(problem_kind);
    case DroppedKind::fault:
      store.drop_evidence(power_kind);
      return store.drop_evidence(fault_kind);
    case DroppedKind::waiver:
      return store.drop_evidence(waiver_kind);
    case DroppedKind::corpus:
      return store.drop_evidence(corpus_kind);
    case DroppedKind::self_test:
      return store.drop_evidence(self_test_kind);
    case DroppedKind::times:
      return store.drop_evidence(times_kind);
  }
}

bool may_differ(const Evidence& row) {
  const bool is_path = row.kind == subject_kind && row.name == paths_name;
  return row.kind == times_kind || row.kind == world_kind || is_path;
}

}  // namespace assay::properties
