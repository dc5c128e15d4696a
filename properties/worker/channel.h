// A stream socket that carries whole messages: 8 bytes of length, then the bytes. Never raises
// SIGPIPE.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace assay::properties {

// too_long: the other end began a message of more bytes than there may be.
enum class Transfer { done, closed, timed_out, too_long };

// Is asked before each wait how long to wait at most before asking again. If it returns nothing,
// waiting is over; if 0, it is over when nothing is there to be read. An empty function waits for
// ever.
using Patience = std::function<std::optional<std::chrono::milliseconds>()>;

class Channel {
 public:
  explicit Channel(int descriptor) : descriptor_(descriptor) {}
  Channel(Channel&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)),
        sender_(other.sender_),
        received_(std::move(other.received_)) {}
  Channel& operator=(Channel&&) = delete;
  ~Channel();  // closes

  // Two connected channels, both closed on exec; nothing if the system has no more. The first one
  // tells its senders.
  static std::optional<std::pair<Channel, Channel>> connected();

  int descriptor() const { return descriptor_; }
  // The process that sent what was received last, as this process sees it; 0: unknown.
  pid_t sender() const { return sender_; }
  Transfer send(const std::string& message, const Patience& patience = {});
  // Receives a message of at most `most` bytes. Memory is taken only for what has come, and not
  // for what was announced.
  Transfer receive(std::string& message, const Patience& patience = {},
                   std::uint64_t most = ~std::uint64_t{0});
  // Whether the other end has closed, without waiting.
  bool is_closed() const;

 private:
  Transfer wait_for(short events, const Patience& patience) const;

  ssize_t read_some(char* bytes, std::size_t size);

  int descriptor_;
  pid_t sender_ = 0;
  std::string received_;  // bytes received beyond the last message
};

}  // namespace assay::properties
