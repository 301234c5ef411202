/// @file event_record.h
/// Finds the events of a tile that has been stepped.
#pragma once

#include "simulation/particles/event_list.h"
#include "simulation/particles/tile.h"

namespace fx::sim {

/// The contact of row `i`, which is Hit or Killed; without its kind.
inline ParticleEvent contactOf(const TileContext& context, const Tile& tile, uint32_t i)
{
    const base::Ticks ticks =
        std::clamp(base::toTicks(double(tile.seconds[i])), base::Ticks(1), context.step.stepTicks);
    ParticleEvent event;
    event.tick = contactTick(context.end - ticks, ticks, tile.contact[i]);
    event.index = uint64_t(tile.indexHigh[i]) << 32 | tile.indexLow[i];
    event.emitter = context.step.solverIndex;
    const glm::vec3 from(tile.fromX[i], tile.fromY[i], tile.fromZ[i]);
    const glm::vec3 to(tile.x[i], tile.y[i], tile.z[i]);
    const bool endsThere = (tile.flags[i] & (tile_flag::Killed | tile_flag::Stuck)) != 0;
    event.position = endsThere ? to : from + tile.contact[i] * (to - from);
    event.velocity = {tile.vx[i], tile.vy[i], tile.vz[i]};
    return event;
}

/// Adds the contacts and the deaths by modules of a tile: rows that are Hit and rows that are Killed, after
/// the phase Contact and before the tile is stored.
inline void recordContacts(const TileContext& context, const Tile& tile, EventList& out)
{
    for (uint32_t i = 0; i < tile.count; ++i) {
        const uint32_t flags = tile.flags[i];
        if ((flags & (tile_flag::Hit | tile_flag::Killed)) == 0 || (flags & tile_flag::Empty) != 0)
            continue;
        ParticleEvent event = contactOf(context, tile, i);
        for (const auto& [bit, kind] : {std::pair(uint32_t(tile_flag::Hit), EventKind::Collision),
                                        std::pair(uint32_t(tile_flag::Killed), EventKind::Death)})
            if ((flags & bit) != 0) {
                event.kind = kind;
                out.add(event);
            }
    }
}

} // namespace fx::sim
