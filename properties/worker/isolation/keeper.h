// The keeper stands between the host and a plug-in, which runs in a child of the keeper and has no
// descriptor that leads to the host. It passes bytes on and believes none of them.
//
//   host  <- channel ->  keeper  <- another channel ->  plug-in
//                          |  first process of a new world, where there is one: ends, and with it
//                          |  all that the plug-in started, when the plug-in or the keeper ends
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "properties/worker/channel.h"
#include "properties/worker/isolation/isolation.h"

namespace assay::properties {

// A file that the plug-in sees in the place of another one.
struct ReplacedFile {
  std::string copy, original;
};

struct KeptPlugin {
  IsolationMode mode = IsolationMode::best;
  std::string scratch;      // a folder, unless the mode is none
  std::uint64_t bytes = 0;  // address space of a process, and what it may write; 0: no limit
  std::string unread = {};  // a folder in which it reads no file (walls.h); empty: none
  std::vector<ReplacedFile> replaced = {};  // in its own world, if it has one
};

// What the keeper tells the host first, before the plug-in is loaded.
struct KeeperHello {
  std::uint64_t wire_version = 0;
  Isolation isolation;
  // The process of the plug-in, as the host sees it; 0: unknown.
  std::int64_t process = 0;
  bool has_copies = false;  // all files are replaced
};

// Starts the plug-in's process, which calls `serve` with its channel and exits with what that
// returns. Says hello to the host, and passes on what host and plug-in say until one of them ends.
// Then ends this process in the same way as the plug-in's process ended: with its code, or by its
// signal.
//
// What the plug-in prints goes to printed_descriptor before its next reply; if that is much, only
// the end of it (printed_words.h). With isolation none it goes where this process prints. If the
// isolation is required and not whole, the plug-in's process ends before `serve`.
[[noreturn]] void keep(Channel host, const KeptPlugin& kept,
                       const std::function<int(Channel)>& serve);

}  // namespace assay::properties
