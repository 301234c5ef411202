/// @file verify_options.h
/// The options of verification cases, as text and as settings.
#pragma once

#include "foundation/result/status.h"
#include "simulation/verification/gas_cases.h"

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fx::cli {

struct VerifyArguments
{
    std::string caseName;
    std::string particles; ///< number such as "262144" or "64^3"; empty: default of the case
    std::string kernel = "wendland-c2";
    std::string steps = "block";
    std::string precision = "float";
    double neighbors = 58;
    double courant = sim::GasDynamicsDef().courant;
    double gamma = 0;
    double time = 0;
    uint32_t threads = 0;
    double alphaMin = sim::ViscosityRules().alphaMin;
    double alphaMax = sim::ViscosityRules().alphaMax;
    double alphaDecay = sim::ViscosityRules().decay;
    double beta = sim::ViscosityRules().beta;
    bool noLimiter = !sim::ViscosityRules().limiter;
    double conductivity = sim::ViscosityRules().conductivity;
    std::string csv;
    bool check = false;
    bool json = false;
};

struct VerifyPlan
{
    const sim::GasCaseEntry* entry = nullptr;
    sim::CaseSettings settings;
    bool doublePrecision = false;
    uint32_t threads = 1;
};

void addVerifyOptions(CLI::App& command, VerifyArguments& arguments);

/// Converts and checks the options. @return InvalidArgument naming the option and its values
base::Result<VerifyPlan> planVerify(const VerifyArguments& arguments);

const char* kernelName(sim::SphKernel kernel);
const char* stepsName(sim::StepScheme steps);

} // namespace fx::cli
