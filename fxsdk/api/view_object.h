/// @file view_object.h
/// Implementation of FxView.
#pragma once

#include "fxsdk/api/context.h"
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/shown_frame.h"
#include "fxsdk/api/sort_layers.h"
#include "fxsdk/fx_view.h"
#include "fxsdk/quality/view_quality.h"
#include "rendering/view/view_renderer.h"

#include <memory_resource>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace fx::api {

/// Draws one of the lower layers of a view.
struct LayerRenderer
{
    int32_t layer;
    render::ViewRenderer renderer;
    uint32_t idleFrames = 0; ///< number of successive frames without this layer
};

/// A layer of a frame, and what draws it.
struct LayerDraw
{
    render::ViewRenderer* renderer;
    base::SnapshotPair snapshots;
    bool isUppermost;
};

} // namespace fx::api

struct FxView
{
    FxView(FxScene* shown, const fx::render::ViewSettings& settings)
        : context(shown->context), scene(shown), marks(&context->memory), overlay(&context->memory),
          renderer(makeRenderer(*context)), masked(&context->memory), inMotion(&context->memory),
          sortLayers(&context->memory), lowerLayers(&context->memory), layerDraws(&context->memory)
    {
        setSettings(settings);
        scene->views.fetch_add(1);
    }
    ~FxView()
    {
        setSettings({});
        scene->views.fetch_sub(1);
    }
    FxView(const FxView&) = delete;
    FxView& operator=(const FxView&) = delete;

    static fx::render::ViewRenderer makeRenderer(FxContext& context)
    {
        return makeRenderer(context, *context.device);
    }
    static fx::render::ViewRenderer makeRenderer(FxContext& context, fx::render::GlDevice& device)
    {
        fx::render::ViewRenderer renderer(&device, &context.schema, &context.memory,
                                          context.techniques.draws);
        renderer.setAssets(&context.assets);
        return renderer;
    }

    /// Shows another scene, by a renderer without data of the last scene. Strong guarantee.
    void setScene(FxScene* shown)
    {
        fx::render::ViewRenderer empty = makeRenderer(*context);
        prepared.reset(); // gives the settings of the host back
        rangeEnd.reset();
        empty.settings() = renderer.settings();
        if (renderer.settings().overlay) {
            shown->scene.wantMarks(true);
            scene->scene.wantMarks(false);
        }
        renderer = std::move(empty);
        shown->views.fetch_add(1);
        scene->views.fetch_sub(1);
        scene = shown;
        masked.forget();
        lowerLayers.clear();
        lowerStatistics = {};
        sortLayers.forget();
        sleeps = false;
    }

    /// Continues with a renderer of another GL context, which gets the settings of this view. The renderer of
    /// the last context is destroyed; its device must be marked as lost.
    void setRenderer(fx::render::ViewRenderer&& restored) noexcept
    {
        prepared.reset(); // gives the settings of the host back
        rangeEnd.reset();
        static_assert(std::is_nothrow_copy_assignable_v<fx::render::ViewSettings>);
        restored.settings() = renderer.settings();
        renderer = std::move(restored);
        lowerLayers.clear();
        lowerStatistics = {};
        sleeps = false;
        allocations = 0;
    }

    /// Replaces all settings except the host's lights. If the settings enable the activation overlay, the
    /// scene records the marks of the overlay.
    void setSettings(const fx::render::ViewSettings& settings)
    {
        prepared.reset();
        if (settings.overlay != renderer.settings().overlay)
            scene->scene.wantMarks(settings.overlay);
        const fx::render::HostLights lights = renderer.settings().hostLights;
        renderer.settings() = settings;
        renderer.settings().hostLights = lights;
        sleeps = false;
    }

