/// @file force_op.h
/// Template of a module that consists of a force kernel and its definition.
#pragma once

#include "foundation/simd/instruction_set.h"
#include "simulation/particles/gpu_module_source.h"
#include "simulation/particles/tile.h"

#include <memory>

namespace fx::sim {

template <class Def>
class ForceOp final : public TileOp, public GpuModuleSource
{
public:
    using Kernel = void (*)(const Def& def, Tile& tile);
    using Describe = bool (*)(const Def& def, base::GpuModules& out);

    ForceOp(const Def& def, const TileBound& bound, Describe describe, Kernel kernel)
        : def_(def), bound_(bound), describe_(describe), kernel_(kernel)
    {}
    TileBound bound() const override { return bound_; }
    TilePhase phase() const override { return TilePhase::Force; }
    bool describe(base::GpuModules& out) const override { return describe_(def_, out); }
    void run(const TileContext&, const void*, Tile& tile) const override
    {
        base::applyInstructionSetLimit();
        kernel_(def_, tile);
    }

private:
    Def def_;
    TileBound bound_;
    Describe describe_;
    Kernel kernel_;
};

/// Creates the module of a force.
/// @param describe see GpuModuleSource::describe()
/// @param kernel see FX_FORCE_KERNEL; the limit on instruction sets is applied before the kernel is called
template <class Def>
std::unique_ptr<TileOp> makeForceOp(const Def& def, const TileBound& bound,
                                    typename ForceOp<Def>::Describe describe,
                                    typename ForceOp<Def>::Kernel kernel)
{
    return std::make_unique<ForceOp<Def>>(def, bound, describe, kernel);
}

/// Argument `kernel` of makeForceOp(). The macro calls an exported kernel, `void FUNCTION(const Def&,
/// Tile&)`, which is compiled for the instruction set in use.
#define FX_FORCE_KERNEL(FUNCTION)                                                                            \
    [](const auto& def, Tile& tile) { HWY_DYNAMIC_DISPATCH(FUNCTION)(def, tile); }

} // namespace fx::sim
