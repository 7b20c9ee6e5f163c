// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/chart_frame.h"

#include <fmt/format.h>

#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {
namespace {

std::string swatch(Mark mark, int colour) {
  switch (mark) {
    case Mark::bar:
      return fmt::format(R"(<rect x="1" y="1" width="16" height="10" class="fill{}"/>)", colour);
    case Mark::line:
      return fmt::format(R"(<line x1="0" y1="6" x2="18" y2="6" class="stroke{}"/>)", colour);
    case Mark::dashed_line:
      return fmt::format(R"(<line x1="0" y1="6" x2="18" y2="6" class="stroke{} dashed"/>)", colour);
    case Mark::circle:
      return fmt::format(R"(<circle cx="9" cy="6" r="4" class="fill{}"/>)", colour);
    case Mark::tick:
      return fmt::format(R"(<line x1="9" y1="0" x2="9" y2="12" class="stroke{}"/>)", colour);
    case Mark::diamond:
      return fmt::format(R"(<polygon points="9,1 14,6 9,11 4,6" class="hollow{}"/>)", colour);
  }
  return "";
}

}  // namespace

std::string legend(const std::vector<LegendEntry>& entries) {
  if (entries.size() < 2) return "";
  std::string html = "<ul class=\"legend\">";
  for (const auto& [mark, colour, name] : entries) {
    html += "<li><svg xmlns=\"http://www.w3.org/2000/svg\" width=\"18\" height=\"12\" aria-hidden=\"true\">" +
            swatch(mark, colour) + "</svg>" + escaped(name) + "</li>";
  }
  return html + "</ul>";
}

}  // namespace ehm::tuner_design::report
