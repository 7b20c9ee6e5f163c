// SPDX-License-Identifier: Apache-2.0
#pragma once
// A request that has come in whole, as httplib reads it, and its answer as httplib writes it: no socket is touched, so
// that neither can block.

#include <httplib.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace ehm::service {

class MemoryStream : public httplib::Stream {
 public:
  explicit MemoryStream(std::string_view request) : request_(request) {}
  std::string take_answer() { return std::move(answer_); }

  bool is_readable() const override { return read_ < request_.size(); }
  bool is_writable() const override { return true; }
  ssize_t read(char* to, std::size_t size) override {
    const std::size_t count = std::min(size, request_.size() - read_);
    std::copy_n(request_.data() + read_, count, to);
    read_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, std::size_t size) override {
    answer_.append(from, size);
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return INVALID_SOCKET; }

 private:
  std::string_view request_;
  std::size_t read_ = 0;
  std::string answer_;
};

}  // namespace ehm::service
