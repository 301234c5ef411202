#include "rendering/view/view_graph.h"

#include "rendering/passes/composite_pass.h"
#include "rendering/passes/dazzle_pass.h"
#include "rendering/passes/heat_offset_pass.h"
#include "rendering/passes/heat_shimmer_pass.h"
#include "rendering/passes/layer_distance_pass.h"
#include "rendering/passes/layer_over_pass.h"
#include "rendering/passes/layer_resolve_pass.h"
#include "rendering/passes/layer_upsample_pass.h"
#include "rendering/passes/media_pass.h"
#include "rendering/passes/overdraw_pass.h"
#include "rendering/passes/overlay_pass.h"
#include "rendering/passes/present_pass.h"
#include "rendering/passes/scene_distance_pass.h"
#include "rendering/passes/solid_pass.h"
#include "rendering/passes/tone_map_pass.h"
#include "rendering/view/layer_grid.h"

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

/// Builds one frame; members are what the passes so far have produced.
class ViewGraph
{
public:
    ViewGraph(FrameGraph& graph, const ViewGraphInputs& in)
        : graph_(graph), in_(in), request_(*in.request), settings_(*in.settings),
          width_(request_.targets.width), height_(request_.targets.height),
          view_(makeViewBlock(request_.camera, width_, height_)),
          grid_(makeLayerGrid(request_.camera, width_, height_, in.layerDivisor))
    {
        for (ViewBlock* view : {&view_, &grid_.view}) {
            view->forward.w = settings_.detail ? 1.0f : 0.0f;
            view->sunDirection = {settings_.lighting.sunDirection, view->sunDirection.w};
        }
    }

    ViewGraphOutputs build()
    {
        importTargets();
        const bool media = !in_.blobs.empty() || !in_.batches.empty() || !in_.impostors.empty();
        if (in_.impostorAtlas != 0 && (media || !in_.takenTiles.empty()))
            addImpostors();
        if (media)
            addMedia();
        if (!readable_)
        { // a framebuffer alone can be drawn to but not read: media go on top, nothing else is possible
            if (media)
                addComposite(target_, true);
            finish(target_);
            return out_;
        }
        const bool shimmer = media && !in_.hotAreas.empty() && settings_.shimmer.strength > 0.0f;
        const bool more = shimmer || settings_.dazzle.enabled || settings_.toneMap || separateTarget_;
        if (media)
            addComposite(picture_, !more);
        if (shimmer)
            addShimmer();
        if (settings_.dazzle.enabled)
            addDazzle();
        if (settings_.toneMap)
            addToneMap();
        if (more && out_.anyPass) {
            target_ = PresentPass::addTo(graph_, {picture_, target_}).target;
            finish(target_);
        } else {
            finish(picture_);
        }
        return out_;
    }

private:
    void importTargets()
    {
        const HostTargets& host = request_.targets;
        readable_ = host.color != 0;
        separateTarget_ = host.useFramebuffer;
        if (readable_)
            picture_ = graph_.importTexture({"host color", width_, height_, Format::RGBA32F}, host.color);
        target_ = separateTarget_
                      ? graph_.importFramebuffer({"host framebuffer", width_, height_, Format::RGBA32F},
                                                 host.framebuffer)
                      : picture_;
        out_.anyPass = separateTarget_ && readable_; // then the picture has at least to be carried over
    }

