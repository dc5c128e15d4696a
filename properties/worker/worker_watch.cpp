#include "properties/worker/worker_watch.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <thread>

namespace assay::properties {

namespace {

constexpr double shortest_wait = 1e-3;  // seconds

// The wait before the first look. The processor time that children of the worker used for the case
// before that look is not counted, so the look comes early. Most cases are over by then, so it
// costs them nothing.
double first_wait(double limit) { return std::clamp(limit / 10, shortest_wait, .05); }

// The wait between two looks. It is long enough to tell sleep from a pause, and long enough that a
// look costs nothing.
double longest_wait(double limit) { return std::clamp(limit / 10, shortest_wait, 1.); }

double seconds_between(std::chrono::steady_clock::time_point from,
                       std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

WorkerWatch::WorkerWatch(const ChildProcess& worker, double seconds, pid_t plugin)
    : worker_(worker), limit_(seconds), time_(worker.id(), plugin) {
  begin();
}

void WorkerWatch::begin() {
  used_ = watched_ = asleep_ = 0;
  end_ = End::none;
  plan_next_look(Clock::now(), first_wait(limit_));
}

double WorkerWatch::next_case() {
  const double used = time_.lap();
  begin();
  return used;
}

void WorkerWatch::plan_next_look(Clock::time_point now, double seconds) {
  last_look_ = now;
  next_look_ = now + std::chrono::duration_cast<Clock::duration>(
                         std::chrono::duration<double>(std::max(seconds, shortest_wait)));
}

std::optional<std::chrono::milliseconds> WorkerWatch::patience() {
  const auto now = Clock::now();
  if (end_ == End::none && now >= next_look_) look(now);
  if (end_ == End::ended) return std::chrono::milliseconds(0);
  if (end_ != End::none) return std::nullopt;
  return std::chrono::ceil<std::chrono::milliseconds>(next_look_ - now);
}

void WorkerWatch::look(Clock::time_point now) {
  // A look that comes late was held up, because the host or the machine was stopped, and perhaps
  // so was the worker. So it counts for at most twice the time that was planned.
  const double since =
      std::min(seconds_between(last_look_, now), 2 * seconds_between(last_look_, next_look_));
  const bool is_first = watched_ == 0;
  const ProcessTree tree = time_.look();
  const double used = time_.seconds();
  watched_ += since;
  // Threads that wait with a time-out wake up now and then and go to sleep again, so a little use
  // of the processor still counts as sleep. A process that gets no processor is seen as runnable,
  // not as asleep.
  constexpr double idle_share = .01;
  if (!is_first && tree.is_asleep && used - used_ <= idle_share * since) asleep_ += since;
  used_ = used;
  if (used_ >= limit_) {
    end_ = End::used_up;
  } else if (asleep_ >= asleep_limit * limit_) {
    end_ = End::asleep;
  } else if (watched_ >= wall_limit * limit_) {
    end_ = End::endless;
  } else if (worker_.has_ended()) {
    end_ = End::ended;
  }
  const double processors = std::max(1u, std::thread::hardware_concurrency());
  const double earliest = std::max((limit_ - used_) / processors, limit_ / 100);
  plan_next_look(now, std::min(earliest, longest_wait(limit_)));
}

std::string WorkerWatch::why() const {
  std::array<char, 128> text;
  switch (end_) {
    case End::asleep:
      std::snprintf(text.data(), text.size(),
                    "no answer in %g s of processor time: asleep for %g s", limit_,
                    asleep_limit * limit_);
      break;
    case End::endless:
      std::snprintf(text.data(), text.size(), "no answer in %g s of processor time, nor in %g s",
                    limit_, wall_limit * limit_);
      break;
    default:
      std::snprintf(text.data(), text.size(), "no answer in %g s of processor time", limit_);
  }
  return text.data();
}

}  // namespace assay::properties
