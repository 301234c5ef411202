#include "simulation/particles/tile_step.h"

#include "simulation/particles/tile_motion.h"

#include <algorithm>
#include <iterator>

namespace fx::sim {

namespace {

constexpr std::array<float* (*)(Tile&), 6> kMotion{
    [](Tile& t) -> float* { return t.x; },  [](Tile& t) -> float* { return t.y; },
    [](Tile& t) -> float* { return t.z; },  [](Tile& t) -> float* { return t.vx; },
    [](Tile& t) -> float* { return t.vy; }, [](Tile& t) -> float* { return t.vz; },
};

/// Rows of the store that lie in neither gap nor beyond the window.
bool inWindow(const RowWindow& rows, uint32_t row)
{
    return row < rows.count && (row < rows.gapBegin || row >= rows.gapEnd);
}

void clearSums(Tile& tile)
{
    for (float* sum :
         {tile.ax, tile.ay, tile.az, tile.ux, tile.uy, tile.uz, tile.drag, tile.quadratic, tile.contact})
        std::fill_n(sum, kTileRows, 0.0f);
}

} // namespace

TileStep::TileStep(const ParticleProgram& program, const StepContext& step)
    : program_(program), context_{step, step.tick + step.stepTicks, step.wind + program.def.forces.wind,
                                  base::toSeconds(step.tick), step.seconds()},
      ops_(step.scratch->allocate<PreparedOp>(program.ops.size()))
{
    for (size_t k = 0; k < ops_.size(); ++k) {
        const TileOp& op = *program.ops[k];
        void* scratch = step.scratch->allocate<std::byte>(op.scratchBytes()).data();
        op.prepare(context_, scratch);
        ops_[k] = {&op, scratch};
    }
}

void TileStep::load(const ParticleStore& store, uint32_t row, Tile& tile) const
{
    tile.firstRow = row;
    for (size_t c = 0; c < kMotion.size(); ++c) {
        float* const column = kMotion[c](tile);
        std::copy_n(store.values[stored::X + c].data() + row, tile.padded, column);
    }
    const RowWindow rows = store.window();
    for (uint32_t i = 0; i < tile.padded; ++i) {
        const uint64_t index = store.index[row + i];
        tile.indexLow[i] = uint32_t(index);
        tile.indexHigh[i] = uint32_t(index >> 32);
        const uint32_t kept = store.flags.data() ? store.flags[row + i] : 0;
        const bool living =
            i < tile.count && inWindow(rows, row + i) && index != kNoParticle && index >= first_;
        tile.flags[i] = living ? kept : uint32_t(tile_flag::Empty);
    }
    const float* const perLife = store.values[stored::PerLife].data();
    fillTimes({store.born.data() + row, perLife ? perLife + row : nullptr, store.constant[stored::PerLife],
               context_.step.tick, context_.end},
              tile);
    if (const float* const excess = store.values[stored::Excess].data())
        for (uint32_t i = 0; i < tile.padded; ++i)
            tile.excess[i] = excess[row + i] * program_.def.temperatureOverLife.at(tile.life[i])[0];
    else
        std::fill_n(tile.excess, kTileRows, 0.0f);
    clearSums(tile);
}

void TileStep::save(const Tile& tile, ParticleStore& store) const
{
    Tile& from = const_cast<Tile&>(tile);
    for (size_t c = 0; c < kMotion.size(); ++c)
        std::copy_n(kMotion[c](from), tile.padded, store.values[stored::X + c].data() + tile.firstRow);
    if (store.flags.data())
        for (uint32_t i = 0; i < tile.count; ++i)
            if ((tile.flags[i] & tile_flag::Empty) == 0)
                store.flags[tile.firstRow + i] = tile.flags[i] & (tile_flag::Stuck | tile_flag::Collided);
    if (!program_.mortal)
        return;
    for (uint32_t i = 0; i < tile.count; ++i)
        if (tile.flags[i] & tile_flag::Killed)
            store.values[stored::PerLife][tile.firstRow + i] = kNoLife;
}

void TileStep::run(ParticleStore& store, uint32_t begin, uint32_t end) const
{
    Tile tile;
    const RowWindow rows = store.window();
    for (uint32_t row = begin; row < end; row += kTileRows) {
        tile.count = std::min(end - row, kTileRows);
        tile.padded = (tile.count + kTilePadding - 1) / kTilePadding * kTilePadding;
        if (row >= rows.gapBegin && row + tile.count <= rows.gapEnd)
            continue;
        load(store, row, tile);
        bool moved = false;
        for (const PreparedOp& op : ops_) {
            if (!moved && op.op->phase() > TilePhase::Integrate) {
                integrate(tile);
                moved = true;
            }
            op.op->run(context_, op.scratch, tile);
        }
        if (!moved)
            integrate(tile);
        if (watch_)
            watch_->see(context_, tile, store);
        save(tile, store);
    }
}

} // namespace fx::sim
