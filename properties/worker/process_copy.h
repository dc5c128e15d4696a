// Runs work in a copy of this process, so that a crash in it ends the copy alone.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "properties/worker/child_process.h"

namespace assay::properties {

struct CopyRun {
  std::string said;  // all that the work said, also if it crashed afterwards
  ChildEnd end;      // exited with code 0, if the work returned
};

// Tells the text to the process that the copy was made of. What was said is kept if the copy
// crashes; it is read when the copy has ended.
using Say = std::function<void(std::string_view)>;

// Makes a copy of this process, runs the work in it and waits for its end, however long that takes.
// The copy has one thread, and none of the open files: it holds no lock and no pipe any longer
// than this process does. The work must not wait for another thread of this process.
// Throws what the work threw, as std::bad_alloc or as std::runtime_error with its text, and
// std::runtime_error if no copy can be made.
// Cost: about a millisecond for a process of 100 MB.
CopyRun in_a_copy(const std::function<void(const Say&)>& work);

}  // namespace assay::properties
