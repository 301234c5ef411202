#include "fxsdk/presets/volumes/volumes_technique.h"

#include "embedded/volumes_schema.h"
#include "fxsdk/assets/asset_loader.h"
#include "fxsdk/presets/field_detail_preset.h"
#include "fxsdk/presets/still_medium.h"
#include "simulation/volume/sequence_solver.h"
#include "simulation/volume/volume_solver.h"

#include <utility>

namespace fx::preset {
namespace {

constexpr uint64_t kMebibyte = uint64_t(1) << 20;

/// @return false: there is none, which is a finding
bool readFileName(const PresetValue& element, std::string& out)
{
    if (!element.has("file")) {
        element.error("file", "found no file; this needs voxels (*.fxvolume), such as \"file\": "
                              "\"smoke.fxvolume\"; \"fx import --bricks\" makes one");
        return false;
    }
    if (!element.assets()) {
        element.error("file", "this document may not name files");
        return false;
    }
    element.read("file", out);
    return true;
}

void readVoxels(const PresetValue& element, sim::VolumeDef& out)
{
    std::string name;
    if (!readFileName(element, name))
        return;
    const base::Result<base::AssetId> asset = element.assets()->volume(name);
    if (!asset) {
        element.error("file", asset.status().message());
        return;
    }
    out.asset = *asset;
    out.voxels = element.assets()->table().volume(*asset);
    out.cells = base::volumeCells(*out.voxels);
}

void readFrames(const PresetValue& element, uint32_t frames, sim::SequenceDef& out)
{
    asset::SequenceFiles files;
    if (!readFileName(element, files.pattern))
        return;
    files.count = frames;
    element.read("firstFrame", files.first);
    element.read("framesPerSecond", out.framesPerSecond);
    readSequenceEnd(element, out.end);
    uint32_t memory = 512; // [MiB]
    element.read("memory", memory);
    files.memory = memory * kMebibyte;
    const base::Result<base::AssetId> asset = element.assets()->sequence(files);
    if (!asset) {
        element.error("file", asset.status().message());
        return;
    }
    out.asset = *asset;
    out.setSequence(element.assets()->table().sequence(*asset));
    if (!out.sequence->hasVelocities() && frames > 1)
        element.warning("file", "frames without velocities are cross-faded; export the velocities as \"v\", "
                                "and import the volumes again");
}

void readDetail(const PresetValue& element, sim::FieldDetail& out)
{
    readFieldDetail(element, out);
    if (out.given && element.child("detail").has("liveliness"))
        element.child("detail").warning("liveliness", "the detail of a volume stays where it is; remove it");
}

} // namespace

std::string_view volumesSchema()
{
    return volumes_schema::texts()[0].text;
}

void buildVolume(const PresetValue& element, sim::EffectDef& effect)
{
    if (effect.hints.composition == sim::PreferredComposition::None)
        effect.hints.composition = sim::PreferredComposition::Volume; // others draw blurred balls
    uint32_t frames = 0;
    element.read("frames", frames);
    if (frames > 0) {
        auto sequence = std::make_unique<sim::SequenceDef>();
        readStillMedium(element, *sequence);
        readDetail(element, sequence->detail);
        readFrames(element, frames, *sequence);
        effect.solvers.push_back(std::move(sequence));
        return;
    }
    auto volume = std::make_unique<sim::VolumeDef>();
    readStillMedium(element, *volume);
    readDetail(element, volume->detail);
    readVoxels(element, *volume);
    effect.solvers.push_back(std::move(volume));
}

} // namespace fx::preset
