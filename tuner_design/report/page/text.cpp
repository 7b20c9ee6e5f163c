// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ehm::tuner_design::report {
namespace {

/// The UTF-8 sequences of a text, one a sign.
std::vector<std::string_view> signs(std::string_view text) {
  std::vector<std::string_view> result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t size = 1;
    while (i + size < text.size() && (static_cast<unsigned char>(text[i + size]) & 0xC0U) == 0x80U) ++size;
    result.push_back(text.substr(i, size));
    i += size;
  }
  return result;
}

/// From U+1100 on (three bytes, 0xE1 0x84) scripts are mostly full-width; punctuation and arrows of U+2000 are not.
int width(std::string_view sign) {
  const bool punctuation = sign.size() == 3 && static_cast<unsigned char>(sign[0]) == 0xE2U;
  const bool broad = sign == "W" || sign == "M" || sign == "m" || sign == "@";
  return broad || (sign.size() >= 3 && !punctuation) ? 2 : 1;
}

int width(const std::vector<std::string_view>& text, std::size_t from, std::size_t to) {
  int sum = 0;
  for (std::size_t i = from; i < to; ++i) sum += width(text[i]);
  return sum;
}

std::string joined(const std::vector<std::string_view>& text, std::size_t from, std::size_t to) {
  std::string result;
  for (std::size_t i = from; i < to; ++i) result += text[i];
  return result;
}

bool allowed_in_xml(std::string_view sign) {
  const auto byte = static_cast<unsigned char>(sign[0]);
  if (sign.size() == 1) return (byte >= 0x20U || byte == '\t' || byte == '\n') && byte < 0x7FU;
  return byte >= 0xC2U && sign != "\xEF\xBF\xBE" && sign != "\xEF\xBF\xBF";
}

std::string with_minus(std::string text) {
  if (!text.empty() && text[0] == '-') text.replace(0, 1, "−");
  return text;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const std::string_view sign : signs(text)) {
    if (!allowed_in_xml(sign)) {
      result += "\uFFFD";
    } else if (sign == "&") {
      result += "&amp;";
    } else if (sign == "<") {
      result += "&lt;";
    } else if (sign == ">") {
      result += "&gt;";
    } else if (sign == "\"") {
      result += "&quot;";
    } else {
      result += sign;
    }
  }
  return result;
}

std::string power_of_ten(int exponent) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string result = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) result += digits[digit - '0'];
  return result;
}

std::string number(double value, int significant) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  const std::string scientific = fmt::format("{:.{}e}", value, significant - 1);
  const std::size_t e = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(e + 1));
  if (exponent < -3 || exponent >= 6) return with_minus(scientific.substr(0, e)) + " × " + power_of_ten(exponent);
  return with_minus(fmt::format("{:.{}f}", value, std::max(0, significant - 1 - exponent)));
}

std::string quantity(double value, std::string_view unit, int significant) {
  return number(value, significant) + "\u00A0" + std::string(unit);
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string listed(const std::vector<std::string>& names) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i)
    result += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return result;
}

int letters(std::string_view text) {
  const auto parts = signs(text);
  return width(parts, 0, parts.size());
}

std::string shortened(std::string_view text, int most) {
  const auto parts = signs(text);
  if (width(parts, 0, parts.size()) <= most) return std::string(text);
  std::size_t head = 0, tail = parts.size();
  for (bool front = true;; front = !front) {
    const int more = width(front ? parts[head] : parts[tail - 1]);
    if (width(parts, 0, head) + width(parts, tail, parts.size()) + more > most - 1) break;
    front ? ++head : --tail;
  }
  return joined(parts, 0, head) + "…" + joined(parts, tail, parts.size());
}

std::vector<std::string> broken(std::string_view text, int most, std::size_t lines) {
  const auto parts = signs(text);
  std::vector<std::string> result;
  for (std::size_t from = 0; from < parts.size();) {
    if (result.size() + 1 == lines) {
      result.push_back(shortened(joined(parts, from, parts.size()), most));
      break;
    }
    std::size_t to = from, at = 0;
    while (to < parts.size() && (to == from || width(parts, from, to + 1) <= most)) {
      ++to;
      const std::string_view last = parts[to - 1];
      if (last == " " || last == "_" || last == "-") at = to;
    }
    if (to < parts.size() && at > from) to = at;
    result.push_back(joined(parts, from, to));
    from = to;
  }
  if (result.empty()) result.emplace_back();
  return result;
}

}  // namespace ehm::tuner_design::report
