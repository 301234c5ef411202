#include "simulation/emitters/births/birth_schedule.h"

#include "foundation/random/philox.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

using base::Ticks;

constexpr uint64_t kMaxBirths = uint64_t(1) << 62;
constexpr WideInt kParticle = WideInt(base::kTicksPerSecond) << 32; // D of a constant rate
constexpr WideInt kLowestEven = WideInt(1 << 22);                   // q of a rate of 1e-3 /s
constexpr int kFineBits = 16;                                       // more in D of a rate that changes
constexpr Ticks kLongestCurve = 1'000'000 * base::kTicksPerSecond;
constexpr Ticks kSegments = Ticks(base::kCurveSamples);

/// Ticks of a time that may be anything a float can be: NaN and negative become 0, too long becomes kForever.
Ticks boundedTicks(double seconds)
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

bool isConstant(const base::ScalarCurve& curve)
{
    for (size_t i = 0; i <= base::kCurveSamples; ++i)
        if (curve.at(float(i) / float(base::kCurveSamples))[0] != curve.at(0.0f)[0])
            return false;
    return true;
}

} // namespace

/// Numbers births and keeps those there is room for.
struct BirthSchedule::Writer
{
    const Outlet& outlet;
    uint64_t& nextIndex;
    BirthCount count{};
    size_t waiting = 0; ///< births in the room

    /// @param nextTick called once for each birth that is wanted, in order
    template <class NextTick>
    void add(uint64_t births, NextTick nextTick)
    {
        const uint64_t wanted = std::min(births, outlet.most - count.stored);
        for (uint64_t j = 0; j < wanted; ++j) {
            outlet.room[waiting++] = {nextIndex + j, nextTick()};
            if (waiting == outlet.room.size() && outlet.take)
                flush();
        }
        count.stored += wanted;
        nextIndex += births;
        count.total += births;
    }
    /// Births that may still be stored in this call, of those for which there is any use.
    uint64_t left() const { return outlet.wanted - std::min(outlet.wanted, count.stored); }
    /// True when the call is to end: those that come would be stored.
    bool isFull() const { return left() == 0 && count.stored < outlet.most; }
    /// How many of `births` are added now: all, if those that are too many need not be stored.
    uint64_t share(uint64_t births) const
    {
        return outlet.most - count.stored <= left() ? births : std::min(births, left());
    }
    void flush()
    {
        if (outlet.take && waiting > 0)
            outlet.take(outlet.user, outlet.room.first(waiting));
        waiting = 0;
    }
};

namespace {

/// The ticks of births at a constant rate, one after another: a quotient that grows by a constant, kept as
/// whole and rest, so that nothing is divided.
class EvenTicks
{
public:
    /// Tick j is floor((first + j * step) / rate).
    EvenTicks(WideInt first, WideInt step, WideInt rate)
        : tick_(Ticks(first / rate)), rest_(first % rate), stride_(Ticks(step / rate)), more_(step % rate),
          rate_(rate)
    {}
    Ticks next()
    {
        const Ticks tick = tick_;
        tick_ += stride_;
        rest_ += more_;
        if (rest_ >= rate_) {
            rest_ -= rate_;
            ++tick_;
        }
        return tick;
    }

private:
    Ticks tick_;
    WideInt rest_;
    Ticks stride_;
    WideInt more_;
    WideInt rate_;
};

} // namespace

WideInt BirthSchedule::Piece::sum(Ticks n) const
{
    return rate * n + slope * n * (n - 1) / 2; // (3)
}

