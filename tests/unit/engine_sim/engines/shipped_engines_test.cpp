// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/shipped_engines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/engine_file.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "tests/unit/engine_sim/engines/high_bypass_definition.h"

namespace {

using namespace ehm;
using namespace ehm::engine_sim;
using files::Json;

/// Every number alike but for rounding, everything else the same. EHM_WRITE_ENGINE=FILE writes `made` as a file.
void expect_alike(const Json& read, const Json& made, const std::string& key) {
  if (made.is_number() && read.is_number()) {
    const double a = read.get<double>(), b = made.get<double>();
    EXPECT_LE(std::abs(a - b), 1e-9 * std::max({1e-6, std::abs(a), std::abs(b)})) << key << ": " << a << ", " << b;
  } else if (made.is_structured() && made.size() == read.size()) {
    for (const auto& [name, value] : made.items())
      expect_alike(made.is_object() ? read.at(name) : read.at(as_size(std::stoul(name))), value, key + "." + name);
  } else {
    EXPECT_EQ(read, made) << key;
  }
}

// Sizing is an iteration that settles to 1e-13: another compiler's rounding may show, a change of the model does.
TEST(ShippedEngines, TheHighBypassFileIsWhatItsDataSheetGives) {
  const EngineDefinition made = high_bypass_definition();
  if (const char* file = std::getenv("EHM_WRITE_ENGINE")) write_engine(made, file);
  expect_alike(Json::parse(engine_text(*named_engine("high_bypass"))), Json::parse(engine_text(made)), "");
}

TEST(ShippedEngines, AreFoundByNameAndByFile) {
  EXPECT_THAT(shipped_engine_list(), testing::ElementsAre("jt9d", "high_bypass"));
  for (const std::string& name : shipped_engine_list()) {
    const auto by_file = named_engine(std::string(EHM_SOURCE_DIR) + "/deploy/engines/" + name + ".json");
    EXPECT_EQ(engine_hash(*by_file), engine_hash(*named_engine(name))) << name;
  }
  EXPECT_EQ(default_engine().get(), &jt9d_engine());
}

TEST(ShippedEngines, AnUnknownNameIsRefused) {
  EXPECT_THROW(named_engine("jt8d"), files::FileError);
  EXPECT_THROW(named_engine(""), files::FileError);
  EXPECT_THROW(named_engine("./jt9d"), files::FileError);  // a path, and there is no such file
}

}  // namespace
