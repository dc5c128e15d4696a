#include "properties/worker/messages.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstring>

namespace assay::properties {

std::uint64_t longest_reply(const Case& c) {
  // Those fields of a result that are not lists, and the numbers that begin lists.
  constexpr std::uint64_t bytes_of_a_result = 4096;
  const auto triangles = static_cast<std::uint64_t>(c.triangles.rows());
  const std::uint64_t pairs = triangles * (triangles - 1) / 2;
  const std::uint64_t steps = steps_of(c).size();
  return longest_reply_text + bytes_of_a_result +
         steps * (bytes_of_a_result + longest_reply_text +
                  static_cast<std::uint64_t>(c.frames.front().size()) * sizeof(double) +
                  pairs * (sizeof(PairContact) + sizeof(TrianglePair)));
}

bool fits(const CaseRun& run, const Case& c) {
  const auto is_pair = [&](const TrianglePair& pair) {
    return 0 <= pair.a && pair.a < pair.b && pair.b < c.triangles.rows();
  };
  const std::size_t steps = run.end == RunEnd::completed ? steps_of(c).size() : 0;
  const auto fit = [&](std::size_t size) { return size == 0 || size == steps; };
  return run.steps.size() == steps && fit(run.candidates.size()) && fit(run.limits.size()) &&
         run.errors.size() <= steps && fit(run.over_capacity.size()) &&
         (!run.times || fit(run.times->steps.size())) &&
         std::ranges::all_of(
             run.steps,
             [&](const StepResult& step) {
               return std::ranges::all_of(
                   step.pairs, [&](const PairContact& contact) { return is_pair(contact.pair); });
             }) &&
         std::ranges::all_of(run.candidates,
                             [&](const CandidatePairs& pairs) {
                               return !pairs || std::ranges::all_of(*pairs, is_pair);
                             }) &&
         std::ranges::all_of(run.limits, [&](const auto& limit) {
           return !limit || limit->positions.rows() == c.frames.front().rows();
         });
}

std::optional<std::pair<Channel, Channel>> Channel::connected() {
  std::array<int, 2> ends;
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return std::nullopt;
  const int yes = 1;
  ::setsockopt(ends[0], SOL_SOCKET, SO_PASSCRED, &yes, sizeof yes);
  return std::pair(Channel(ends[0]), Channel(ends[1]));
}

Transfer Channel::wait_for(short events, const Patience& patience) const {
  for (;;) {
    int milliseconds = -1;
    if (patience) {
      const auto longest = patience();
      if (!longest) return Transfer::timed_out;
      milliseconds = static_cast<int>(std::clamp<std::int64_t>(longest->count(), 0, INT_MAX));
    }
    pollfd watched = {descriptor_, events, 0};
    const int ready = ::poll(&watched, 1, milliseconds);
    if (ready > 0) return Transfer::done;
    if (ready < 0 && errno != EINTR) return Transfer::closed;
    if (ready == 0 && milliseconds == 0) return Transfer::timed_out;
  }
}

Transfer Channel::send(const std::string& message, const Patience& patience) {
  std::uint64_t length = message.size();
  std::array<char, sizeof length> head;
  std::memcpy(head.data(), &length, sizeof length);
  std::size_t count = 0;
  while (count < head.size() + message.size()) {
    const std::size_t of_head = std::min(count, head.size()), of_message = count - of_head;
    std::array<iovec, 2> parts = {
        {{head.data() + of_head, head.size() - of_head},
         {const_cast<char*>(message.data()) + of_message, message.size() - of_message}}};
    msghdr whole = {};
    whole.msg_iov = parts.data();
    whole.msg_iovlen = parts.size();
    const ssize_t now = ::sendmsg(descriptor_, &whole, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (now >= 0) {
      count += static_cast<std::size_t>(now);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      const auto waited = wait_for(POLLOUT, patience);
      if (waited != Transfer::done) return waited;
    } else if (errno != EINTR) {
      return Transfer::closed;
    }
  }
  return Transfer::done;
}

ssize_t Channel::read_some(char* bytes, std::size_t size) {
  iovec room = {bytes, size};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(ucred))> beside = {};
  msghdr message = {};
  message.msg_iov = &room;
  message.msg_iovlen = 1;
  message.msg_control = beside.data();
  message.msg_controllen = beside.size();
  const ssize_t count = ::recvmsg(descriptor_, &message, MSG_CMSG_CLOEXEC);
  const cmsghdr* head = count > 0 ? CMSG_FIRSTHDR(&message) : nullptr;
  if (head && head->cmsg_level == SOL_SOCKET && head->cmsg_type == SCM_CREDENTIALS) {
    ucred who;
    std::memcpy(&who, CMSG_DATA(head), sizeof who);
    sender_ = who.pid;
  }
  return count;
}

Transfer Channel::receive(std::string& message, const Patience& patience, std::uint64_t most) {
  std::uint64_t length = 0;
  constexpr std::size_t head = sizeof length;
  constexpr std::size_t block = 1 << 16;
  for (;;) {
    if (received_.size() >= head) {
      std::memcpy(&length, received_.data(), head);
      if (length > most) return Transfer::too_long;
      if (received_.size() - head >= length) {
        message.assign(received_, head, static_cast<std::size_t>(length));
        received_.erase(0, head + static_cast<std::size_t>(length));
        return Transfer::done;
      }
    }
    const auto waited = wait_for(POLLIN, patience);
    if (waited != Transfer::done) return waited;
    const std::size_t had = received_.size();
    received_.resize(had + block);
    const ssize_t now = read_some(received_.data() + had, block);
    received_.resize(had + (now > 0 ? static_cast<std::size_t>(now) : 0));
    if (now == 0 || (now < 0 && errno != EINTR)) return Transfer::closed;
  }
}

bool Channel::is_closed() const {
  char next;
  const ssize_t count = ::recv(descriptor_, &next, 1, MSG_PEEK | MSG_DONTWAIT);
  return count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
}

}  // namespace assay::properties
