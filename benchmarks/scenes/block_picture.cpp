#include "benchmarks/scenes/block_picture.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/block_kind.h"
#include "rendering/frame/exposure.h"

#include <memory_resource>

namespace fx::cli {

namespace {

constexpr int kMaxFrames = 64; ///< until all tiles are drawn

} // namespace

float whiteOf(float exposureEv100)
{
    return 1.0f / render::exposureFromEv100(exposureEv100);
}

base::Result<std::unique_ptr<BlockPainter>> BlockPainter::create(int width, int height)
{
    std::unique_ptr<BlockPainter> painter(new BlockPainter());
    for (const base::KindDesc* kind : {&base::kBlobKind, &base::kBlockKind, &base::kBlockBallKind})
        painter->schema_.add(*kind);
    render::ViewSettings settings;
    settings.composition = render::Composition::Slabs;
    settings.shimmer.strength = 0.0f;
    settings.dazzle.enabled = false;
    settings.detail = false;
    auto renderer = SnapshotRenderer::create(painter->schema_, settings, width, height);
    if (!renderer.ok())
        return renderer.status();
    painter->renderer_ = std::move(*renderer);
    if (base::Status status = painter->renderer_->warmUp(); !status) // pictures are timed
        return status;
    return painter;
}

base::Result<LitPicture> BlockPainter::paint(const sim::BlocksDef& blocks, const LitView& view)
{
    base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
    snapshot.begin(0, ++sequence_);
    blocks.create(schema_, {}, std::pmr::get_default_resource())->publish({}, snapshot);
    renderer_->settings().exposureEv100 = view.exposureEv100;
    renderer_->settings().lighting = view.lighting;
    int frames = 0;
    do
        if (base::Status status = renderer_->render({{&snapshot, nullptr}, 1.0}, cameraOf(view), 0.0);
            !status)
            return status;
    while (statistics().blockTilesDeferred > 0 && ++frames < kMaxFrames);
    LitPicture picture;
    const FrameLayers layers = renderer_->read();
    const auto& color = layers.color;
    for (size_t i = 0; i + 2 < color.pixels.size(); i += size_t(color.channels))
        picture.light.emplace_back(color.pixels[i], color.pixels[i + 1], color.pixels[i + 2]);
    picture.seconds = 1e-3 * renderer_->millisecondsRender();
    return picture;
}

} // namespace fx::cli