    FxContext* context;
    FxScene* scene;
    std::pmr::vector<fx::scene::Mark> marks; ///< marks of the overlay
    std::pmr::vector<fx::render::OverlayBox> overlay;
    fx::render::ViewRenderer renderer; ///< draws the uppermost layer, and completes the picture
    fx::api::MaskedSnapshots masked;   ///< outlives `prepared`
    /// instances in motion, and where the frame shows them; outlives `prepared`
    std::pmr::vector<fx::base::ShownPlacement> inMotion;
    fx::api::SortLayers sortLayers; ///< of the frame that was prepared last; outlives `prepared`
    std::pmr::vector<fx::api::LayerRenderer> lowerLayers;
    std::pmr::vector<fx::api::LayerDraw> layerDraws; ///< see layersToDraw()
    fx::render::FrameStatistics lowerStatistics;     ///< sums of the lower layers of the last frame
    fx::quality::ViewQuality quality;
    uint64_t allocations = 0; ///< number of allocations during the last frame
    /// True when the last frame drew no element. As long as the scene is empty, the next frame draws no
    /// element either.
    bool sleeps = false;
    uint32_t gpuSeen = 0; ///< FxScene::gpuSeen after the last frame that was not slept through
    /// frame of the sleeping view, already validated; meaningful only while `sleeps`
    FxFrameDef sleptFrame = fxDefaultFrameDef();
    glm::dvec3 origin{0.0}; ///< [m] FxFrameDef::origin of the frame that was prepared or rendered last
    /// set by fxView_PrepareLights(), until the frame is rendered, and by the first of several ranges of a
    /// frame, until the last one is rendered
    std::optional<fx::api::ShownFrame> prepared;
    /// near end of the range that was rendered last, in units of the host; without a value, no frame awaits
    /// further ranges. Meaningful only while there is `prepared`.
    std::optional<float> rangeEnd;
};

namespace fx::api {

inline const FxLog* logOf(const FxView* view)
{
    return view ? &view->context->def.log : nullptr;
}

/// Removes the view from its context and frees it. No call on the view may be in progress. [GL thread]
void destroyView(FxView* view);

/// Converts checked settings and frames to the renderer's types. The status names the invalid member.
base::Status convertSettings(const HostWorld& world, const FxViewSettings& given,
                             render::ViewSettings& outSettings);
base::Status convertBudget(const FxViewSettings& given, quality::BudgetOptions& outOptions);
base::Status convertFrame(const HostWorld& world, const FxFrameDef& given, render::FrameRequest& outRequest);

/// Functions that convert instance ids in the outputs to ids of the C API.
inline render::InstanceNames instanceNames(const FxView& view)
{
    return {[](const void* scene, uint64_t instance) {
                return static_cast<const FxScene*>(scene)->ids.encode(instance, kInstanceIdType);
            },
            view.scene};
}

/// Prepares a frame that shows the present moment with the settings that fit the budget.
inline ShownFrame& showFrame(FxView& view, const FxFrameDef& frame)
{
    view.prepared.reset();
    view.rangeEnd.reset();
    view.origin = view.context->world.position(frame.origin);
    ShownFrame& frameToShow = view.prepared.emplace(
        view.scene->scene, view.quality, view.renderer, view.masked, view.inMotion, frame,
        frame.holdQuality != 0 || frame.rangePart != FX_RANGE_ONLY || view.scene->isCatchingUp());
    try {
        view.sortLayers.divide(frameToShow.shown().snapshots, view.scene->scene.displayRules());
    } catch (...) { // a frame that is not divided must not be drawn by a later call
        view.prepared.reset();
        throw;
    }
    return frameToShow;
}

/// Returns what draws the prepared frame, from its lowest layer to its uppermost. Without layers this is the
/// renderer of the view alone. Valid until the next call.
std::span<const LayerDraw> layersToDraw(FxView& view);
/// Counts a lower layer that has been drawn.
void noteDrawn(const LayerDraw& layer, FxView& view);
/// Counters of the last frame, of all layers.
render::FrameStatistics withLowerLayers(const FxView& view);
/// Whether the frame can be drawn in several layers, if it has several.
base::Status checkLayers(const FxView& view, const FxFrameDef& frame);

/// Runs `body` as a call inside the view, if the thread rules allow it. Only one call of a context may be in
/// progress at a time.
template <class F>
FxResult insideView(const char* function, FxView* view, F&& body) noexcept
{
    return guarded(function, logOf(view), [&]() -> base::Status {
        if (!view)
            return invalid("view is null");
        const SingleCaller::Scope scope(view->context->gl, kGlThreadRule);
        return scope ? body() : scope.status();
    });
}

} // namespace fx::api
