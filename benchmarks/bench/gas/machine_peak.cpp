#include "benchmarks/bench/gas/machine_peak.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "benchmarks/bench/gas/machine_peak.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "benchmarks/measure/clocks.h"
#include "foundation/simd/instruction_set.h"

#include <hwy/highway.h>

#include <algorithm>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace fx::cli::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Eight chains that do not wait for each other: a product and a sum each, in turn. @return operations
template <class T>
double calculate(size_t rounds, T& ioValue)
{
    const hn::ScalableTag<T> tag;
    const auto factor = hn::Set(tag, T(0.999));
    const auto term = hn::Set(tag, ioValue);
    auto a = term, b = term, c = term, d = term, e = term, f = term, g = term, h = term;
    for (size_t k = 0; k < rounds; ++k) {
        a = hn::Add(hn::Mul(a, factor), term);
        b = hn::Add(hn::Mul(b, factor), term);
        c = hn::Add(hn::Mul(c, factor), term);
        d = hn::Add(hn::Mul(d, factor), term);
        e = hn::Add(hn::Mul(e, factor), term);
        f = hn::Add(hn::Mul(f, factor), term);
        g = hn::Add(hn::Mul(g, factor), term);
        h = hn::Add(hn::Mul(h, factor), term);
    }
    const auto sum = hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, d)), hn::Add(hn::Add(e, f), hn::Add(g, h)));
    ioValue = hn::GetLane(sum) * T(1e-30);
    return 16.0 * double(rounds) * double(hn::Lanes(tag));
}

double calculateFloats(size_t rounds, float& ioValue)
{
    return calculate<float>(rounds, ioValue);
}
double calculateDoubles(size_t rounds, double& ioValue)
{
    return calculate<double>(rounds, ioValue);
}

/// Reads `count` floats, a multiple of four vectors.
float readAll(const float* from, size_t count)
{
    const hn::ScalableTag<float> tag;
    const size_t lanes = hn::Lanes(tag);
    auto a = hn::Zero(tag), b = a, c = a, d = a;
    for (size_t k = 0; k < count; k += 4 * lanes) {
        a = hn::Max(a, hn::LoadU(tag, from + k));
        b = hn::Max(b, hn::LoadU(tag, from + k + lanes));
        c = hn::Max(c, hn::LoadU(tag, from + k + 2 * lanes));
        d = hn::Max(d, hn::LoadU(tag, from + k + 3 * lanes));
    }
    return hn::GetLane(hn::Max(hn::Max(a, b), hn::Max(c, d)));
}

} // namespace
} // namespace fx::cli::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::cli {

namespace {

HWY_EXPORT(calculateFloats);
HWY_EXPORT(calculateDoubles);
HWY_EXPORT(readAll);

/// Largest amount a second of several runs of f, which returns an amount.
template <class F>
double bestRate(F&& f)
{
    double best = 0;
    for (int run = 0; run < 9; ++run) {
        const double begin = threadSeconds();
        const double amount = f();
        best = std::max(best, amount / std::max(threadSeconds() - begin, 1e-9));
    }
    return best;
}

/// [B/s] @param times that the whole buffer is read in a run
double readRate(const std::vector<float>& buffer, int times)
{
    volatile float kept = 0;
    return bestRate([&] {
        for (int k = 0; k < times; ++k)
            kept = kept + HWY_DYNAMIC_DISPATCH(readAll)(buffer.data(), buffer.size());
        return double(times) * double(buffer.size() * sizeof(float));
    });
}

} // namespace

MachinePeak measureMachinePeak()
{
    constexpr size_t kRounds = 2'000'000;
    base::applyInstructionSetLimit();
    volatile float keptFloat = 1e-6f;
    volatile double keptDouble = 1e-6;
    MachinePeak peak{};
    peak.floatFlops = bestRate([&] {
        float value = keptFloat;
        const double done = HWY_DYNAMIC_DISPATCH(calculateFloats)(kRounds, value);
        keptFloat = value + 1e-6f;
        return done;
    });
    peak.doubleFlops = bestRate([&] {
        double value = keptDouble;
        const double done = HWY_DYNAMIC_DISPATCH(calculateDoubles)(kRounds, value);
        keptDouble = value + 1e-6;
        return done;
    });
    peak.nearBytes = readRate(std::vector<float>(size_t(1) << 18, 1.0f), 64);
    peak.farBytes = readRate(std::vector<float>(size_t(1) << 26, 1.0f), 1);
    return peak;
}

} // namespace fx::cli
#endif
