/// @file machine.h
/// Description of the machine, for reports.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace fx::cli {

struct Machine
{
    std::string cpu;        ///< model name of the processor; "unknown" when the system does not provide it
    int cores = 0;          ///< number of logical processors that this process may use
    uint64_t memory = 0;    ///< [byte] memory of the machine
    std::string simd;       ///< name of the widest instruction set, such as "AVX2"
    std::string glRenderer; ///< name of the GL renderer; empty if no GL context was created
};

Machine readMachine();

/// Converts the description to the member "machine" of every --json line.
nlohmann::json toJson(const Machine& machine);

/// Formats the description: "Intel Xeon, 2 cores, AVX2; llvmpipe (LLVM 15.0.6)".
std::string toText(const Machine& machine);

} // namespace fx::cli
