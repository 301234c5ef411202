/// @file gpu_module_source.h
/// Additional interface of tile modules that the GPU can compute.
#pragma once

#include "foundation/snapshot/gpu_modules.h"
#include "simulation/particles/tile.h"

namespace fx::sim {

/// A TileOp that implements this interface can run on the GPU; any other TileOp runs on the CPU only. Objects
/// are immutable.
class GpuModuleSource
{
public:
    virtual ~GpuModuleSource() = default;
    /// Describes the module to `out`. @return false if only the CPU can compute the module
    virtual bool describe(base::GpuModules& out) const = 0;
    /// Writes the scratch data of prepare() as words for the GPU. describe() defines the number of words.
    virtual void writeWords(const void* /*scratch*/, uint32_t* /*out*/) const {}
};

/// Returns the GPU interface of a module; null if only the CPU can compute the module.
inline const GpuModuleSource* gpuSourceOf(const TileOp& op)
{
    return dynamic_cast<const GpuModuleSource*>(&op);
}

} // namespace fx::sim
