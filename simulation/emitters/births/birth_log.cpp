#include "simulation/emitters/births/birth_log.h"

#include <algorithm>

namespace fx::sim {

namespace {

using base::Ticks;

constexpr uint64_t kMaxRunBirths = uint64_t(1) << 31; // so that numbers within a run have 32 bits
constexpr WideWord kWhole = WideWord(1) << 96;

/// value / divisor for value < divisor < 2^78, rounded up to a multiple of 2^-96.
WideWord fractionOf(WideInt value, WideInt divisor)
{
    WideWord digits = 0;
    WideInt rest = value;
    for (int digit = 0; digit < 6; ++digit) { // 16 bits at a time
        rest <<= 16;
        digits = (digits << 16) | WideWord(rest / divisor);
        rest %= divisor;
    }
    return digits + (rest > 0 ? 1 : 0);
}

} // namespace

bool BirthLog::goesOn(const Run& run, uint64_t first, Ticks begin, WideInt sought, WideInt one,
                      WideInt rate) const
{
    if (run.rate != rate || run.one != one || run.first + run.count != first || run.count >= kMaxRunBirths)
        return false;
    return sought == run.sought - rate * (begin - run.begin) + WideInt(run.count) * one;
}

void BirthLog::addRate(uint64_t first, uint64_t count, Ticks begin, WideInt sought, WideInt one, WideInt rate)
{
    while (count > 0) {
        if (runs_.empty() || !goesOn(runs_.back(), first, begin, sought, one, rate))
            runs_.push_back({first, 0, begin + Ticks(sought / rate), Ticks(one / rate),
                             fractionOf(one % rate, rate), fractionOf(sought % rate, rate), begin, sought,
                             one, rate});
        Run& run = runs_.back();
        const uint64_t taken = std::min(count, kMaxRunBirths - run.count);
        run.count += taken;
        first += taken;
        count -= taken;
        sought += WideInt(taken) * one;
    }
    next_ = first;
}

void BirthLog::addBurst(uint64_t first, uint64_t count, Ticks tick)
{
    if (count > 0)
        runs_.push_back({first, count, tick, 0, 0, 0, tick, 0, 0, 0});
    next_ = first + count;
}

void BirthLog::clear(uint64_t next)
{
    runs_.clear();
    front_ = next_ = next;
}

void BirthLog::forget(Ticks tick)
{
    size_t gone = 0;
    while (gone < runs_.size() && runs_[gone].last() < tick)
        ++gone;
    runs_.erase(runs_.begin(), runs_.begin() + std::ptrdiff_t(gone));
    if (runs_.empty()) {
        front_ = next_;
        return;
    }
    const Run& run = runs_.front();
    uint64_t low = std::max(front_, run.first) - run.first; // ticks ascend
    uint64_t high = run.count - 1;
    while (low < high) {
        const uint64_t middle = low + (high - low) / 2;
        if (run.at(middle) < tick)
            low = middle + 1;
        else
            high = middle;
    }
    front_ = run.first + low;
}

size_t BirthLog::runOf(uint64_t index) const
{
    const auto after = std::upper_bound(runs_.begin(), runs_.end(), index,
                                        [](uint64_t i, const Run& run) { return i < run.first; });
    return size_t(after - runs_.begin()) - 1;
}

Ticks BirthLog::tickOf(uint64_t index) const
{
    const Run& run = runs_[runOf(index)];
    return run.at(index - run.first);
}

void BirthLog::ticksOf(uint64_t first, std::span<Ticks> out) const
{
    size_t r = out.empty() ? 0 : runOf(first);
    for (size_t i = 0; i < out.size(); ++i) {
        while (first + i >= runs_[r].first + runs_[r].count)
            ++r;
        out[i] = runs_[r].at(first + i - runs_[r].first);
    }
}

void BirthLog::publish(Ticks now, std::span<base::GpuBirthRun> out) const
{
    for (size_t i = 0; i < runs_.size(); ++i) {
        const Run& run = runs_[i];
        const uint64_t begun = std::max(front_, run.first) - run.first; // (3) of birth-runs
        const WideWord sum = run.rest + WideWord(begun) * run.fraction;
        base::GpuBirthRun& o = out[i];
        o.reach = uint32_t(std::min<uint64_t>(next_ - run.first - begun, ~0u));
        o.unused = 0;
        o.age = now - run.at(begun);
        o.stride = run.stride;
        const WideWord rest = sum % kWhole;
        for (int w = 0; w < 3; ++w) {
            o.fraction[w] = uint32_t(run.fraction >> (32 * w));
            o.rest[w] = uint32_t(rest >> (32 * w));
        }
    }
}

} // namespace fx::sim
