#include "simulation/emitters/birth_schedule.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr uint64_t kMostBirths = uint64_t(1) << 62;
constexpr WideInt kParticle = WideInt(base::kTicksPerSecond) << 32; // D

/// Ticks of a time that may be anything a float can be: NaN and negative become 0, too long becomes kForever.
base::Ticks boundedTicks(double seconds)
{
    if (!(seconds > 0.0))
        return 0;
    return seconds < 1e9 ? base::toTicks(seconds) : kForever;
}

WideInt ceilDivide(WideInt numerator, WideInt denominator)
{
    return numerator > 0 ? (numerator + denominator - 1) / denominator : 0;
}

WideInt ratePerTick(double rate)
{
    const double bounded = rate > 0.0 ? std::min(rate, 1e9) : 0.0;
    return WideInt(uint64_t(bounded * 4294967296.0 + 0.5)); // q
}

uint32_t scaledCount(uint32_t count, double intensity)
{
    const double scaled = intensity > 0.0 ? double(count) * intensity : 0.0;
    return uint32_t(std::min(scaled + 0.5, 4294967295.0));
}

} // namespace

/// Numbers births and keeps those there is room for.
struct BirthSchedule::Writer
{
    std::span<Birth> out;
    uint64_t& nextIndex;
    BirthCount count;

    template <class TickOf>
    void add(uint64_t births, TickOf tickOf)
    {
        for (uint64_t j = 0; j < births && count.stored < out.size(); ++j)
            out[count.stored++] = {nextIndex + j, tickOf(j)};
        nextIndex += births;
        count.total += births;
    }
};

BirthSchedule::BirthSchedule(const Emission& emission, std::pmr::memory_resource* memory)
    : rate_(emission.rate), start_(boundedTicks(emission.start)),
      end_(start_ + boundedTicks(emission.duration)), bursts_(memory)
{
    bursts_.reserve(emission.bursts.size());
    for (const Burst& burst : emission.bursts) {
        const ScheduledBurst scheduled{start_ + boundedTicks(burst.time), burst.count};
        const auto later = std::upper_bound(
            bursts_.begin(), bursts_.end(), scheduled,
            [](const ScheduledBurst& a, const ScheduledBurst& b) { return a.tick < b.tick; });
        bursts_.insert(later, scheduled);
    }
}

void BirthSchedule::setPhase(float phase)
{
    progress_ = -(WideInt(int64_t(double(phase) * 16777216.0)) * (kParticle >> 24));
}

BirthCount BirthSchedule::advance(const BirthWindow& window, std::span<Birth> out)
{
    const WideInt perTick = window.emitting ? ratePerTick(double(rate_) * window.intensity) : 0;
    const base::Ticks begin = std::clamp(start_, window.begin, window.end);
    const base::Ticks end = std::clamp(end_, begin, window.end);
    uint64_t given = 0; // rate births of this window so far
    Writer writer{out, nextIndex_, {}};

    const auto giveRateUntil = [&](base::Ticks tick) {
        const WideInt ticks = std::clamp(tick, begin, end) - begin;
        const uint64_t due = uint64_t(ceilDivide(progress_ + perTick * ticks, kParticle)); // (3)
        if (due <= given)
            return;
        const uint64_t first = given;
        writer.add(due - first, [&](uint64_t j) {
            return begin + base::Ticks((WideInt(first + j) * kParticle - progress_) / perTick); // (4)
        });
        given = due;
    };

    for (; nextBurst_ < bursts_.size() && bursts_[nextBurst_].tick < window.end; ++nextBurst_) {
        const ScheduledBurst& burst = bursts_[nextBurst_];
        giveRateUntil(burst.tick);
        if (window.emitting)
            writer.add(scaledCount(burst.count, window.intensity), [&](uint64_t) { return burst.tick; });
    }
    giveRateUntil(end);
    progress_ += perTick * (end - begin) - WideInt(given) * kParticle;
    return writer.count;
}

void BirthSchedule::save(StateWriter& writer) const
{
    const WideInt waiting = -progress_; // 0 <= -R < D < 2^62
    writer.value(uint64_t(nextBurst_));
    writer.value(uint64_t(waiting));
    writer.value(nextIndex_);
}

void BirthSchedule::restore(StateReader& reader)
{
    nextBurst_ = size_t(reader.value<uint64_t>(0, bursts_.size(), "an emitter has fewer bursts"));
    progress_ = -WideInt(reader.value<uint64_t>(0, uint64_t(kParticle) - 1, "a birth is overdue"));
    nextIndex_ = reader.value<uint64_t>(0, kMostBirths, "an emitter's births are out of range");
}

bool BirthSchedule::exhausted(base::Ticks tick) const
{
    return nextBurst_ == bursts_.size() && (!(rate_ > 0.0f) || tick >= end_);
}

} // namespace fx::sim
