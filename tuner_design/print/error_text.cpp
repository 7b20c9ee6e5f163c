// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/error_text.h"

#include <iomanip>
#include <sstream>

#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {

nlohmann::ordered_json errors_as_json(const Eigen::VectorXd& errors,
                                      const std::vector<linear_model::Channel>& channels) {
  nlohmann::ordered_json by_channel = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < channels.size(); ++i) by_channel[channels[i].name] = errors(as_index(i));
  return {{"total", errors.sum()}, {"by_channel", std::move(by_channel)}};
}

std::string figure(double value, int width) {
  std::ostringstream text;
  text << std::setw(width) << std::setprecision(5) << value;
  return text.str();
}

}  // namespace ehm::tuner_design
