// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/engine_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"
#include "deploy/runtime/files/json_object.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/model/solve/steady.h"

namespace {

using namespace ehm;
using namespace ehm::engine_sim;
using files::Json;

std::string shipped(const std::string& name) {
  return std::string(EHM_SOURCE_DIR) + "/deploy/engines/" + name + ".json";
}

TEST(EngineFile, TheCompiledJt9dIsItsFileNumberByNumber) {
  EXPECT_EQ(engine_text(jt9d_engine()), files::read_input_file(shipped("jt9d"), files::json_file));
}

TEST(EngineFile, WhatWasReadIsWrittenAsItWas) {
  const std::string path = testing::TempDir() + "engine_file_test.json";
  write_engine(read_engine(shipped("jt9d")), path);
  EXPECT_EQ(files::read_input_file(path, files::json_file), engine_text(jt9d_engine()));
}

// The file's maps are other arrays in memory; every number that flies must be the same.
TEST(EngineFile, TheReadEngineFliesToTheBit) {
  const EngineDefinition read = read_engine(shipped("jt9d"));
  const Turbofan from_file(read.data), compiled(jt9d_engine().data);
  for (const auto& [flight, demand] :
       {std::pair<FlightCondition, Demand>{{10668.0, 0.8, 0.0}, {DemandKind::t40_k, 1308.6}},
        {{0.0, 0.0, 15.0}, {DemandKind::fuel_flow_kg_s, 2.2}},
        {{3000.0, 0.4, -20.0}, {DemandKind::n1_rpm, 2400.0}}}) {
    const GasPath a = solve_steady(from_file, flight, {}, demand).gas,
                  b = solve_steady(compiled, flight, {}, demand).gas;
    for (const OutputChannel& channel : output_channels())
      EXPECT_EQ(channel.read(a, read.data.ratings), channel.read(b, jt9d_engine().data.ratings)) << channel.name;
  }
}

TEST(EngineFile, TheHashIsOfWhatFlies) {
  const std::string hash = engine_hash(jt9d_engine());
  const Json json = Json::parse(engine_text(jt9d_engine()));
  EXPECT_EQ(engine_hash(engine_from_text(json.dump(), "laid out otherwise")), hash);
  Json other = json;
  other["source"] = "elsewhere";
  EXPECT_EQ(engine_hash(engine_from_text(other.dump(), "of another source")), hash);
  // every number counts: the last digit of one coefficient of one map
  other["hpt"]["map"]["efficiency"][3][2] = std::nextafter(json["hpt"]["map"]["efficiency"][3][2].get<double>(), 1.0);
  EXPECT_NE(engine_hash(engine_from_text(other.dump(), "other map")), hash);
}

TEST(EngineFile, VanesAndSourceMayBeLeftOut) {
  Json json = Json::parse(engine_text(jt9d_engine()));
  json.erase("source");
  json["hpc"].erase("vanes");
  const EngineDefinition engine = engine_from_text(json.dump(), "short");
  EXPECT_EQ(engine.source, "");
  EXPECT_EQ(engine.data.hpc.vanes.flow_per_deg, 0.0);
}

TEST(EngineFile, TheTypeIsTheNameInSmallLetters) {
  EngineData data = jt9d_engine().data;
  EXPECT_EQ(engine_type(data), "jt9d");
  data.name = "High bypass Turbofan";
  EXPECT_EQ(engine_type(data), "high-bypass-turbofan");
}

// Damage anywhere: a message that names the file, or an engine that is valid; never anything else.
TEST(EngineFile, DamageIsTold) {
  const std::string whole = engine_text(jt9d_engine());
  std::mt19937 random(20260101);
  int refused = 0;
  constexpr int cases = 300;
  for (int i = 0; i < cases; ++i) {
    std::string text = whole;
    const std::size_t at = random() % text.size();
    if (i % 3 == 0)
      text.resize(at);
    else
      text[at] = static_cast<char>(32 + random() % 95);
    try {
      engine_from_text(text, "damaged.json");
    } catch (const files::FileError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("damaged.json: "));
      ++refused;
    }
  }
  EXPECT_GT(refused, cases / 3);  // every truncated one, and some of the others
}

}  // namespace
