/// @file event_record.h
/// Creates events of rows of a tile that is being stepped.
#pragma once

#include "simulation/particles/event_list.h"
#include "simulation/particles/tile.h"

namespace fx::sim {

/// Creates an event of row `i`, without position and velocity. `share` is the time of the event as a fraction
/// of the row's part of the step.
inline ParticleEvent eventAt(const TileContext& context, const Tile& tile, uint32_t i, float share,
                             EventKind kind)
{
    const base::Ticks ticks =
        std::clamp(base::toTicks(double(tile.seconds[i])), base::Ticks(1), context.step.stepTicks);
    ParticleEvent event{};
    event.tick = contactTick(context.end - ticks, ticks, share);
    event.index = uint64_t(tile.indexHigh[i]) << 32 | tile.indexLow[i];
    event.emitter = context.step.solverIndex;
    event.kind = kind;
    return event;
}

inline ParticleEvent collisionOf(const TileContext& context, const Tile& tile, uint32_t i,
                                 const TileContact& contact)
{
    ParticleEvent event = eventAt(context, tile, i, contact.share, EventKind::Collision);
    event.position = contact.position;
    event.velocity = contact.velocity;
    event.speed = contact.speed;
    event.isLast = contact.isLast;
    event.number = contact.number;
    event.normal = contact.normal;
    return event;
}

/// Creates the death event of row `i`, which has the flag Killed.
inline ParticleEvent killOf(const TileContext& context, const Tile& tile, uint32_t i)
{
    ParticleEvent event = eventAt(context, tile, i, tile.contact[i], EventKind::Death);
    event.position = {tile.x[i], tile.y[i], tile.z[i]};
    event.velocity = {tile.vx[i], tile.vy[i], tile.vz[i]};
    return event;
}

} // namespace fx::sim
