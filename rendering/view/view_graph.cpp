#include "rendering/view/view_graph.h"

#include "rendering/passes/composite_pass.h"
#include "rendering/passes/display_decode_pass.h"
#include "rendering/passes/layer_distance_pass.h"
#include "rendering/passes/layer_sums_pass.h"
#include "rendering/passes/layer_upsample_pass.h"
#include "rendering/passes/media_pass.h"
#include "rendering/passes/overlay_pass.h"
#include "rendering/passes/present_changes_pass.h"
#include "rendering/passes/present_pass.h"
#include "rendering/passes/scene_distance_pass.h"
#include "rendering/passes/solid_pass.h"
#include "rendering/passes/tone_map_pass.h"
#include "rendering/view/layer_grid.h"

#include <algorithm>

namespace fx::render {

namespace {

/// Builds one frame; members are what the passes so far have produced. The order of all passes is that of
/// build() and addMedia().
class ViewGraph
{
public:
    ViewGraph(FrameGraph& graph, const ViewGraphInputs& in)
        : graph_(graph), in_(in), request_(*in.request), settings_(*in.settings),
          grid_(makeLayerGrid(request_.camera, request_.targets.width, request_.targets.height,
                              in.layerDivisor))
    {
        frame_.request = in.request;
        frame_.settings = in.settings;
        frame_.width = request_.targets.width;
        frame_.height = request_.targets.height;
        frame_.view = makeViewBlock(request_.camera, frame_.width, frame_.height);
        frame_.layerView = grid_.view;
        frame_.layerWidth = grid_.width;
        frame_.layerHeight = grid_.height;
        frame_.hasSmallLayers = grid_.divisor > 1;
        for (ViewBlock* view : {&frame_.view, &frame_.layerView}) {
            view->forward.w = settings_.detail ? 1.0f : 0.0f;
            view->sunDirection = {settings_.lighting.sunDirection, view->sunDirection.w};
        }
        solidView_ = frame_.view;
        const bool isAlone = request_.range.isLast && !request_.range.isContinued;
        for (ViewBlock* view : {&solidView_, &frame_.layerView}) {
            view->clipOffset = {view->clipOffset.x, view->clipOffset.y, request_.range.from,
                                request_.range.to};
            view->rayDirection.w = isAlone ? 1.0f : 0.0f;
        }
        isComposed_ = in.composition && in.composition->hasMedia();
        frame_.hasMedia = isComposed_ || !in.batches.empty() || !in.solids.empty();
    }

    ViewGraphOutputs build()
    {
        importTargets();
        if (frame_.hasMedia && in_.lights)
            frame_.lights = in_.lights->addPasses(graph_);
        if (frame_.hasMedia && in_.composition)
            frame_.lights = in_.composition->addLightPasses(graph_, frame_.lights);
        addStage(PassStage::Pictures);
        if (frame_.hasMedia)
            addMedia();
        if (!readable_)
        { // a framebuffer alone can be drawn to but not read: media go on top, nothing else is possible
            if (frame_.hasMedia)
                addComposite(target_, true);
            finish(target_);
            return out_;
        }
        const bool isAltered = completes() && (alterPicture() || settings_.toneMap);
        const bool more = isAltered || separateTarget_ || request_.targets.isDisplay();
        if (more)
            readPicture();
        if (frame_.hasMedia)
            addComposite(more ? frame_.picture : target_, !more);
        if (completes())
            completePicture();
        if (more && out_.anyPass)
            addPresent();
        finish(target_);
        return out_;
    }

private:
    bool completes() const { return request_.range.isLast && in_.completes; }

    void completePicture()
    {
        addStage(PassStage::Refract);
        addStage(PassStage::Sensor);
        if (settings_.toneMap)
            addToneMap();
    }

    void addStage(PassStage stage)
    {
        frame_.anyPass = false;
        for (const auto& technique : in_.techniques)
            technique->addPasses(stage, graph_, frame_);
        out_.anyPass = out_.anyPass || frame_.anyPass;
    }

    bool alterPicture() const
    {
        return std::ranges::any_of(in_.techniques,
                                   [&](const auto& technique) { return technique->altersPicture(frame_); });
    }

