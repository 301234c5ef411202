#include "fxsdk/scene/whereabouts.h"

#include "simulation/emitters/emitter_def.h"
#include "simulation/run_clock.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::scene {

namespace {

constexpr float kSpare = 0.25f; ///< [s] more than steps, and what trails keep for frames between them

void add(const sim::EmitterDef& emitter, Memory& io)
{
    io.seconds += emitter.lifetime.max + emitter.trail.lifetime + kSpare; // one may cause births in another
    if (!emitter.inWorld || !(emitter.inheritVelocity > 0.0f))
        return;
    io.inherits = std::max(io.inherits, emitter.inheritVelocity);
    io.extent =
        std::max(io.extent, emitter.births ? emitter.births->extent()
                                           : glm::length(emitter.position) + glm::length(emitter.size));
    io.drawnOut = std::max(io.drawnOut, emitter.shutter + 0.5f * emitter.look.stretch);
}

} // namespace

Memory memoryOf(const sim::EffectDef& effect)
{
    Memory memory;
    for (const auto& solver : effect.solvers) {
        if (const auto* emitter = dynamic_cast<const sim::EmitterDef*>(solver.get()))
            add(*emitter, memory);
        else // nobody says for how long it lives
            memory.seconds = std::numeric_limits<float>::infinity();
    }
    return memory;
}

void Circumstances::add(const Circumstances& more)
{
    low = glm::min(low, more.low);
    high = glm::max(high, more.high);
    smallest = std::min(smallest, more.smallest);
    largest = std::max(largest, more.largest);
    wind = std::max(wind, more.wind);
    localWind = std::max(localWind, more.localWind);
    speed = std::max(speed, more.speed);
    slowest = std::min(slowest, more.slowest);
}

void Whereabouts::note(base::Ticks now, const Circumstances& is, float seconds)
{
    const double passed = base::toSeconds(std::max<base::Ticks>(now - begun_, 0)) *
                          (double(newer_.slowest) / double(sim::kNormalRate));
    if (newer_.largest > 0.0f && passed > double(seconds)) {
        older_ = newer_;
        newer_ = last_; // it was so until now
        begun_ = now;
        unknown_ = std::max(unknown_ - 1, 0);
    } else if (!(newer_.largest > 0.0f)) {
        begun_ = now;
    }
    newer_.add(is);
    last_ = is;
}

bool Whereabouts::isSettled() const
{
    return isKnown() && newer_ == last_ && (!(older_.largest > 0.0f) || older_ == last_);
}

Circumstances Whereabouts::all() const
{
    Circumstances all = older_;
    all.add(newer_);
    return all;
}

} // namespace fx::scene
