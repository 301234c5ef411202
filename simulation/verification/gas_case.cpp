#include "simulation/verification/gas_case.h"

namespace fx::sim {

void GasCase::look(double, std::span<const CaseParticle>) {}

} // namespace fx::sim
