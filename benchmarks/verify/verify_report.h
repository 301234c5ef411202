/// @file verify_report.h
/// The results of a verification case, as text and as JSON.
#pragma once

#include "benchmarks/verify/verify_options.h"
#include "simulation/verification/case_run.h"

#include <nlohmann/json.hpp>

#include <string>

namespace fx::cli {

/// The fields of a --json line except machine and version. Values that were not measured are null.
nlohmann::json toJson(const VerifyPlan& plan, const sim::CaseReport& report);

/// A table for the terminal.
std::string toText(const VerifyPlan& plan, const sim::CaseReport& report);

/// One row per particle: r[m],rho[kg/m3],v[m/s],p[Pa].
std::string profileCsv(const sim::CaseReport& report);

bool limitsHold(const sim::CaseReport& report);

double nanosecondsPerParticleStep(const sim::CaseReport& report);
double nanosecondsPerPair(const sim::CaseReport& report);

/// The number, or null if it is not finite.
nlohmann::json numberOrNull(double value);

} // namespace fx::cli
