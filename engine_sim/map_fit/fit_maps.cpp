// SPDX-License-Identifier: Apache-2.0
// fit_maps SETTINGS.json MAPS.json OUT_FOLDER: tables of an engine's maps -> smooth maps as C++ for its engine file.

#include <iostream>

#include "engine_sim/map_fit/fit_maps_command.h"

int main(int argc, char** argv) {
  return ehm::engine_sim::run_fit_maps(argc, argv, std::cout, std::cerr);
}
