// A stream socket that carries whole messages: 8 bytes of length, then the bytes. Never raises
// SIGPIPE.
#pragma once

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
      : descriptor_(std::exchange(other.descriptor_, -1)), received_(std::move(other.received_)) {}
  Channel& operator=(Channel&&) = delete;
  ~Channel();  // closes

  // Two connected channels, both closed on exec; nothing if the system has no more.
  static std::optional<std::pair<Channel, Channel>> connected();

  int descriptor() const { return descriptor_; }
  Transfer send(const std::string& message, const Patience& patience = {});
  // Receives a message of at most `most` bytes. Memory is taken only for what has come, and not
  // for what was announced.
  Transfer receive(std::string& message, const Patience& patience = {},
                   std::uint64_t most = ~std::uint64_t{0});
  // Whether the other end has closed, without waiting.
  bool is_closed() const;

 private:
  Transfer wait_for(short events, const Patience& patience) const;

  int descriptor_;
  std::string received_;  // bytes received beyond the last message
};

}  // namespace assay::properties
