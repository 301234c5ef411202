/// @file machine.h
/// Description of the machine, for reports.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace fx::cli {

struct Machine
{
    std::string cpu;        ///< model name, "unknown" when the system does not provide it
    int cores = 0;          ///< logical processors this process may use
    uint64_t memory = 0;    ///< [byte] of the machine
    std::string simd;       ///< widest instruction set, such as "AVX2"
    std::string glRenderer; ///< empty while no GL context was made
};

Machine readMachine();

/// Member "machine" of every --json line.
nlohmann::json toJson(const Machine& machine);

/// "Intel Xeon, 2 cores, AVX2; llvmpipe (LLVM 15.0.6)"
std::string toText(const Machine& machine);

} // namespace fx::cli
