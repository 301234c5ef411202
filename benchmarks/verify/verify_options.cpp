#include "benchmarks/verify/verify_options.h"

#include "benchmarks/measure/option_text.h"
#include "fxsdk/cli/support/machine.h"

#include <CLI/CLI.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace fx::cli {
namespace {

struct KernelName
{
    const char* name;
    sim::SphKernel kernel;
};
constexpr std::array<KernelName, 4> kKernels = {{{"wendland-c2", sim::SphKernel::WendlandC2},
                                                 {"wendland-c4", sim::SphKernel::WendlandC4},
                                                 {"cubic-spline", sim::SphKernel::CubicSpline},
                                                 {"quartic", sim::SphKernel::Quartic}}};

base::Status usage(const std::string& message)
{
    return {base::Code::InvalidArgument, message};
}

base::Status planKernel(const VerifyArguments& arguments, sim::SphKernel& out)
{
    std::vector<std::string> known;
    for (const KernelName& candidate : kKernels) {
        if (arguments.kernel == candidate.name) {
            out = candidate.kernel;
            return {};
        }
        known.emplace_back(candidate.name);
    }
    return unknownName("kernel", arguments.kernel, known);
}

base::Status planCase(const VerifyArguments& arguments, VerifyPlan& plan)
{
    plan.entry = sim::findGasCase(arguments.caseName);
    if (plan.entry != nullptr)
        return {};
    std::vector<std::string> known;
    for (const sim::GasCaseEntry& entry : sim::gasCases())
        known.emplace_back(entry.name);
    return unknownName("case", arguments.caseName, known);
}

base::Status checkNumbers(const VerifyArguments& arguments)
{
    if (!(arguments.neighbors >= 20 && arguments.neighbors <= 500))
        return usage("--neighbors: 20 to 500");
    if (!(arguments.courant > 0 && arguments.courant <= 1))
        return usage("--courant: more than 0, at most 1");
    if (!(arguments.gamma == 0 || (arguments.gamma > 1 && arguments.gamma < 7 && arguments.gamma != 2)))
        return usage("--gamma: more than 1, less than 7, not 2");
    if (!(arguments.time >= 0 && arguments.time <= 1e3))
        return usage("--time: more than 0, at most 1000 s");
    if (!(arguments.alphaMin >= 0 && arguments.alphaMin <= arguments.alphaMax && arguments.alphaMax <= 10))
        return usage("--alpha-min, --alpha-max: 0 to 10, ascending");
    if (!(arguments.conductivity >= 0 && arguments.conductivity <= 10))
        return usage("--conductivity: 0 to 10");
    if (!(arguments.alphaDecay >= 0 && arguments.alphaDecay <= 10))
        return usage("--alpha-decay: 0 to 10");
    if (!(arguments.beta >= 0 && arguments.beta <= 100))
        return usage("--beta: 0 to 100");
    if (arguments.threads > 1024)
        return usage("--threads: at most 1024");
    return {};
}

} // namespace

const char* kernelName(sim::SphKernel kernel)
{
    for (const KernelName& candidate : kKernels) {
        if (candidate.kernel == kernel)
            return candidate.name;
    }
    return "";
}

const char* stepsName(sim::StepScheme steps)
{
    return steps == sim::StepScheme::Global ? "global" : "block";
}

void addVerifyOptions(CLI::App& command, VerifyArguments& arguments)
{
    command.add_option("--particles", arguments.particles,
                       "How many, as 262144 or 64^3; the case's lattice takes the number that is nearest");
    command.add_option("--kernel", arguments.kernel, "wendland-c2, wendland-c4, cubic-spline or quartic")
        ->capture_default_str();
    command.add_option("--neighbors", arguments.neighbors, "4/3 pi n H^3, the neighbors within the support")
        ->capture_default_str();
    command.add_option("--steps", arguments.steps, "global or block")->capture_default_str();
    command.add_option("--precision", arguments.precision, "float or double")->capture_default_str();
    command.add_option("--threads", arguments.threads, "0 takes as many as there are")->capture_default_str();
    command.add_option("--time", arguments.time, "End of the run [s], 0 for the case's own")
        ->capture_default_str();
    command.add_option("--courant", arguments.courant, "Step in units of 2 h / signal speed")
        ->capture_default_str();
    command.add_option("--gamma", arguments.gamma, "Adiabatic exponent, 0 for the case's own")
        ->capture_default_str();
    command.add_option("--alpha-min", arguments.alphaMin, "Viscosity away from shocks")
        ->capture_default_str();
    command.add_option("--alpha-max", arguments.alphaMax, "Viscosity in shocks")->capture_default_str();
    command.add_option("--alpha-decay", arguments.alphaDecay, "How fast viscosity fades behind shocks [c/h]")
        ->capture_default_str();
    command.add_option("--beta", arguments.beta, "Speed of approach in the signal speed")
        ->capture_default_str();
    command.add_flag("--no-limiter", arguments.noLimiter, "Viscosity in shear as well");
    command.add_option("--conductivity", arguments.conductivity, "Exchange of heat at jumps")
        ->capture_default_str();
}

base::Result<VerifyPlan> planVerify(const VerifyArguments& arguments)
{
    VerifyPlan plan;
    sim::GasDynamicsDef& rules = plan.settings.rules;
    if (base::Status status = planCase(arguments, plan); !status)
        return status;
    if (base::Status status = planKernel(arguments, rules.kernel); !status)
        return status;
    if (base::Status status = checkNumbers(arguments); !status)
        return status;
    if (arguments.steps != "global" && arguments.steps != "block")
        return usage("--steps: global or block");
    if (arguments.precision != "float" && arguments.precision != "double")
        return usage("--precision: float or double");
    plan.settings.particles = particleCount(arguments.particles);
    if (!arguments.particles.empty() && plan.settings.particles < 512)
        return usage("--particles: 512 to 2^28, as 262144 or 64^3");

    rules.neighbors = arguments.neighbors;
    rules.courant = arguments.courant;
    rules.steps = arguments.steps == "global" ? sim::StepScheme::Global : sim::StepScheme::Block;
    rules.viscosity.alphaMin = arguments.alphaMin;
    rules.viscosity.alphaMax = arguments.alphaMax;
    rules.viscosity.decay = arguments.alphaDecay;
    rules.viscosity.beta = arguments.beta;
    rules.viscosity.limiter = !arguments.noLimiter;
    rules.viscosity.conductivity = arguments.conductivity;
    plan.settings.gamma = arguments.gamma;
    plan.settings.time = arguments.time;
    plan.doublePrecision = arguments.precision == "double";
    plan.threads = arguments.threads > 0 ? arguments.threads : uint32_t(readMachine().cores);
    return plan;
}

} // namespace fx::cli
