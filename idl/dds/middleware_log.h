// SPDX-License-Identifier: Apache-2.0
#pragma once
// What Fast DDS itself logs, handed to us instead of its standard error. Its logging is one a process.

#include <functional>
#include <memory>
#include <string>

namespace ehm::idl {

struct MiddlewareMessage {
  bool error = false;    ///< else a warning
  std::string category;  ///< such as SECURITY, SECURITY_AUTHENTICATION, RTPS_PARTICIPANT
  std::string text;
};

enum class MiddlewareLevel { errors, warnings };

/// From now on `hear` is told of every error, and warning if asked for, on the middleware's logging thread.
void hear_middleware(std::function<void(const MiddlewareMessage&)> hear,
                     MiddlewareLevel level = MiddlewareLevel::warnings);

/// An error of the middleware that is none. Fast DDS 2.9.1 schedules the next deadline of an instance in the very call
/// that takes the instance away (unregister_instance, Writer::release), and then says "Could not set the next deadline
/// in the history": at each stop in order, for each engine and topic.
bool is_of_no_concern(const MiddlewareMessage& message);

/// Collects the middleware's errors while it lives; its end gives the middleware its own logging back.
class MiddlewareErrors {
 public:
  MiddlewareErrors();
  ~MiddlewareErrors();
  MiddlewareErrors(const MiddlewareErrors&) = delete;
  MiddlewareErrors& operator=(const MiddlewareErrors&) = delete;
  /// All errors so far in one line.
  std::string text() const;

 private:
  struct Collected;
  std::shared_ptr<Collected> collected_;
};

}  // namespace ehm::idl
