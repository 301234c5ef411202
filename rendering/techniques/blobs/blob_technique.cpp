#include "rendering/techniques/draw_techniques.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/volume_kind.h"
#include "rendering/passes/blob_light_pass.h"
#include "rendering/passes/overdraw_pass.h"
#include "rendering/techniques/blobs/blob_parts.h"
#include "rendering/techniques/blobs/blob_view.h"

#include <array>

namespace fx::render {

namespace {

constexpr TimedPass kPasses[] = {{"scene distance"},
                                 {"media", "media"},
                                 {"composite"},
                                 {"blob upload", "media"},
                                 {"media impostor upload", "media"},
                                 {"media impostor blobs", "media"},
                                 {"media impostors", "media"},
                                 {"impostor lights", "media"},
                                 {"blob light", "media"}};

std::span<const ProgramDesc* const> programs()
{
    static const auto all = [] {
        std::array<const ProgramDesc*, kMediaPrograms + 5> list{};
        for (size_t i = 0; i < kMediaPrograms; ++i)
            list[i] = &mediaProgramAt(i);
        size_t end = kMediaPrograms;
        for (const ProgramDesc* program : {&kOverdrawProgram, &kOverdrawSmallProgram, &kImpostorProgram,
                                           &kImpostorKeepProgram, &blobLightProgram(false)})
            list[end++] = program;
        return list;
    }();
    return all;
}

std::unique_ptr<TechniqueView> create(const TechniqueSetup& setup)
{
    return std::make_unique<BlobView>(setup);
}

} // namespace

constexpr DrawTechnique kBlobTechnique{
    .name = "spherical billboards",
    .kind = &base::kBlobKind,
    .create = create,
    .programs = programs,
    .passes = kPasses,
    .lights = &kBlobLights,
    .levels = &kBlobScalability,
};

constexpr DrawTechnique kFieldDetailTechnique{
    .name = "detail of fields",
    .kind = &base::kMaterialKind,
};

constexpr DrawTechnique kVolumeTechnique{
    .name = "volumes of voxels",
    .kind = &base::kVolumeKind,
};

} // namespace fx::render
