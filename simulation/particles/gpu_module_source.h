/// @file gpu_module_source.h
/// What a module of a tile is besides when the GPU can do the same.
#pragma once

#include "foundation/snapshot/gpu_modules.h"
#include "simulation/particles/tile.h"

namespace fx::sim {

/// A TileOp is one too, or only the CPU can run it. Immutable.
class GpuModuleSource
{
public:
    virtual ~GpuModuleSource() = default;
    /// Tells `out` what it does. @return false where only the CPU can
    virtual bool describe(base::GpuModules& out) const = 0;
    /// What prepare() has left in its scratch as the GPU reads it: the words that describe() has asked for.
    virtual void writeWords(const void* /*scratch*/, uint32_t* /*out*/) const {}
};

/// Null where only the CPU can.
inline const GpuModuleSource* gpuSourceOf(const TileOp& op)
{
    return dynamic_cast<const GpuModuleSource*>(&op);
}

} // namespace fx::sim
