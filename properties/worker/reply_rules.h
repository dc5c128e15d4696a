// What a worker may reply. A plug-in shares its process with the code that replies, so it can send
// whatever it likes. So no part of a reply is believed before it has been checked. A reply that
// breaks a rule counts as a crash of the plug-in.
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

// The most bytes that a reply to this case may have: that of a reply with every pair of triangles
// in contact in each step.
std::uint64_t longest_reply(const corpus::Case& c);
// The most bytes that the first message of a worker may have.
inline constexpr std::uint64_t longest_hello = 4 * longest_reply_text;

// Which rule is broken by a run of a plug-in on this case; empty: none. The rules:
// - A run that completed has a result for each step. One that was refused, or ran out of memory,
//   has no results. No run claims an end that only the host can see (crashed, hung, not run).
// - Every text is one printable line.
// - A result states pairs only if its answer is neither `free` nor an error. Each is a pair of two
//   triangles of the mesh; pairs ascend, each once.
// - Intervals lie in [0, 1].
// - A result states nothing that plug-ins are not asked for, such as views.
// - If the description claims candidates, there is a list of such pairs for each step, and else
//   none.
// - There are answers if and only if the plug-in has the part of steps.
// - Times, if there are any, are finite and not negative, one for each step.
std::string broken_rule(const corpus::Case& c, const CaseRun& run,
                        const PluginDescription& description);

// The same for answers to so many queries: there is one answer for each, with a known answer, an
// interval in [0, 1] and at most one printable line.
std::string broken_rule(std::size_t queries, const std::vector<QueryAnswer>& answers);
// The most bytes that these answers may have.
std::uint64_t longest_query_reply(std::size_t queries);

// The same for a description: a name and a version in one printable line each that may be such
// (fault_of_name), a margin that is a length, at least one part that can be judged, and a claim on
// candidates if and only if it has them.
std::string broken_rule(const PluginDescription& description);

// The same for the reason why a plug-in cannot be loaded: a message of PluginHost::open, in one
// printable line.
std::string broken_rule(const std::string& refusal);

}  // namespace assay::properties