Ticks BirthSchedule::Piece::tickOf(WideInt wanted) const
{
    if (slope == 0)
        return Ticks(wanted / rate);
    // A guess by doubles, which only says where the search for the largest n with S(n) <= wanted begins.
    const double q = double(rate) - 0.5 * double(slope), m = double(slope), s = double(wanted);
    const double divisor = q + std::sqrt(std::max(q * q + 2.0 * m * s, 0.0));
    const Ticks last = end - begin - 1;
    const double guess = divisor > 0.0 ? 2.0 * s / divisor : 0.0;
    Ticks low = Ticks(std::clamp(guess, 0.0, double(last)));
    Ticks high = low + 1;
    for (Ticks step = 1; low > 0 && sum(low) > wanted; step *= 2) {
        high = low;
        low = std::max<Ticks>(low - step, 0);
    }
    for (Ticks step = 1; high <= last && sum(high) <= wanted; step *= 2) {
        low = high;
        high = std::min(high + step, last + 1);
    }
    while (high - low > 1) {
        const Ticks middle = low + (high - low) / 2;
        (sum(middle) <= wanted ? low : high) = middle;
    }
    return low;
}

BirthSchedule::BirthSchedule(const Emission& emission, std::pmr::memory_resource* memory)
    : rate_(emission.rate), start_(boundedTicks(emission.start)),
      end_(start_ + boundedTicks(emission.duration)), shape_(emission.rateOverTime),
      curved_(end_ - start_ <= kLongestCurve && !isConstant(emission.rateOverTime)), bursts_(memory)
{
    bursts_.reserve(emission.bursts.size());
    for (const Burst& burst : emission.bursts) {
        const Ticks interval = boundedTicks(burst.interval);
        const Ticks first = start_ + boundedTicks(burst.time);
        uint64_t cycles = interval > 0 ? burst.cycles : std::min(burst.cycles, 1u);
        if (burst.cycles == 0) // for ever
            cycles = interval > 0 && end_ > first ? uint64_t((end_ - first - 1) / interval) + 1 : 1;
        if (interval > 0) // never later than kForever
            cycles = std::min(cycles, uint64_t((kForever - std::min(first, kForever)) / interval) + 1);
        bursts_.push_back({first, interval, cycles, burst.count, burst.probability});
    }
}

WideInt BirthSchedule::particle() const
{
    return curved_ ? kParticle << kFineBits : kParticle;
}

void BirthSchedule::setPhase(float phase)
{
    progress_ = -(WideInt(int64_t(double(phase) * 16777216.0)) * (particle() >> 24));
}

void BirthSchedule::setSeed(uint64_t seed, uint32_t solverIndex)
{
    seed_ = seed;
    solverIndex_ = solverIndex;
}

/// The rate from `tick` on, until it bends or `end` comes.
BirthSchedule::Piece BirthSchedule::pieceAt(Ticks tick, Ticks end, const BirthWindow& window) const
{
    const double rate = window.emitting ? double(rate_) * window.intensity : 0.0;
    if (!curved_)
        return {tick, end, ratePerTick(rate * double(shape_.at(0.0f)[0])), 0};
    const Ticks duration = end_ - start_;
    const auto borderOf = [&](Ticks i) { return start_ + Ticks(WideInt(duration) * i / kSegments); };
    Ticks segment = std::min(Ticks(WideInt(tick - start_) * kSegments / duration), kSegments - 1);
    while (segment + 1 < kSegments && borderOf(segment + 1) <= tick)
        ++segment;
    const Ticks from = borderOf(segment), to = borderOf(segment + 1);
    const auto rateAt = [&](Ticks i) {
        return ratePerTick(rate * double(shape_.at(float(i) / float(kSegments))[0])) << kFineBits;
    };
    const WideInt slope = (rateAt(segment + 1) - rateAt(segment)) / (to - from);
    return {tick, std::min(to, end), rateAt(segment) + slope * (tick - from), slope}; // (5)
}