    void importTargets()
    {
        const HostTargets& host = request_.targets;
        readable_ = host.color != 0 || host.isDisplay();
        separateTarget_ = host.useFramebuffer && host.color != 0;
        const auto desc = [&](const char* name) {
            return TextureDesc{name, frame_.width, frame_.height, Format::RGBA32F, host.x, host.y};
        };
        target_ = host.useFramebuffer ? graph_.importFramebuffer(desc("host framebuffer"), host.framebuffer)
                                      : graph_.importTarget(desc("host color"), host.color);
        out_.anyPass = separateTarget_; // then the picture has at least to be carried over
    }

    bool isMoved() const { return request_.targets.x != 0 || request_.targets.y != 0; }
    bool hasSamples() const { return in_.facts && in_.facts->colorHasSamples; }

    /// The host's picture as light that passes can read: its color texture, or a copy of it; decoded from
    /// codes.
    void readPicture()
    {
        const HostTargets& host = request_.targets;
        const bool isCopied = in_.copies && (host.color == 0 || isMoved() || hasSamples());
        const bool isTarget = !isCopied && !host.useFramebuffer;
        const TextureDesc desc{isCopied ? "host copy" : "host color", frame_.width, frame_.height,
                               Format::RGBA32F};
        original_ = isTarget   ? target_
                    : isCopied ? graph_.importTexture(desc, in_.copies->color())
                               : graph_.importTexture(desc, host.color);
        keepsUnchanged_ = host.isDisplay() || (isCopied && !settings_.toneMap);
        const bool sourceIsLight = !isCopied && in_.facts && in_.facts->colorIsSrgb;
        display_ = makeDisplayBlock(host, settings_.dazzle.white, sourceIsLight, separateTarget_);
        before_ =
            host.isDisplay()
                ? DisplayDecodePass::addTo(graph_, {original_, frame_.width, frame_.height, display_}).color
                : original_;
        frame_.picture = before_;
    }

    void addPresent()
    {
        if (keepsUnchanged_ || isMoved())
            target_ =
                PresentChangesPass::addTo(graph_, {frame_.picture, before_, original_, target_, display_})
                    .target;
        else
            target_ = PresentPass::addTo(graph_, {frame_.picture, target_}).target;
    }

    void addMedia()
    {
        out_.anyPass = true;
        ResourceId depth;
        if (request_.targets.depth != 0)
            depth = graph_.importTexture({"host depth", frame_.width, frame_.height, Format::R32F},
                                         request_.targets.depth);
        frame_.distance =
            SceneDistancePass::addTo(graph_, {depth, frame_.width, frame_.height, frame_.view}).distance;
        addStage(PassStage::Upload);
        const auto solid = SolidPass::addTo(graph_, {in_.solids, frame_.distance, frame_.width, frame_.height,
                                                     solidView_, settings_.layerOutputs, frame_.lights});
        const ResourceId hostDistance = frame_.distance;
        frame_.distance = solid.distance;
        frame_.layerDistance = solid.distance;
        if (in_.outputs)
            addOutputs(hostDistance);
        const auto drawn =
            grid_.divisor == 1 ? drawLayers(frame_.distance, solid.under) : drawSmallLayers(solid.under);
        media_ = drawn.media;
        if (settings_.layerOutputs) {
            const auto layers = LayerResolvePass::addTo(graph_, {drawn.layers, frame_.width, frame_.height});
            media_ = layers.media;
            out_.fire = layers.fire;
            out_.smoke = layers.smoke;
            out_.dust = layers.dust;
            out_.media = layers.media;
            out_.depth = layers.depth;
            out_.opticalDepth = drawn.layers[MediaPass::OpticalDepth];
            for (const ResourceId kept :
                 {out_.fire, out_.smoke, out_.dust, out_.media, out_.depth, out_.opticalDepth})
                graph_.keep(kept);
        }
        addStage(PassStage::Measure);
    }

    void addOutputs(ResourceId hostDistance)
    {
        out_.outputs = in_.outputs->addTo(graph_, frame_, hostDistance, in_.solids, *in_.past);
        for (const ResourceId kept : out_.outputs)
            if (kept.valid())
                graph_.keep(kept);
    }

