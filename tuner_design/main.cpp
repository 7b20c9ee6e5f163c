// tuner_design: nonlinear engine -> linear model -> design -> the file that monitor loads.

#include <iostream>

#include "tuner_design/commands.h"

int main(int argc, char** argv) {
  return ehm::bench::run_tuner_design(argc, argv, std::cout, std::cerr);
}