/// @return where it ended: at `to`, or before it when as many are born as are wanted
Ticks BirthSchedule::giveRate(Ticks from, Ticks to, const BirthWindow& window, Writer& writer)
{
    const WideInt one = particle();
    while (from < to && !writer.isFull()) {
        Piece piece = pieceAt(from, to, window);
        WideInt sum = piece.sum(piece.end - piece.begin);
        uint64_t due = uint64_t(ceilDivide(progress_ + sum, one));
        if (const uint64_t share = writer.share(due); share < due) {
            const Ticks part = Ticks(WideInt(piece.end - piece.begin) * WideInt(share) / WideInt(due));
            piece.end = piece.begin + std::max<Ticks>(part, 1);
            sum = piece.sum(piece.end - piece.begin);
            due = uint64_t(ceilDivide(progress_ + sum, one));
        }
        const WideInt before = progress_;
        if (due > 0 && piece.slope == 0) {
            if (log_)
                log_->addRate(nextIndex_, due, piece.begin, -before, one, piece.rate);
            EvenTicks ticks(-before, one, piece.rate); // (4)
            writer.add(due, [&] { return piece.begin + ticks.next(); });
        } else {
            WideInt sought = -before;
            writer.add(due, [&] {
                const Ticks tick = piece.begin + piece.tickOf(sought);
                sought += one;
                return tick;
            });
        }
        progress_ += sum - WideInt(due) * one;
        from = piece.end;
    }
    return from;
}

/// @return whether all births of the cycle are given
bool BirthSchedule::giveBurst(ScheduledBurst& burst, const BirthWindow& window, Writer& writer)
{
    if (window.emitting && happens(burst)) {
        const Ticks tick = burst.nextTick();
        const uint32_t count = scaledCount(burst.count, window.intensity);
        const uint64_t share = writer.share(count - burst.given);
        if (log_ && burst.given == 0)
            log_->addBurst(nextIndex_, count, tick);
        writer.add(share, [&] { return tick; });
        burst.given += uint32_t(share);
        if (burst.given < count)
            return false;
    }
    burst.given = 0;
    ++burst.next;
    return true;
}

/// The burst whose next cycle comes first, before `end`; null when there is none.
BirthSchedule::ScheduledBurst* BirthSchedule::nextBurst(Ticks end)
{
    ScheduledBurst* first = nullptr;
    for (ScheduledBurst& burst : bursts_)
        if (burst.nextTick() < end && (!first || burst.nextTick() < first->nextTick()))
            first = &burst;
    return first;
}

bool BirthSchedule::happens(const ScheduledBurst& burst) const
{
    if (burst.probability >= 1.0f)
        return true;
    const uint64_t number = uint64_t(&burst - bursts_.data());
    const uint64_t event = (number << 48) ^ burst.next;
    return base::randomUnit4(seed_, solverIndex_, event, base::RandomPurpose::Bursts)[0] < burst.probability;
}

BirthCount BirthSchedule::advance(const BirthWindow& window, std::span<Birth> out)
{
    Ticks end;
    return advanceTo(window, {out, out.size(), nullptr, nullptr}, end);
}

/// True when the window has no births; the window is recorded.
bool BirthSchedule::staysQuiet(const BirthWindow& window)
{
    const bool quiet = window.end <= quiet_.until && window.begin == quiet_.to &&
                       window.intensity == quiet_.intensity && window.emitting == quiet_.emitting;
    if (quiet)
        quiet_.to = window.end;
    return quiet;
}

void BirthSchedule::endQuiet()
{
    progress_ += quiet_.rate * (quiet_.to - quiet_.from); // (3)
    quiet_ = {};
}

/// Finds the time without births after the end of the window.
void BirthSchedule::findQuiet(const BirthWindow& window)
{
    if (curved_ || window.end < start_ || window.end >= end_)
        return;
    const WideInt rate = pieceAt(window.end, end_, window).rate;
    Ticks until = end_;
    if (rate > 0 && -progress_ / rate < WideInt(end_ - window.end)) // (6)
        until = window.end + Ticks(-progress_ / rate);
    for (const ScheduledBurst& burst : bursts_)
        until = std::min(until, burst.nextTick());
    quiet_ = {window.end, window.end, until, window.intensity, window.emitting, rate};
}

