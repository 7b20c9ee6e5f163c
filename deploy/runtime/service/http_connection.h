// SPDX-License-Identifier: Apache-2.0
#pragma once
// One accepted connection of the HTTP server, never waited for: it takes what has come, and sends what fits.
//
// Of a request only its first line is used. Everything else that a client may ask for by a header (ranges, compression,
// bodies, upgrades) is a feature that nobody here offers, and each would be a way to cost the service memory.

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

namespace ehm::service {

class HttpConnection {
 public:
  using Clock = std::chrono::steady_clock;
  enum class State { asking, asked, answering, over };
  static constexpr std::size_t longest_head = 8192;  ///< bytes, with all headers

  HttpConnection(int socket, Clock::time_point ask_end) : socket_(socket), end_(ask_end) {}
  ~HttpConnection();
  HttpConnection(HttpConnection&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)),
        state_(other.state_),
        end_(other.end_),
        text_(std::move(other.text_)),
        sent_(other.sent_) {}
  HttpConnection& operator=(HttpConnection&&) = delete;

  int socket() const { return socket_; }
  State state() const { return state_; }
  Clock::time_point end() const { return end_; }
  /// What poll(2) is to look for.
  short events() const;
  /// Takes what has come; the state is `asked` once the request is whole, `over` if it never will be.
  void receive();
  /// The first line of the request, as a whole request.
  std::string request() const;
  /// Begins to answer, until `end` at most.
  void answer(std::string text, Clock::time_point end);
  void send();
  /// Bytes of the answer that the client has not taken yet.
  std::size_t unsent() const { return state_ == State::answering ? text_.size() - sent_ : 0; }

 private:
  int socket_;
  State state_ = State::asking;
  Clock::time_point end_;
  std::string text_;  ///< the request, later the answer
  std::size_t sent_ = 0;
};

}  // namespace ehm::service
