// SPDX-License-Identifier: Apache-2.0
#pragma once
// Text as a report shows it: escaped for XML, numbers for people, names cut and broken to fit. Names come from users'
// files: they may hold markup, control characters, any script, and 63 characters without a space.
// Text is UTF-8. Widths are counted in average letters; W, M, m and full-width (CJK) signs count two. Errors: none.

#include <string>
#include <string_view>
#include <vector>

namespace ehm::tuner_design::report {

/// For element content and attribute values. What XML 1.0 does not allow becomes U+FFFD.
std::string escaped(std::string_view text);

/// `significant` digits; powers of ten below 1e-3 and from 1e6 on. A real minus sign; "–" where it is not a number.
std::string number(double value, int significant = 3);

/// number() and a unit on the same line.
std::string quantity(double value, std::string_view unit, int significant = 3);

/// A power of ten: "10⁻³".
std::string power_of_ten(int exponent);

/// "1 tuner", "7 tuners".
std::string counted(std::size_t count, const std::string& noun);

/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& names);

int letters(std::string_view text);

/// At most `most` letters: the middle gives way to "…", since names often differ at their ends.
std::string shortened(std::string_view text, int most);

/// Lines of at most `most` letters, broken after a space, underscore or hyphen where there is one; at most `lines`,
/// the last of them shortened.
std::vector<std::string> broken(std::string_view text, int most, std::size_t lines);

}  // namespace ehm::tuner_design::report
