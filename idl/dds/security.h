// SPDX-License-Identifier: Apache-2.0
#pragma once
// DDS Security from one directory of files, as deploy/security/make_security.sh makes it: who a participant is
// (identity_ca.pem, cert.pem, key.pem), what it may (permissions_ca.pem, governance.p7s, permissions.p7s), and whose
// certificate is withdrawn (identity_crl.pem, if there is one).
//
// @throws DdsError naming the file that is missing, unreadable, expired or no match for the others (security_files.h).

#include <fastdds/rtps/common/Property.h>

#include <string>
#include <vector>

namespace ehm::idl {

/// The properties that switch on authentication (PKI-DH), access control and cryptography (AES-GCM-GMAC).
std::vector<eprosima::fastrtps::rtps::Property> security_properties(const std::string& directory);

/// Does nothing if the directory is complete, or if none is given; throws what security_properties would.
void check_security(const std::string& directory);

}  // namespace ehm::idl
