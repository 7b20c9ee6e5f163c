#include "monitor/cycle/prepared_design.h"

#include "monitor/design/make_error_model.h"
#include "monitor/design/make_filter.h"

namespace ehm::monitor {

namespace {

std::vector<estimation::ErrorModel> make_error_models(const design::Design& design) {
  std::vector<estimation::ErrorModel> models{design::make_error_model(design, design.full)};
  for (const auto& subset : design.missing)
    models.push_back(subset ? design::make_error_model(design, *subset) : estimation::ErrorModel{});
  return models;
}

}  // namespace

PreparedDesign::PreparedDesign(std::shared_ptr<const design::Design> of)
    : design(std::move(of)),
      filter(design::make_filter(*design)),
      error_models(std::make_shared<const std::vector<estimation::ErrorModel>>(make_error_models(*design))),
      faults(fault_tables(*design)),
      shift(shift_tables(*design)),
      slow_bias(slow_bias_table(*design)),
      fleet(fleet_tables(*design, *error_models)) {}

}  // namespace ehm::monitor
