#include "fxsdk/presets/volumes/volumes_technique.h"

#include "embedded/volumes_schema.h"
#include "fxsdk/assets/asset_loader.h"
#include "fxsdk/presets/still_medium.h"
#include "simulation/volume/volume_solver.h"

namespace fx::preset {
namespace {

void readVoxels(const PresetValue& element, sim::VolumeDef& out)
{
    if (!element.has("file")) {
        element.error("file", "found no file; this needs voxels (*.fxvolume), such as \"file\": "
                              "\"smoke.fxvolume\"; \"fx import --bricks\" makes one");
        return;
    }
    if (!element.assets()) {
        element.error("file", "this document may not name files");
        return;
    }
    std::string name;
    element.read("file", name);
    const base::Result<base::AssetId> asset = element.assets()->volume(name);
    if (!asset) {
        element.error("file", asset.status().message());
        return;
    }
    out.asset = *asset;
    out.voxels = element.assets()->table().volume(*asset);
    out.cells = base::volumeCells(*out.voxels);
}

} // namespace

std::string_view volumesSchema()
{
    return volumes_schema::texts()[0].text;
}

void buildVolume(const PresetValue& element, sim::EffectDef& effect)
{
    auto volume = std::make_unique<sim::VolumeDef>();
    readStillMedium(element, *volume);
    readVoxels(element, *volume);
    effect.solvers.push_back(std::move(volume));
}

} // namespace fx::preset
