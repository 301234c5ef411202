#include "fxsdk/cli/render_statistics.h"

namespace fx::cli {

nlohmann::json frameStatistics(const FrameCounters& counters, double time, bool withOverdraw)
{
    const FxSceneStatistics& scene = counters.scene;
    const FxViewStatistics& view = counters.view;
    nlohmann::json json = {
        {"time", time},
        {"instances_active", scene.instancesActive},
        {"instances_dormant", scene.instancesDormant},
        {"particles", scene.particles},
        {"particles_dropped", scene.dropped},
        {"blobs", view.blobs},
        {"blobs_culled", view.blobsCulled},
        {"passes", counters.passes},
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
        {"overflow", {view.overflow[0], view.overflow[1], view.overflow[2]}},
    };
    if (withOverdraw) {
        json["covered_pixels"] = view.coveredPixels;
        json["shaded_fragments"] = view.shadedFragments;
        json["overdraw"] =
            view.coveredPixels == 0 ? 0.0 : double(view.shadedFragments) / double(view.coveredPixels);
    }
    return json;
}

} // namespace fx::cli