BirthCount BirthSchedule::advanceTo(const BirthWindow& window, const Outlet& outlet, Ticks& outReached)
{
    outReached = window.end;
    if (staysQuiet(window))
        return {};
    endQuiet();
    Ticks at = std::clamp(start_, window.begin, window.end);
    const Ticks end = std::clamp(end_, at, window.end);
    Writer writer{outlet, nextIndex_};
    bool isThrough = true; // with what is before `end`, or before the burst in hand
    while (ScheduledBurst* const burst = nextBurst(window.end)) {
        const Ticks tick = burst->nextTick();
        const Ticks until = std::clamp(tick, at, end);
        at = giveRate(at, until, window, writer);
        isThrough = at == until;
        if (isThrough && giveBurst(*burst, window, writer))
            continue;
        outReached = isThrough ? tick : at;
        isThrough = false;
        break;
    }
    if (isThrough)
        at = giveRate(at, end, window, writer);
    if (isThrough && at < end)
        outReached = at;
    writer.flush();
    findQuiet({window.begin, outReached, window.intensity, window.emitting});
    return writer.count;
}

void BirthSchedule::save(StateWriter& writer, base::Ticks now) const
{
    const base::Ticks to = now > quiet_.to && now <= quiet_.until ? now : quiet_.to;
    const WideInt waiting = -progress_ - quiet_.rate * (to - quiet_.from); // 0 <= -R < D < 2^78
    writer.value(uint64_t(waiting >> 32));
    writer.value(uint64_t(waiting & 0xFFFFFFFF));
    writer.value(nextIndex_);
    for (const ScheduledBurst& burst : bursts_)
        writer.value(burst.next);
}

void BirthSchedule::restore(StateReader& reader)
{
    const uint64_t most = uint64_t((particle() - 1) >> 32);
    const uint64_t high = reader.value<uint64_t>(0, most, "a birth is overdue");
    const uint64_t low = reader.value<uint64_t>(0, 0xFFFFFFFFu, "a birth is overdue");
    progress_ = -((WideInt(high) << 32) + WideInt(low));
    quiet_ = {};
    nextIndex_ = reader.value<uint64_t>(0, kMaxBirths, "an emitter's births are out of range");
    for (ScheduledBurst& burst : bursts_)
        burst.next = reader.value<uint64_t>(0, burst.cycles, "a burst has fewer cycles");
}

std::optional<EvenBirths> BirthSchedule::evenBirths(Ticks tick, double intensity, bool emitting) const
{
    if (curved_ || log_ || !bursts_.empty() || tick < start_ || tick >= end_)
        return std::nullopt;
    const WideInt rate = pieceAt(tick, end_, {tick, end_, intensity, emitting}).rate;
    if (rate < kLowestEven)
        return std::nullopt;
    const Ticks to = tick > quiet_.to && tick <= quiet_.until ? tick : quiet_.to;
    const WideInt waiting = -progress_ - quiet_.rate * (to - quiet_.from);
    EvenBirths births;
    births.tick = tick + Ticks(waiting / rate);
    births.rest = uint64_t(waiting % rate);
    births.stride = Ticks(kParticle / rate);
    births.more = uint64_t(kParticle % rate);
    births.rate = uint64_t(rate);
    return births;
}

bool BirthSchedule::exhausted(Ticks tick) const
{
    const bool noBursts = std::all_of(bursts_.begin(), bursts_.end(),
                                      [](const ScheduledBurst& b) { return b.next == b.cycles; });
    return noBursts && (!(rate_ > 0.0f) || tick >= end_);
}

Ticks BirthSchedule::quietUntil(Ticks tick, double intensity, bool emitting) const
{
    Ticks until = kForever;
    for (const ScheduledBurst& burst : bursts_)
        until = std::min(until, burst.nextTick());
    if (!(rate_ > 0.0f) || tick >= end_)
        return until;
    if (tick < start_)
        return std::min(until, start_);
    const bool isKnown = tick >= quiet_.to && tick <= quiet_.until && quiet_.intensity == intensity &&
                         quiet_.emitting == emitting;
    return isKnown ? std::min(until, quiet_.until) : tick;
}

} // namespace fx::sim
