/// @file gas_cases.h
/// The list of verification cases. For a new case, declare its make function here and add a line in
/// gas_cases.cpp.
#pragma once

#include "simulation/verification/gas_case.h"

#include <memory>
#include <span>
#include <string_view>

namespace fx::sim {

std::unique_ptr<GasCase> makeSodCase(const CaseSettings& settings);
std::unique_ptr<GasCase> makeSedovCase(const CaseSettings& settings);
std::unique_ptr<GasCase> makeNohCase(const CaseSettings& settings);
std::unique_ptr<GasCase> makeEvrardCase(const CaseSettings& settings);
std::unique_ptr<GasCase> makeKelvinHelmholtzCase(const CaseSettings& settings);
std::unique_ptr<GasCase> makeBlastWaveCase(const CaseSettings& settings);

struct GasCaseEntry
{
    std::string_view name;
    std::string_view summary;
    uint32_t particles; ///< number of particles if the user does not set one
    std::unique_ptr<GasCase> (*make)(const CaseSettings& settings);
};

std::span<const GasCaseEntry> gasCases();

/// Finds a case by name; null for an unknown name.
const GasCaseEntry* findGasCase(std::string_view name);

/// Creates a case. If the settings give no number of particles, the default number of the case is used.
std::unique_ptr<GasCase> makeGasCase(const GasCaseEntry& entry, CaseSettings settings);

} // namespace fx::sim
