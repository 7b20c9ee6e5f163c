// SPDX-License-Identifier: Apache-2.0
// tuner_design: nonlinear engine -> linear model -> design -> the file that monitor loads.

#include <iostream>

#include "deploy/runtime/service/written.h"
#include "tuner_design/cli/commands.h"

int main(int argc, char** argv) {
  const int code = ehm::tuner_design::run_tuner_design(argc, argv, std::cout, std::cerr);
  return ehm::service::written(code, std::cout, std::cerr, "tuner_design");
}
