#include "fxsdk/cli/render/render_statistics.h"

#include "rendering/frame/composition_names.h"

#include <algorithm>
#include <string_view>

namespace fx::cli {

constexpr std::string_view kSweepPass = "network rays"; ///< one a sweep of the illumination networks

nlohmann::json frameStatistics(const FrameCounters& counters, double time, bool withOverdraw)
{
    const FxSceneStatistics& scene = counters.scene;
    const FxViewStatistics& view = counters.view;
    nlohmann::json json = {
        {"time", time},
        {"instances_active", scene.instancesActive},
        {"instances_dormant", scene.instancesDormant},
        {"instances_hidden", scene.instancesHidden},
        {"instances_waking", scene.instancesWaking},
        {"instances_resting", scene.instancesResting},
        {"simulations", scene.simulations},
        {"particles", scene.particles},
        {"particles_gpu", view.gpuParticles},
        {"particles_dropped", scene.dropped},
        {"blobs", view.blobs},
        {"blobs_culled", view.blobsCulled},
        {"sprites", view.sprites},
        {"meshes", view.meshes},
        {"ribbon_pieces", view.ribbonPieces},
        {"passes", counters.passes},
        {"network_sweeps", std::ranges::count(counters.passes, kSweepPass)},
        {"network_passes",
         std::ranges::count_if(counters.passes,
                               [](const auto& name) { return name.starts_with("network "); })},
        {"programs_compiled", view.programsCompiled},
        {"gl_calls", view.glCalls},
        {"draw_calls", view.drawCalls},
        {"bytes_textures", view.textureBytes},
        {"ms_simulate", counters.millisecondsSimulate},
        {"ms_render", counters.millisecondsRender},
        {"allocations", scene.updateAllocations + view.allocations},
        {"nonfinite", view.blobsNonFinite},
        {"estimated_fragments", view.estimatedFragments},
        {"layer_scale", view.layerScale},
        {"lists_kept", view.keptLists != 0},
        {"bytes_uploaded", view.uploadedBytes},
        {"particles_sorted", view.sortedParticles},
        {"bytes_frame", view.sharedBytes},
        {"bytes_frame_unshared", view.unsharedBytes},
        {"blobs_thinned", view.blobsThinned},
        {"particles_thinned", view.particlesThinned},
        {"bytes_kept", view.keptRowBytes},
        {"bytes_shared", view.sharedRowBytes},
        {"impostors", view.impostors},
        {"impostors_taken", view.impostorsTaken},
        {"blocks", view.blocks},
        {"block_instances", view.blockInstances},
        {"block_particles", view.blockParticles},
        {"block_particles_refused", view.blockParticlesRefused},
        {"block_impostors", view.blockImpostors},
        {"block_tiles_drawn", view.blockTilesDrawn},
        {"lod_groups", {view.lodGroups[0], view.lodGroups[1], view.lodGroups[2], view.lodGroups[3]}},
        {"composition", render::nameOf(render::Composition(view.composition))},
        {"composition_size", view.compositionSize},
        {"volume_reads", counters.volumes.reads},
        {"volume_late", counters.volumes.late},
        {"volume_bytes", counters.volumes.bytes},
        {"volume_bytes_peak", counters.volumes.peakBytes},
        {"overflow", {view.overflow[0], view.overflow[1], view.overflow[2]}},
    };
    if (withOverdraw) {
        json["covered_pixels"] = view.coveredPixels;
        json["shaded_fragments"] = view.shadedFragments;
        json["blobs_listed"] = view.listedBlobs;
        json["blobs_spilled"] = view.spilledBlobs;
        json["fragments_spilled"] = view.spilledFragments;
        json["overdraw"] =
            view.coveredPixels == 0 ? 0.0 : double(view.shadedFragments) / double(view.coveredPixels);
    }
    return json;
}

} // namespace fx::cli
