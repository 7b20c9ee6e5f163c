// SPDX-License-Identifier: Apache-2.0
#include "monitor/dds/misfit_text.h"

#include <spdlog/fmt/fmt.h>

namespace ehm::monitor {

std::string misfit_text(const std::string& what, std::size_t i, const ChannelWords& said, const std::string& by,
                        const std::vector<linear_model::Channel>& channels, Misfit misfit) {
  const linear_model::Channel& own = channels.at(i);
  const std::string text =
      fmt::format("{} {} is {} in {} by {}, {} in {} by the design", what, i, said.name.empty() ? own.name : said.name,
                  said.unit.empty() ? own.unit : said.unit, by, own.name, own.unit);
  switch (misfit) {
    case Misfit::place:
      return text + ": the order is not the design's";
    case Misfit::unit:
      return text + ": " + units::why_not(said.unit, own.unit);
    case Misfit::name:
    case Misfit::none:
      break;
  }
  return text;
}

}  // namespace ehm::monitor
