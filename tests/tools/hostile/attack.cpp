// SPDX-License-Identifier: Apache-2.0
#include "tests/tools/hostile/attack.h"

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <limits>

#include "idl/wire_values.h"

namespace ehm::test {

namespace {

using Random = std::mt19937_64;

template <class T>
T one_of(std::initializer_list<T> values, Random& random) {
  return values.begin()[random() % values.size()];
}

double bad_number(Random& random) {
  using Limits = std::numeric_limits<double>;
  return one_of<double>({Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::max(), Limits::lowest(),
                         Limits::denorm_min(), 1e30, -0.0},
                        random);
}
double not_finite(Random& random) {
  using Limits = std::numeric_limits<double>;
  return one_of<double>({Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}, random);
}
std::uint32_t bad_count(Random& random) {
  return one_of<std::uint32_t>({17u, 1000u, 0x80000000u, 0xffffffffu}, random);
}

template <class Array>
double& any(Array& values, std::size_t count, Random& random) {
  return values[random() % std::max<std::size_t>(1, std::min(count, values.size()))];
}

void make_noise(EngineSensors& s, Random& random) {
  const auto word = [&] { return static_cast<std::uint32_t>(random()); };
  const auto number = [&] { return std::bit_cast<double>(random()); };
  // Half of them pass the first checks, so that the later ones are met too.
  if (random() % 2) s.schema(word());
  if (random() % 2) s.sensor_count(word());
  if (random() % 2) s.actuator_count(word());
  s.sequence_number(random());
  s.source_time_ns(static_cast<std::int64_t>(random()));
  s.altitude_m(number());
  s.mach(number());
  s.delta_isa_k(number());
  s.sensor_valid(word());
  for (double& a : s.actuator()) a = number();
  for (double& y : s.sensor()) y = number();
}

}  // namespace

const std::vector<AttackName>& attack_names() {
  static const std::vector<AttackName> names{
      {Attack::schema, "schema"},     {Attack::counts, "counts"},    {Attack::flight, "flight"},
      {Attack::actuator, "actuator"}, {Attack::sensor, "sensor"},    {Attack::engine, "engine"},
      {Attack::sequence, "sequence"}, {Attack::time, "time"},        {Attack::bits, "bits"},
      {Attack::command, "command"},   {Attack::text, "text", false}, {Attack::reset, "reset", false}};
  return names;
}

std::optional<Attack> attack_of(const std::string& name) {
  for (const auto& known : attack_names())
    if (name == known.name) return known.attack;
  return std::nullopt;
}

void spoil(EngineSensors& s, Attack attack, Random& random) {
  constexpr auto latest = std::numeric_limits<std::int64_t>::max(), earliest = std::numeric_limits<std::int64_t>::min();
  switch (attack) {
    case Attack::schema:
      s.schema(one_of<std::uint32_t>({0u, idl::schema_version + 1, 77u, 0xffffffffu}, random));
      break;
    case Attack::counts:
      random() % 2 ? s.sensor_count(bad_count(random)) : s.actuator_count(bad_count(random));
      break;
    case Attack::flight:
      random() % 2 ? s.altitude_m(not_finite(random)) : s.mach(not_finite(random));
      break;
    case Attack::actuator:
      any(s.actuator(), s.actuator_count(), random) = bad_number(random);
      break;
    case Attack::sensor:
      any(s.sensor(), s.sensor_count(), random) = bad_number(random);
      break;
    case Attack::engine:
      // Without a schema that can be read: a readable sample of an unknown engine would rightly get a spare filter.
      s.engine_id(random() % 2 ? 0u : 1'000'000u + static_cast<std::uint32_t>(random() % 1000));
      s.schema(idl::schema_version + 1);
      break;
    case Attack::sequence:
      s.sequence_number(random() % 2 ? random() : one_of<std::uint64_t>({0ull, ~0ull, ~0ull / 2}, random));
      break;
    case Attack::time:
      s.source_time_ns(random() % 2 ? static_cast<std::int64_t>(random())
                                    : one_of<std::int64_t>({latest, earliest, std::int64_t{0}}, random));
      break;
    case Attack::bits:
      make_noise(s, random);
      break;
    case Attack::command:
    case Attack::text:
    case Attack::reset:
      break;
  }
}

MonitorCommand bad_command(std::uint32_t engine_id, Random& random) {
  MonitorCommand command;
  command.engine_id(random() % 2 ? engine_id : 0u);
  const bool unknown_kind = random() % 2;
  command.schema(unknown_kind ? idl::schema_version : idl::schema_version + 1);
  command.kind(unknown_kind ? 0x80000000u | static_cast<std::uint32_t>(random()) : 1u);
  return command;
}

MonitorCommand reset_command(std::uint32_t engine_id) {
  MonitorCommand command;
  command.engine_id(engine_id);
  command.schema(idl::schema_version);
  command.kind(static_cast<std::uint32_t>(idl::MonitorCommandKind::reset));
  return command;
}

EngineDescription bad_description(std::uint32_t engine_id, std::uint32_t source_id, Random& random) {
  EngineDescription d;
  d.engine_id(engine_id);
  d.source_id(source_id);
  d.role(static_cast<std::uint32_t>(idl::DescriptionRole::source));
  d.schema(idl::schema_version);
  const auto text = [&random] {
    return one_of<const char*>({"\x1b[2J\x1b[H", "\x1b]0;owned\x07", "T30\r\nmonitor: all is well",
                                "\x9b"
                                "31m",
                                "\xe2\x80\xae", "\xff\xfe", "%s%n%n", ""},
                               random);
  };
  d.engine_type(text());
  d.design_hash(text());
  d.sensor_count(random() % 2 ? 7u : bad_count(random));
  d.actuator_count(random() % 2 ? 5u : bad_count(random));
  for (auto& channel : d.sensors()) channel.name(text()), channel.unit(text());
  for (auto& channel : d.actuators()) channel.name(text()), channel.unit(text());
  return d;
}

}  // namespace ehm::test
