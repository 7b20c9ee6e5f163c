// SPDX-License-Identifier: Apache-2.0
#pragma once
// Ownership of HDF5's handles, and its errors as exceptions: HDF5's own C interface otherwise.
//
// @throws files::FileError with the file's name, what was tried, and HDF5's innermost reason.

#include <hdf5.h>

#include <string>
#include <utility>

namespace ehm::recording {

/// A handle that closes itself.
class Hdf5Object {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Object() = default;
  Hdf5Object(hid_t id, Close close) : id_(id), close_(close) {}
  Hdf5Object(Hdf5Object&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Object& operator=(Hdf5Object&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Object() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): to be handed to HDF5 as its own

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// To be called by each thread before its first call of HDF5. The library prints errors on stderr by itself; this makes
/// the calling thread's ones silent: they become exceptions. And it does without the library's own end at exit, which
/// crashes on a file that could not be closed, on a full disk; handles close themselves.
void prepare_hdf5();

[[noreturn]] void fail(const std::string& file, const std::string& action);

/// The handle of a call that succeeded. @throws files::FileError
inline Hdf5Object own(hid_t id, Hdf5Object::Close close, const std::string& file, const std::string& action) {
  if (id < 0) fail(file, action);
  return {id, close};
}
/// @throws files::FileError if the call failed
inline void check(herr_t result, const std::string& file, const std::string& action) {
  if (result < 0) fail(file, action);
}

}  // namespace ehm::recording
