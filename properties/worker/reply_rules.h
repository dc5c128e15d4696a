// What a worker may reply. A plug-in shares its process with the code that replies, so it can send
// whatever it likes: nothing of a reply is believed before it was looked at. What breaks a rule is
// taken for a crash of the plug-in.
#pragma once

#include <cstdint>
#include <string>

#include "corpus/cases/case_file.h"
#include "properties/problem.h"
#include "properties/worker/case_run.h"
#include "properties/worker/plugin/plugin_description.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

// Bytes of the longest line of text in a reply.
inline constexpr std::size_t longest_reply_text = 4096;

// Bytes that a reply to this case may have at most: every pair of triangles in contact in each
// step.
std::uint64_t longest_reply(const corpus::Case& c);
// Bytes of the first message of a worker at most.
inline constexpr std::uint64_t longest_hello = 4 * longest_reply_text;

// Which rule a run of a plug-in on this case breaks; empty: none. The rules: it completed with a
// result for each step, or was refused or ran out of memory without one; what only the host can
// say (crashed, hung, not run) is not said; texts are one printable line; a result has an answer,
// pairs of two triangles of the mesh, each once and ascending, only if it is not free, intervals
// in [0, 1], and nothing of what plug-ins are not asked for, such as views; there are candidates
// for each step, of such pairs, where the description claims them, and answers where it has steps;
// times, where there are any, are such, and one for each step.
std::string broken_rule(const corpus::Case& c, const CaseRun& run,
                        const PluginDescription& description);

// The same of answers to so many queries: as many, each with a known answer, an interval in [0, 1]
// and one printable line at most.
std::string broken_rule(std::size_t queries, const std::vector<QueryAnswer>& answers);
// Bytes that they may have at most.
std::uint64_t longest_query_reply(std::size_t queries);

// The same of a description: a name and a version in one printable line, a margin that is a
// length, a part that can be judged, a claim on candidates where there are any and nowhere else.
std::string broken_rule(const PluginDescription& description);

// The same of why a plug-in cannot be loaded: a problem of PluginHost::open in one printable line.
std::string broken_rule(const Problem& refusal);

}  // namespace assay::properties
