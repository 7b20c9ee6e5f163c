// SPDX-License-Identifier: Apache-2.0
// Makes the DDS of this program one that somebody has tampered with: it asks nobody whether it may create a writer or a
// reader. Linked into the test program and exported, these definitions come before the library's own. So a refusal
// that a test sees was decided by the other side.

#include <string>
#include <vector>

namespace eprosima::fastrtps::rtps::security {

class Handle;
class SecurityException;

/// The part of the library's class that is replaced; the mangled names must be the same, the layout is not used.
class Permissions {
 public:
  bool check_create_datawriter(const Handle&, unsigned, const std::string&, const std::vector<std::string>&,
                               SecurityException&);
  bool check_create_datareader(const Handle&, unsigned, const std::string&, const std::vector<std::string>&,
                               SecurityException&);
};

bool Permissions::check_create_datawriter(const Handle&, unsigned, const std::string&, const std::vector<std::string>&,
                                          SecurityException&) {
  return true;
}

bool Permissions::check_create_datareader(const Handle&, unsigned, const std::string&, const std::vector<std::string>&,
                                          SecurityException&) {
  return true;
}

}  // namespace eprosima::fastrtps::rtps::security
