#pragma once
// The certificate of a design for people: is it at an optimum, how near to the limit, do the starts agree.

#include <iosfwd>

#include "monitor/design/certificate.h"

namespace ehm::bench {

void print_certificate(const design::Certificate& certificate, std::ostream& out);

}  // namespace ehm::bench
