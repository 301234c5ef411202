/// @file module_probe.h
/// Behavior of an emitter's modules as numbers, so that emitters with different modules give different
/// numbers.
#pragma once

#include "simulation/emitters/emitter_def.h"
#include "simulation/particles/gpu_module_source.h"
#include "tests/presets/member_probe.h"
#include "tests/simulation/particles/modules/tile_stage.h"

#include <cmath>

namespace fx::test {

/// Appends positions and directions of a few births to `fields`.
inline void addBirths(Fields& fields, const sim::ShapeOp* births)
{
    if (!births)
        return;
    constexpr uint32_t kCount = 8;
    float in[8][kCount], out[6][kCount];
    for (uint32_t k = 0; k < 8; ++k)
        for (uint32_t i = 0; i < kCount; ++i)
            in[k][i] = 0.05f + 0.9f * std::fmod(0.618f * float(k * kCount + i), 1.0f);
    births->sample({{in[0], in[1], in[2], in[3]},
                    {in[4], in[5], in[6], in[7]},
                    {out[0], out[1], out[2]},
                    {out[3], out[4], out[5]},
                    kCount});
    for (const auto& column : out)
        fields.insert(fields.end(), column, column + kCount);
}

/// Appends sums, positions and flags to `fields`, after each module has processed a cloud of particles.
inline void addModules(Fields& fields, const std::vector<std::shared_ptr<const sim::TileOp>>& modules)
{
    constexpr uint32_t kRows = 64;
    TileStage stage(kRows);
    for (uint32_t i = 0; i < kRows; ++i) {
        const float a = 2.4f * float(i), r = 0.08f * float(i);
        stage.place(i, {r * std::cos(a), 0.1f * float(i) - 3.0f, r * std::sin(a)},
                    {10.0f * std::sin(a), -30.0f + 0.7f * float(i), 3.0f});
    }
    stage.context.begin = 0.3;
    stage.step.groundHeight = -0.5f;
    stage.begin(0.1f);
    for (const bool isForce : {true, false}) {
        for (const auto& op : modules)
            if ((op->phase() == sim::TilePhase::Force) == isForce)
                stage.run(*op);
        if (isForce)
            stage.fly();
    }
    const sim::Tile& t = *stage.tile;
    for (const float* column :
         {t.x, t.y, t.z, t.vx, t.vy, t.vz, t.ax, t.ay, t.az, t.ux, t.uy, t.uz, t.quadratic})
        fields.insert(fields.end(), column, column + kRows);
    fields.insert(fields.end(), t.flags, t.flags + kRows);
    base::GpuModules described; // some of what only the GPU does
    for (const auto& op : modules)
        if (const sim::GpuModuleSource* const source = sim::gpuSourceOf(*op))
            source->describe(described);
    fields.insert(fields.end(), described.numbers.begin(), described.numbers.end());
    fields.push_back(double(modules.size()));
}

} // namespace fx::test
