#include "benchmarks/measure/calibration.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <vector>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRepetitions = 3; ///< of which the fastest counts
constexpr int kChain = 2'000'000;
constexpr size_t kCopyBytes = size_t(64) << 20;

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double chainSeconds()
{
    const Clock::time_point start = Clock::now();
    volatile double seed = 1.0;
    double x = seed;
    for (int i = 0; i < kChain; ++i)
        x = x * 0.999999 + 1e-6;
    seed = x; // the chain must have been computed
    return secondsSince(start);
}

} // namespace

Calibration calibrate()
{
    double chain = std::numeric_limits<double>::infinity();
    double copy = std::numeric_limits<double>::infinity();
    std::vector<char> from(kCopyBytes, 1);
    std::vector<char> to(kCopyBytes, 2);
    for (int i = 0; i < kRepetitions; ++i) {
        chain = std::min(chain, chainSeconds());
        const Clock::time_point start = Clock::now();
        std::memcpy(to.data(), from.data(), kCopyBytes);
        copy = std::min(copy, secondsSince(start));
        from[0] = to[kCopyBytes - 1];
    }
    return {chain / kChain * 1e9, 2e-9 * double(kCopyBytes) / copy};
}

nlohmann::json toJson(const Calibration& calibration)
{
    return {{"multiply_add_ns", calibration.multiplyAddNanoseconds},
            {"copy_gb_per_s", calibration.copyGigabytes}};
}

} // namespace fx::cli