    /// All that belongs into the layers and does not hide, at their size, as far as `distance` lets it be
    /// seen.
    MediaPass::Outputs drawLayers(ResourceId distance, const MediaPass::Outputs& under)
    {
        MediaPass::Inputs inputs{{},
                                 distance,
                                 grid_.width,
                                 grid_.height,
                                 frame_.layerView,
                                 settings_.layerOutputs,
                                 frame_.hasSmallLayers,
                                 frame_.lights};
        const MediaPass::Outputs composed =
            isComposed_ ? in_.composition->compose(graph_, inputs, under) : under;
        inputs.batches = in_.batches;
        return MediaPass::addTo(graph_, inputs, composed);
    }

    /// Layers smaller than the picture: drawn up to the far end of each block and, where a block shows more
    /// than one surface, up to the near end as well; brought to the picture's size between the two, and put
    /// over `under`, which has that size.
    MediaPass::Outputs drawSmallLayers(const MediaPass::Outputs& under)
    {
        if (in_.batches.empty() && !isComposed_)
            return under;
        const bool hasDepth = request_.targets.depth != 0 || under.media.valid() || under.layers[0].valid();
        const auto ends = LayerDistancePass::addTo(
            graph_, {frame_.distance, hasDepth, grid_.width, grid_.height, grid_.divisor});
        frame_.layerDistance = ends.far;
        const auto far = drawLayers(ends.far, {});
        const auto near = hasDepth ? drawLayers(ends.near, {}) : MediaPass::Outputs();
        const auto upsampled = [&](ResourceId farLight, ResourceId nearLight) {
            const FrameGraph::Resource small = graph_.resource(farLight);
            return LayerUpsamplePass::addTo(graph_, {frame_.distance, ends.far, ends.near, farLight,
                                                     nearLight, frame_.width, frame_.height, grid_.divisor,
                                                     small.format, small.name})
                .light;
        };
        MediaPass::Outputs out;
        if (!settings_.layerOutputs) {
            out.media = upsampled(far.media, near.media);
            if (under.media.valid())
                out.media =
                    CompositePass::addTo(graph_, {out.media, under.media, frame_.width, frame_.height, true})
                        .color;
            return out;
        }
        for (size_t i = 0; i < MediaPass::LayerTargets; ++i)
            out.layers[i] = upsampled(far.layers[i], near.layers[i]);
        if (under.layers[0].valid())
            out.layers = LayerOverPass::addTo(graph_, out.layers, under.layers);
        return out;
    }

    void addComposite(ResourceId behind, bool inPlace)
    {
        std::optional<DisplayBlock> display;
        if (inPlace ? isMoved() : request_.targets.isDisplay())
            display = makeDisplayBlock(request_.targets, settings_.dazzle.white, false, false);
        const ResourceId color =
            CompositePass::addTo(graph_, {media_, behind, frame_.width, frame_.height, inPlace, display})
                .color;
        if (inPlace)
            target_ = color;
        frame_.picture = color;
    }

    void addToneMap()
    {
        frame_.picture = ToneMapPass::addTo(graph_, {frame_.picture, frame_.width, frame_.height,
                                                     settings_.dazzle.white, Format::RGBA32F})
                             .color;
        out_.anyPass = true;
    }

    void finish(ResourceId result)
    {
        out_.anyPass |= !request_.overlay.empty();
        graph_.keep(OverlayPass::addTo(
                        graph_, {result, request_.overlay, &request_.camera, frame_.width, frame_.height})
                        .picture);
    }

    FrameGraph& graph_;
    const ViewGraphInputs& in_;
    const FrameRequest& request_;
    const ViewSettings& settings_;
    LayerGrid grid_;
    PassFrame frame_{};
    ViewBlock solidView_{};   ///< frame_.view, limited to the range of the request
    bool isComposed_ = false; ///< the composition has media of its own
    bool readable_ = false;
    bool separateTarget_ = false; ///< the picture is read from a texture and written to a framebuffer
    bool keepsUnchanged_ = false; ///< pixels that no pass changes are not written
    DisplayBlock display_{};
    ResourceId target_;   ///< where the result goes
    ResourceId original_; ///< the host's picture as passes can read it
    ResourceId before_;   ///< the same as light
    ResourceId media_;
    ViewGraphOutputs out_;
};

} // namespace

ViewGraphOutputs buildViewGraph(FrameGraph& graph, const ViewGraphInputs& in)
{
    return ViewGraph(graph, in).build();
}

} // namespace fx::render
