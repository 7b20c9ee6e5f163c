// SPDX-License-Identifier: Apache-2.0
#pragma once
// What every study is given, and what it becomes: one result in the forms that a user can ask for. All forms are of the
// same result; making one runs nothing.

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>

#include "engine_sim/engines/engine_definition.h"
#include "tuner_design/report/page/page.h"

namespace ehm::tuner_design {

/// What all studies are given.
struct StudyGiven {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  std::uint64_t seed;
  unsigned threads;
};

/// Share of the work that is done, 0 to 1.
using StudyProgress = std::function<void(double)>;

struct StudyOutcome {
  std::function<void(std::ostream&)> print;
  std::function<nlohmann::ordered_json()> as_json;
  std::function<std::string()> as_csv;       ///< empty: the study has none
  std::function<report::Section()> section;  ///< empty: the study has none
};

template <class Study>
struct StudyForms {
  std::function<void(const Study&, std::ostream&)> print;
  std::function<nlohmann::ordered_json(const Study&)> as_json;
  std::function<std::string(const Study&)> as_csv = {};
  std::function<report::Section(const Study&)> section = {};
};

template <class Study>
StudyOutcome outcome_of(Study result, StudyForms<std::type_identity_t<Study>> forms) {
  const auto study = std::make_shared<const Study>(std::move(result));
  StudyOutcome outcome{
      [=](std::ostream& out) { forms.print(*study, out); }, [=] { return forms.as_json(*study); }, {}, {}};
  if (forms.as_csv) outcome.as_csv = [=] { return forms.as_csv(*study); };
  if (forms.section) outcome.section = [=] { return forms.section(*study); };
  return outcome;
}

}  // namespace ehm::tuner_design
