/// @file shown_frame.h
/// Snapshots that a frame holds from its preparation until its end.
#pragma once

#include "fxsdk/api/masked_snapshots.h"
#include "fxsdk/fx_view.h"
#include "fxsdk/quality/view_quality.h"
#include "fxsdk/scene/scene.h"
#include "rendering/view/view_renderer.h"

#include <cstdint>

namespace fx::api {

static_assert(int(render::Composition::Volume) + 1 == int(sim::PreferredComposition::Volume));
static_assert(int(render::Composition::Slabs) + 1 == int(sim::PreferredComposition::Slabs));

/// The composition that FX_COMPOSITION_AUTOMATIC stands for if the effects prefer `preferred`.
inline render::Composition automaticComposition(sim::PreferredComposition preferred)
{
    return preferred == sim::PreferredComposition::None ? render::Composition::Sorted
                                                        : render::Composition(int(preferred) - 1);
}

/// Replaces automatic scattering in `asked` by the scattering that the effects prefer. Other settings do not
/// change.
inline render::SliceSettings automaticScattering(render::SliceSettings asked,
                                                 sim::PreferredScattering preferred)
{
    if (asked.automatic) {
        asked.multiple = preferred != sim::PreferredScattering::Single;
        asked.network = preferred == sim::PreferredScattering::Network;
    }
    return asked;
}

/// Holds the snapshots of one frame. During the lifetime of this object, the settings that fit the budget
/// replace the settings of the host. Threads: [GL thread].
class ShownFrame
{
public:
    ShownFrame(scene::Scene& scene, quality::ViewQuality& quality, render::ViewRenderer& renderer,
               MaskedSnapshots& masked, std::pmr::vector<base::ShownPlacement>& inMotion,
               const FxFrameDef& frame, bool holdsQuality)
        : def(frame), held_(scene, inMotion), quality_(quality), renderer_(renderer), shown_(held_.acquired),
          asked_(renderer.settings().composition), askedSlices_(renderer.settings().slices)
    {
        shown_.snapshots = masked.shown(held_.acquired.snapshots, scene.displayRules(), frame.visibilityMask);
        renderer_.settings().composition =
            render::resolved(asked_, automaticComposition(shown_.hints.composition));
        renderer_.settings().slices = automaticScattering(askedSlices_, shown_.hints.scattering);
        quality_.begin(renderer_, frame.deltaTime, holdsQuality);
    }
    ~ShownFrame()
    {
        quality_.end(renderer_);
        renderer_.settings().composition = asked_;
        renderer_.settings().slices = askedSlices_;
    }
    ShownFrame(const ShownFrame&) = delete;
    ShownFrame& operator=(const ShownFrame&) = delete;

    const scene::Presentation& shown() const { return shown_; }
    /// Whether `frame` has the same inputs as this frame. If so, the gathered data can be reused.
    bool isSameAs(const FxFrameDef& frame) const;

    const FxFrameDef def;
    uint64_t allocations = 0; ///< number of allocations during the preparation

private:
    /// Holds the snapshots of the scene.
    struct Held
    {
        Held(scene::Scene& from, std::pmr::vector<base::ShownPlacement>& inMotion)
            : scene(from), acquired(from.acquire(inMotion))
        {}
        ~Held() { scene.release(acquired.snapshots); }
        Held(const Held&) = delete;
        Held& operator=(const Held&) = delete;

        scene::Scene& scene;
        const scene::Presentation acquired;
    };

    Held held_;
    quality::ViewQuality& quality_;
    render::ViewRenderer& renderer_;
    scene::Presentation shown_;               ///< without the instances that the frame does not show
    const render::Composition asked_;         ///< setting of the host
    const render::SliceSettings askedSlices_; ///< settings of the host
};

} // namespace fx::api