    void addMedia()
    {
        out_.anyPass = true;
        ResourceId depth;
        if (request_.targets.depth != 0)
            depth =
                graph_.importTexture({"host depth", width_, height_, Format::R32F}, request_.targets.depth);
        distance_ = SceneDistancePass::addTo(graph_, {depth, width_, height_, view_}).distance;
        if (!in_.blobs.empty())
            uploadBlobs();
        importBatches();
        const auto solid = SolidPass::addTo(
            graph_, {in_.batches, distance_, width_, height_, view_, settings_.layerOutputs});
        distance_ = solid.distance;
        layerDistance_ = distance_;
        const auto drawn =
            grid_.divisor == 1 ? drawLayers(distance_, solid.under) : drawSmallLayers(solid.under);
        media_ = drawn.media;
        if (settings_.layerOutputs) {
            const auto layers = LayerResolvePass::addTo(graph_, {drawn.layers, width_, height_});
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
        if (settings_.countOverdraw && !in_.blobs.empty()) {
            out_.overdraw =
                OverdrawPass::addTo(graph_, {blobs_, layerDistance_, uint32_t(in_.blobs.size()), grid_.width,
                                             grid_.height, grid_.view, grid_.divisor > 1})
                    .count;
            graph_.keep(out_.overdraw);
        }
        out_.layerWidth = grid_.width;
        out_.layerHeight = grid_.height;
    }

    /// All that belongs into the layers and does not hide, at their size, as far as `distance` lets it be
    /// seen.
    MediaPass::Outputs drawLayers(ResourceId distance, const MediaPass::Outputs& under)
    {
        return MediaPass::addTo(graph_,
                                {blobs_, in_.batches, in_.runs, distance, grid_.width, grid_.height,
                                 grid_.view, settings_.form, settings_.detail && in_.anyDetail,
                                 settings_.layerOutputs, grid_.divisor > 1, impostors_},
                                under);
    }

    /// Layers smaller than the picture: drawn up to the far end of each block and, where a block shows more
    /// than one surface, up to the near end as well; brought to the picture's size between the two, and put
    /// over `under`, which has that size.
    MediaPass::Outputs drawSmallLayers(const MediaPass::Outputs& under)
    {
        if (in_.runs.empty())
            return under;
        const bool hasDepth = request_.targets.depth != 0 || under.media.valid() || under.layers[0].valid();
        const auto ends =
            LayerDistancePass::addTo(graph_, {distance_, hasDepth, grid_.width, grid_.height, grid_.divisor});
        layerDistance_ = ends.far;
        const auto far = drawLayers(ends.far, {});
        const auto near = hasDepth ? drawLayers(ends.near, {}) : MediaPass::Outputs();
        const auto upsampled = [&](ResourceId farLight, ResourceId nearLight) {
            const FrameGraph::Resource small = graph_.resource(farLight);
            return LayerUpsamplePass::addTo(graph_,
                                            {distance_, ends.far, ends.near, farLight, nearLight, width_,
                                             height_, grid_.divisor, small.format, small.name})
                .light;
        };
        MediaPass::Outputs out;
        if (!settings_.layerOutputs) {
            out.media = upsampled(far.media, near.media);
            if (under.media.valid())
                out.media =
                    CompositePass::addTo(graph_, {out.media, under.media, width_, height_, true}).color;
            return out;
        }
        for (size_t i = 0; i < MediaPass::LayerTargets; ++i)
            out.layers[i] = upsampled(far.layers[i], near.layers[i]);
        if (under.layers[0].valid())
            out.layers = LayerOverPass::addTo(graph_, out.layers, under.layers);
        return out;
    }

    /// Names of GL objects to resources of this graph.
    void importBatches()
    {
        for (ParticleBatch& batch : in_.batches) {
            for (BufferPart* part : {&batch.newer, &batch.older, &batch.order, &batch.mesh})
                if (part->bytes > 0)
                    part->id =
                        graph_.importBuffer({"particles", size_t(part->offset + part->bytes)}, part->name);
            batch.textureId = graph_.importTexture({"particle frames", 1, 1, Format::RGBA8}, batch.texture);
            batch.motionId = graph_.importTexture({"particle motion", 1, 1, Format::RGBA8}, batch.motion);
        }
        const bool hasDepth = request_.targets.depth != 0;
        GpuRowsPass::addTo(graph_, in_.gpuRows, in_.batches,
                           hasDepth ? GpuDepth{distance_, &request_.camera, width_, height_} : GpuDepth{});
        GpuOrderPass::addTo(graph_, in_.gpuOrders, in_.batches);
    }

    /// Takes the pictures of this frame and makes all of them ready to be drawn.
    void addImpostors()
    {
        impostors_.atlas = graph_.importTexture(
            {"impostors", kImpostorColumns * kImpostorTile, kImpostorRows * kImpostorTile, Format::RGBA16F},
            in_.impostorAtlas);
        if (!in_.takenTiles.empty())
            takePictures();
        if (in_.impostors.empty())
            return;
        impostors_.instances =
            graph_.importBuffer({"impostors", std::bit_ceil(in_.impostors.size_bytes())}, in_.impostorBuffer);
        if (in_.blobsAreIn)
            return;
        graph_.addPass("media impostor upload", [&](FrameGraph::Builder& builder) {
            impostors_.instances = builder.write(impostors_.instances);
            return [buffer = impostors_.instances, impostors = in_.impostors](Backend& backend) {
                backend.upload(buffer, std::as_bytes(impostors));
            };
        });
    }

    void takePictures()
    {
        constexpr int kSide = kTakingColumns * kImpostorTile;
        const ViewBlock view = [&] {
            ViewBlock block = makeViewBlock(takingCamera(cameraGeometry(request_.camera)), kSide, kSide);
            block.forward.w = settings_.detail ? 1.0f : 0.0f;
            block.sunDirection = {settings_.lighting.sunDirection, block.sunDirection.w};
            return block;
        }();
        ResourceId blobs;
        ResourceId tiles;
        graph_.addPass("media impostor blobs", [&](FrameGraph::Builder& builder) {
            const size_t bytes = std::max(in_.takenBlobs.size_bytes(), sizeof(BlobInstance));
            blobs = builder.write(builder.create(BufferDesc{"impostor blobs", std::bit_ceil(bytes)}));
            tiles = builder.write(
                builder.create(BufferDesc{"impostor tiles", std::bit_ceil(in_.takenTiles.size_bytes())}));
            return [blobs, tiles, taken = in_.takenBlobs, kept = in_.takenTiles](Backend& backend) {
                backend.upload(blobs, std::as_bytes(taken));
                backend.upload(tiles, std::as_bytes(kept));
            };
        });
        const ResourceId nothing = SceneDistancePass::addTo(graph_, {{}, kSide, kSide, view}).distance;
        const auto taken = MediaPass::addTo(graph_,
                                            {blobs,
                                             {},
                                             in_.takenRuns,
                                             nothing,
                                             kSide,
                                             kSide,
                                             view,
                                             settings_.form,
                                             settings_.detail && in_.anyDetail,
                                             false},
                                            {});
        impostors_.atlas = ImpostorKeepPass::addTo(graph_, {taken.media, impostors_.atlas, tiles,
                                                            uint32_t(in_.takenTiles.size())})
                               .atlas;
        graph_.keep(impostors_.atlas); // later frames show it
        out_.anyPass = true;
    }

    void uploadBlobs()
    {
        const size_t capacity =
            std::bit_ceil(in_.blobs.size_bytes()); // few sizes, so that the pool can reuse them
        const BufferDesc desc{"blobs", capacity};
        if (in_.blobBuffer != 0)
            blobs_ = graph_.importBuffer(desc, in_.blobBuffer);
        if (in_.blobBuffer != 0 && in_.blobsAreIn)
            return;
        graph_.addPass("blob upload", [&](FrameGraph::Builder& builder) {
            blobs_ = builder.write(in_.blobBuffer != 0 ? blobs_ : builder.create(desc));
            return [buffer = blobs_, blobs = in_.blobs](Backend& backend) {
                backend.upload(buffer, std::as_bytes(blobs));
            };
        });
    }

    void addComposite(ResourceId behind, bool inPlace)
    {
        const ResourceId color =
            CompositePass::addTo(graph_, {media_, behind, width_, height_, inPlace}).color;
        if (inPlace)
            target_ = color;
        picture_ = color;
    }

    void addShimmer()
    {
        const ResourceId heat =
            HeatOffsetPass::addTo(graph_, {blobs_, distance_, uint32_t(in_.blobs.size()), true, width_,
                                           height_, view_, settings_.shimmer, request_.time})
                .heat;
        picture_ = HeatShimmerPass::addTo(graph_, {picture_, distance_, heat, in_.hotAreas, width_, height_,
                                                   request_.camera.upperLeftOrigin, settings_.shimmer})
                       .color;
    }

    void addDazzle()
    {
        const ResourceId history =
            graph_.importBuffer({"dazzle history", sizeof(DazzleHistory)}, in_.dazzleHistory);
        const auto dazzled = DazzlePass::addTo(graph_, {picture_, history, width_, height_, settings_.dazzle,
                                                        request_.deltaTime, request_.resetHistory});
        picture_ = dazzled.color;
        graph_.keep(dazzled.history);
        out_.dazzled = true;
        out_.anyPass = true;
    }

    void addToneMap()
    {
        picture_ =
            ToneMapPass::addTo(graph_, {picture_, width_, height_, settings_.dazzle.white, Format::RGBA32F})
                .color;
        out_.anyPass = true;
    }

    void finish(ResourceId result)
    {
        out_.anyPass |= !request_.overlay.empty();
        graph_.keep(OverlayPass::addTo(graph_, {result, request_.overlay, &request_.camera, width_, height_})
                        .picture);
    }

    FrameGraph& graph_;
    const ViewGraphInputs& in_;
    const FrameRequest& request_;
    const ViewSettings& settings_;
    int width_;
    int height_;
    ViewBlock view_;
    LayerGrid grid_;
    bool readable_ = false;
    bool separateTarget_ = false;
    ResourceId picture_; ///< the frame so far
    ResourceId target_;  ///< where the result goes
    ResourceId distance_;
    ResourceId layerDistance_; ///< at the layers' size
    ResourceId blobs_;
    ResourceId media_;
    ImpostorDraw impostors_;
    ViewGraphOutputs out_;
};

} // namespace

ViewGraphOutputs buildViewGraph(FrameGraph& graph, const ViewGraphInputs& in)
{
    return ViewGraph(graph, in).build();
}

} // namespace fx::render
