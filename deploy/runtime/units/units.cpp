// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/units/units.h"

#include <algorithm>
#include <iterator>

#include "deploy/runtime/units/unit_table.h"

namespace ehm::units {
namespace {

constexpr std::size_t longest = 64;
constexpr std::string_view gauge_pressure = "gauge pressure";

char small(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// A unit's text without what does not matter.
class Spelling {
 public:
  explicit Spelling(std::string_view text) noexcept {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (is_degree_sign(text, i)) {
        append("deg");
      } else if (const std::string_view power = superscript(text, i); !power.empty()) {
        append(power);
      } else if (std::string_view(" \t_^*.[](){}\xC2\xB7").find(text[i]) == text.npos) {
        append(text.substr(i, 1));
      }
    }
    keep_case_ = size_ > 0 && small(buffer_[0]) == 'm';
    if (!keep_case_) std::transform(buffer_, buffer_ + size_, buffer_, small);
    shorten_degrees();
  }

  bool is(std::string_view known) const noexcept {
    std::size_t k = 0;
    for (const char c : known) {
      if (c == ' ') continue;  // of a name such as "N m"
      if (k == size_ || buffer_[k++] != (keep_case_ ? c : small(c))) return false;
    }
    return k == size_;
  }
  bool empty() const noexcept { return size_ == 0; }

 private:
  /// In UTF-8 two bytes, in Latin-1 one.
  static bool is_degree_sign(std::string_view text, std::size_t i) noexcept {
    return text[i] == '\xB0' || text[i] == '\xBA';
  }
  static std::string_view superscript(std::string_view text, std::size_t& i) noexcept {
    constexpr std::string_view minus = "\xE2\x81\xBB", one = "\xC2\xB9", two = "\xC2\xB2";
    const std::string_view rest = text.substr(i);
    if (rest.starts_with(minus)) return i += minus.size() - 1, "-";
    if (rest.starts_with(one)) return i += one.size() - 1, "1";
    if (rest.starts_with(two)) return i += two.size() - 1, "2";
    return {};
  }
  void append(std::string_view text) noexcept {
    for (const char c : text)
      if (size_ < longest) buffer_[size_++] = c;
  }
  /// "degrees celsius", "degc" and "c" are one.
  void shorten_degrees() noexcept {
    constexpr std::string_view scales[]{"c", "f", "r", "k", "celsius", "fahrenheit", "rankine", "kelvin"};
    const std::string_view text(buffer_, size_);
    for (const std::string_view prefix : {"degrees", "degree", "deg"}) {
      const std::string_view scale = text.substr(std::min(prefix.size(), text.size()));
      if (!text.starts_with(prefix) || std::find(std::begin(scales), std::end(scales), scale) == std::end(scales))
        continue;
      size_ = scale.size();
      std::copy(scale.begin(), scale.end(), buffer_);
      return;
    }
  }

  char buffer_[longest];
  std::size_t size_ = 0;
  bool keep_case_ = false;
};

bool spelt(const Unit& unit, const Spelling& text) noexcept {
  // Names such as degC have their prefix taken off, as the text has.
  if (text.is(unit.name.starts_with("deg") && unit.name.size() == 4 ? unit.name.substr(3) : unit.name)) return true;
  std::string_view rest = unit.spellings;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (text.is(rest.substr(0, end))) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

const Unit* find(std::string_view text) noexcept {
  const Spelling spelling(text);
  if (spelling.empty()) return nullptr;
  const auto found = std::find_if(table.begin(), table.end(), [&](const Unit& u) { return spelt(u, spelling); });
  return found == table.end() ? nullptr : &*found;
}

std::string known_text(std::string_view text, const Unit* unit) {
  const std::string quoted = "'" + std::string(text) + "'";
  return unit ? quoted + " is a " + std::string(unit->quantity) : quoted + " is not known";
}

}  // namespace

std::optional<Conversion> conversion(std::string_view from, std::string_view to) noexcept {
  if (from == to || from.empty() || to.empty()) return Conversion{};
  const Unit *a = find(from), *b = find(to);
  if (!a || !b || a->quantity != b->quantity) return std::nullopt;
  if (a == b) return Conversion{};
  return Conversion{a->factor / b->factor, (a->offset - b->offset) / b->factor};
}

bool is_gauge_pressure(std::string_view unit) noexcept {
  const Unit* known = find(unit);
  return known && known->quantity == gauge_pressure;
}

std::string why_not(std::string_view from, std::string_view to) {
  std::string text = known_text(from, find(from)) + ", " + known_text(to, find(to));
  const Unit *a = find(from), *b = find(to);
  const auto gauge = [](const Unit* unit) { return unit && unit->quantity == gauge_pressure; };
  if (gauge(a) != gauge(b)) text += "; a gauge pressure needs the ambient one added before";
  return text;
}

std::vector<std::string> relatives(std::string_view unit) {
  std::vector<std::string> names;
  const Unit* known = find(unit);
  if (!known) return names;
  for (const Unit& other : table)
    if (&other != known && other.quantity == known->quantity) names.emplace_back(other.name);
  return names;
}

}  // namespace ehm::units
