// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/hdf5_object.h"

#include "deploy/runtime/files/file_error.h"

namespace ehm::recording {

namespace {

/// The walk begins at the innermost error; that one tells the reason.
herr_t innermost(unsigned level, const H5E_error2_t* error, void* text) {
  if (level == 0 && error->desc) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

}  // namespace

void prepare_hdf5() {
  H5dont_atexit();  // a second time it does nothing
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void fail(const std::string& file, const std::string& action) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &reason);
  throw files::FileError(file + ": cannot " + action + (reason.empty() ? "" : ": " + reason));
}

}  // namespace ehm::recording
