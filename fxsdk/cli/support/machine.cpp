#include "fxsdk/cli/support/machine.h"

#include <hwy/targets.h>

#include <bit>
#include <fstream>
#include <sched.h>
#include <unistd.h>

namespace fx::cli {
namespace {

std::string cpuName()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
            return line.substr(colon + 2);
    }
    return "unknown";
}

int usableCores()
{
    cpu_set_t set;
    CPU_ZERO(&set);
    return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

/// Highway's targets: the better one has the lower bit.
std::string simdName()
{
    const uint64_t targets = uint64_t(hwy::SupportedTargets());
    return targets == 0 ? "none" : hwy::TargetName(int64_t(targets & ~(targets - 1)));
}

} // namespace

Machine readMachine()
{
    Machine machine;
    machine.cpu = cpuName();
    machine.cores = usableCores();
    machine.memory = uint64_t(sysconf(_SC_PHYS_PAGES)) * uint64_t(sysconf(_SC_PAGE_SIZE));
    machine.simd = simdName();
    return machine;
}

nlohmann::json toJson(const Machine& machine)
{
    nlohmann::json json = {{"cpu", machine.cpu},
                           {"cores", machine.cores},
                           {"memory_bytes", machine.memory},
                           {"simd", machine.simd}};
    if (!machine.glRenderer.empty())
        json["gl_renderer"] = machine.glRenderer;
    return json;
}

std::string toText(const Machine& machine)
{
    std::string text = machine.cpu + ", " + std::to_string(machine.cores) + " cores, " + machine.simd;
    return machine.glRenderer.empty() ? text : text + "; " + machine.glRenderer;
}

} // namespace fx::cli
