#include "engine_sim/figures/maps_command.h"
namespace ehm::engine {
void add_maps_command(CLI::App&, std::function<void(std::ostream&, std::ostream&)>&) {}
}  // namespace ehm::engine
